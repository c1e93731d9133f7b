// The scene that the page shows.
// In: texts of scene files, edits of single keys, places in the film. Out: calls of `onPicture`,
// `onOpened`, `onShown`, `onProblems`, `onPlaceProblem`: what the program makes of them.

/** How long the program may work before something else is wanted. */
const PATIENCE_ms = 1500;

/** Keys that set the same value: an edit of one replaces those of the others. */
const ALIKE = [["digits", "mass-ratio", "red.mass"], ["time.speed", "time.duration"]];

/** What the program says of an edit, without the name of what was edited. */
const wordsOf = (message, key) => message.split("\n")
  .map(line => line.startsWith(`${key}: `) ? line.slice(key.length + 2) : line)
  .map(line => line.replace(/^scene:\d+: /, ""));

/** What it says of a text: of the lines of a file, or of bodies in a table. */
function problemsOfText(message, key) {
  return message.split("\n").map(line => {
    if (key !== "bodies") return {key, words: line.replace(/^scene:(\d+):/, "line $1:")};
    const words = line.replace(/^scene:\d+: /, "");
    const [, body, property] = words.match(/^body (\d+)\.(\w+)/) ?? [];
    return {key, words, body: Number(body), property};
  });
}

class Scene {
  /** What the program has taken last. */
  facts = null;
  place = {frame: 0};
  onOpened = () => {};
  onPicture = () => {};
  onShown = () => {};
  onProblems = () => {};
  onPlaceProblem = () => {};
  /** Whether there is a field that could show what is wrong with this key. */
  hasField = () => true;
  onBusy = () => {};

  #program = new Program();
  #jobs = new NewestFirst();
  #text = "";
  #isEdited = false;
  /** Edits that the program has not taken yet, or has refused; the last one comes last. */
  #edits = new Map();
  /** A text that is to take the place of the scene, and what it comes from. */
  #newText = null;
  /** What is wrong with texts that were refused and are still to be seen, by what they come from. */
  #textProblems = new Map();
  #since = 0;

  get started() {
    return this.#program.started;
  }
  get isBusy() {
    return this.#jobs.isBusy;
  }

  /** Shows another scene. @param place  in its film, as that of worker.js */
  open(text, place = this.place) {
    this.#edits.clear();
    this.#textProblems.clear();
    this.replace(text, "text", place);
  }

  /** Takes this text for the scene; edits that were refused stay.
   * @param key  what it comes from: "text", "bodies" or a key of the scene */
  replace(text, key, place = this.place) {
    this.#newText = {text, key};
    this.place = place;
    this.#apply();
  }

  edit(key, text) {
    for (const keys of ALIKE) {
      if (keys.includes(key)) keys.forEach(other => this.#edits.delete(other));
    }
    this.#edits.delete(key);
    this.#edits.set(key, text);
    this.#apply();
  }

  /** Gives a key its default again. */
  reset(key) {
    this.#edits.delete(key);
    const isOther = line => !line.startsWith(`${key} = `);
    this.replace(this.facts.toml.split("\n").filter(isOther).join("\n"), key);
  }

  /** Leaves the value as it was before. */
  forget(key) {
    if (this.#edits.delete(key)) this.#apply();
  }

  show(place) {
    this.place = place;
    this.#work();
  }

  /** What the scene is, for other workers. */
  get text() {
    return this.facts.toml;
  }

  /** A file of what is shown. */
  save(name) {
    return this.#program.call("save", {name});
  }

  /** Gives up what the program does, and goes on with what it has taken last. */
  stop() {
    this.#edits.clear();
    this.#textProblems.clear();
    this.#newText = null;
    this.onProblems([]);
    this.#replaceProgram();
    if (this.facts) this.onOpened(this.facts, this.#text);
  }

  #replaceProgram() {
    this.#program.stop();
    this.#program = new Program();
    if (this.facts) {
      this.#program.call("open", {text: this.facts.toml, settings: ""}).catch(() => {});
    }
  }

  /** Does what is asked for, when the program has time; of several wishes the last. */
  #work() {
    // Somebody who goes on while the program still works does not want that work.
    if (this.#jobs.isBusy && performance.now() - this.#since > PATIENCE_ms) this.#replaceProgram();
    this.#jobs.add(async () => {
      this.#since = performance.now();
      this.onBusy(true);
      try {
        const isEdited = this.#isEdited;
        this.#isEdited = false;
        await (isEdited ? this.#openEdited() : this.#show(this.place));
      } catch (error) {
        if (!(error instanceof Failure)) throw error;
        if (this.#program.isStopped) this.#replaceProgram();
        if (error.message !== "stopped") {
          this.onProblems([{key: "program", words: `The program has stopped: ${error.message}`}]);
        }
      } finally {
        this.onBusy(false);
      }
    });
  }

  #apply() {
    this.#isEdited = true;
    this.#work();
  }

  async #show(place) {
    try {
      const shown = await this.#program.call("show", {place});
      this.onPicture(shown);
      this.onShown(shown.place);
      this.onPlaceProblem("");
    } catch (error) {
      if (!(error instanceof Problem)) throw error;
      this.onPlaceProblem(error.message);
    }
  }

  /** @returns what the program says is wrong; empty if it has taken it. */
  async #try(text, edits) {
    const settings = edits.map(([key, value]) => `${key}=${value}`).join("\n");
    try {
      const {facts, shown} = await this.#program.call("open", {text, settings, place: this.place});
      for (const [key, value] of edits) {
        if (this.#edits.get(key) === value) this.#edits.delete(key);
      }
      this.facts = facts;
      this.#text = edits.length > 0 ? facts.toml : text;
      // The picture first: it is what a hand on a slider waits for.
      this.onPicture(shown);
      this.onOpened(facts, this.#text);
      this.onShown(shown.place);
      // Another kind of scene has other keys.
      for (const key of this.#edits.keys()) {
        if (!this.hasField(key)) this.#edits.delete(key);
      }
      return "";
    } catch (error) {
      if (!(error instanceof Problem)) throw error;
      return error.message;
    }
  }

  async #openEdited() {
    const keyOfText = await this.#openText();
    const edits = [...this.#edits];
    const problems = [];
    const message = edits.length > 0 ? await this.#try(this.#text, edits) : "";
    // One by one, the newest first: what is wrong with one does not hold up the others.
    for (const edit of message ? edits.reverse() : []) {
      if (!this.#edits.has(edit[0])) continue;
      const words = edits.length > 1 ? await this.#try(this.#text, [edit]) : message;
      if (words) problems.push(...wordsOf(words, edit[0]).map(line => ({key: edit[0], words: line})));
    }
    this.onProblems([...problems, ...[...this.#textProblems.values()].flat()]);
    // A key that could not be given its default has its value again.
    if (keyOfText) this.#textProblems.delete(keyOfText);
  }

  /** @returns the key for whose sake a text was refused. */
  async #openText() {
    if (this.#newText === null) return null;
    const {text, key} = this.#newText;
    this.#newText = null;
    this.#textProblems.delete(key);
    const message = await this.#try(text, []);
    if (message === "") return null;
    this.#textProblems.set(key, problemsOfText(message, key));
    return key === "text" || key === "bodies" ? null : key;
  }
}
