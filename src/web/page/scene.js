// The scene that the page shows.
// In: texts of scene files, edits of single keys, places in the film. Out: calls of `onOpened`,
// `onShown`, `onProblems`: what the program makes of them.

/** How long the program may work before something else is wanted. */
const PATIENCE_ms = 1500;

/** Keys that set the same value: an edit of one replaces those of the others. */
const ALIKE = [["digits", "mass-ratio", "red.mass"], ["time.speed", "time.duration"]];

/** Which field a line of the program's words is about, and the words for it. */
function blame(line, edits) {
  const body = line.match(/(?:^|: )body (\d+)\.(\w+)/);
  if (body) return {body: Number(body[1]), property: body[2], words: line.replace(/^scene:\d+: /, "")};
  const [, key, words] = line.match(/^([a-z][a-z.-]*): (.*)$/s) ?? [];
  if (key === "masses") {
    const mass = ["digits", "mass-ratio", "red.mass", "blue.mass"].find(one => edits.has(one));
    return {key: mass ?? "mass-ratio", words: line};
  }
  if (key !== undefined && edits.has(key)) return {key, words};
  if (/^scene:\d+:/.test(line)) return {isText: true, words: line.replace(/^scene:(\d+):/, "line $1:")};
  return {words: line};
}

class Scene {
  /** What the program has taken last. */
  facts = null;
  place = {frame: 0};
  onOpened = () => {};
  onShown = () => {};
  onProblems = () => {};
  onBusy = () => {};

  #program = new Program();
  #jobs = new NewestFirst();
  #text = "";
  #isEdited = false;
  /** Edits that the program has not taken yet, or has refused; the last one comes last. */
  #edits = new Map();
  /** A text that is to take the place of the scene. */
  #newText = null;
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
    this.replace(text, place);
  }

  /** Takes this text for the scene; edits that are wrong stay. */
  replace(text, place = this.place) {
    this.#newText = text;
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
    this.replace(this.facts.toml.split("\n").filter(isOther).join("\n"));
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
    this.#newText = null;
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
          this.onProblems([{words: `The program has stopped: ${error.message}`}]);
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
      this.#takeShown(await this.#program.call("show", {place}));
      this.onProblems([]);
    } catch (error) {
      if (!(error instanceof Problem)) throw error;
      this.onProblems([{isPlace: true, words: error.message}]);
    }
  }

  async #try(text, edits) {
    const settings = [...edits].map(([key, value]) => `${key}=${value}`).join("\n");
    return this.#program.call("open", {text, settings, place: this.place});
  }

  /** Opens the scene with all edits or, if some are wrong, with the others. */
  async #openEdited() {
    const edits = new Map(this.#edits);
    const text = this.#newText ?? this.#text;
    const isNew = this.#newText !== null;
    try {
      const opened = await this.#try(text, edits);
      this.#forgetTaken(edits, text);
      this.#take(opened, text, edits);
      this.onProblems([]);
    } catch (error) {
      if (!(error instanceof Problem)) throw error;
      const problems = error.message.split("\n").map(line => blame(line, edits));
      const last = [...edits.keys()].at(-1);
      for (const problem of problems) {
        const isNamed = problem.key || problem.body || problem.isText;
        if (!isNamed && !isNew && last !== undefined) problem.key = last;
        if (!isNamed && (isNew || last === undefined)) problem.isText = true;
      }
      await this.#openWithout(problems, edits, text);
      this.onProblems(problems);
    }
  }

  /** The edits that no problem is about still hold. */
  async #openWithout(problems, edits, text) {
    const wrong = new Set(problems.map(problem => problem.key));
    const right = new Map([...edits].filter(([key]) => !wrong.has(key)));
    if (problems.some(problem => !problem.key)) {
      this.#newText = null;
      return;
    }
    if (right.size === 0 && this.#newText === null) return;
    try {
      const opened = await this.#try(text, right);
      this.#forgetTaken(right, text);
      this.#take(opened, text, right);
    } catch (error) {
      if (!(error instanceof Problem)) throw error;
    }
  }

  #forgetTaken(edits, text) {
    for (const [key, value] of edits) {
      if (this.#edits.get(key) === value) this.#edits.delete(key);
    }
    if (this.#newText === text) this.#newText = null;
  }

  #take({facts, shown}, text, edits = new Map()) {
    this.facts = facts;
    this.#text = edits.size > 0 ? facts.toml : text;
    this.onOpened(facts, this.#text);
    this.#takeShown(shown);
  }

  #takeShown(shown) {
    this.onShown(shown);
  }
}
