// The scene that the page shows.
// In: texts of scene files, edits of single keys, places in the film. Out: calls of `onPicture`,
// `onOpened`, `onShown`, `onProblems`, `onPlaceProblem`: what the program makes of them.

/** A newer wish ends work that has lasted longer than this; longer each time, until work is done. */
const PATIENCE_ms = 1500;
const TOO_LONG = "Not applied: it took too long, and something else was asked for.";

/** Keys that set the same value: an edit of one replaces those of the others. */
const ALIKE = [["digits", "mass-ratio", "red.mass"], ["time.speed", "time.duration"]];
const isAlike = (one, other) =>
  one === other || ALIKE.some(keys => keys.includes(one) && keys.includes(other));

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

/** Values of keys, in the order in which they were set; no two set the same. */
class Edits {
  #values;

  constructor(values = []) {
    this.#values = new Map(values);
  }

  get list() {
    return [...this.#values];
  }
  get isEmpty() {
    return this.#values.size === 0;
  }
  has([key, value]) {
    return this.#values.get(key) === value;
  }
  hasKey(key) {
    return this.#values.has(key);
  }
  set(key, value) {
    for (const other of this.#values.keys()) {
      if (isAlike(key, other)) this.#values.delete(other);
    }
    this.#values.set(key, value);
  }
  /** @returns whether it was there. */
  delete(key) {
    return this.#values.delete(key);
  }
  /** These, and then the others. */
  with(others) {
    const all = new Edits(this.#values);
    for (const [key, value] of others) all.set(key, value);
    return all;
  }
  /** The lines that the program reads. */
  get lines() {
    return this.list.map(([key, value]) => `${key}=${value}`).join("\n");
  }
}

/** What the program tries: edits, and the text that comes from this key. */
const NOTHING = {edits: [], key: null};

class Scene {
  /** What the program says of the scene that it has taken last; null before the first one. */
  facts = null;
  onOpened = () => {};
  onPicture = () => {};
  onShown = () => {};
  onProblems = () => {};
  onPlaceProblem = () => {};
  /** Whether there is a field that could show what is wrong with this key. */
  hasField = () => true;
  onBusy = () => {};

  #program = new Program();
  #jobs = new NewestOnly();
  /** The scene that the program has taken last: a text, edits of it, and the place that is shown. */
  #text = "";
  #taken = new Edits();
  #place = {frame: 0};
  /** Edits that the program has not taken yet, or has refused; the last one comes last. */
  #edits = new Edits();
  /** Texts {make(facts), place} that are to take the place of the scene, by what they come from. */
  #texts = new Map();
  /** A place that was asked for and not shown yet. */
  #wantedPlace = null;
  #wantsOpening = false;
  /** Problems of texts that were refused and of edits that took too long, by what they come from. They
   * are not tried again, but their messages stay. */
  #keptProblems = new Map();
  /** What the program is opening. */
  #trying = NOTHING;
  /** A promise that the program has the scene; null after a restart, until something needs the scene. */
  #reopened = null;
  /** When the program began its task; null while it has none. */
  #since = null;
  #patience_ms = PATIENCE_ms;
  #saves = 0;

  get started() {
    return this.#program.started;
  }
  get isBusy() {
    return this.#jobs.isBusy;
  }
  /** The scene as a scene file: its own text, if no field has changed it. */
  get text() {
    return this.#taken.isEmpty ? this.#text : this.facts.toml;
  }
  /** The same for other workers. */
  get source() {
    return {text: this.#text, edits: this.#taken};
  }

  /** Shows another scene. @param place  in its film, as that of worker.js; or where it is now */
  open(text, place = null) {
    this.#forgetWishes();
    this.#keptProblems.clear();
    this.#texts.set("text", {make: () => text, place});
    this.#apply();
  }

  /** Takes another text for the scene; edits that were refused stay.
   * @param make  the text from the scene's facts
   * @param key  what it comes from: "bodies" or a key of the scene */
  replace(make, key) {
    this.#texts.delete(key);
    this.#texts.set(key, {make, place: null});
    this.#apply();
  }

  edit(key, value) {
    for (const other of this.#keptProblems.keys()) {
      if (isAlike(key, other)) this.#keptProblems.delete(other);
    }
    this.#edits.set(key, value);
    this.#apply();
  }

  /** Gives a key its default again. */
  reset(key) {
    this.#edits.delete(key);
    const isOther = line => !line.startsWith(`${key} = `);
    this.replace(facts => facts.toml.split("\n").filter(isOther).join("\n"), key);
  }

  /** Drops an edit that was refused. */
  forget(key) {
    const wasKept = this.#keptProblems.delete(key);
    if (this.#edits.delete(key) || wasKept) this.#apply();
  }

  /** Whether there is a newer value than that of the facts, of "text", "bodies" or a key. */
  isWaiting(key) {
    return this.#edits.hasKey(key) || this.#texts.has(key) || this.#trying.key === key;
  }

  /** @param place  as that of worker.js, or {step: 1}: the next collision, {step: -1}: the one before */
  show(place) {
    this.#wantedPlace = place;
    this.#work();
  }

  /** A file of what is shown. */
  async save(name) {
    ++this.#saves;
    try {
      this.#replaceIfBroken();
      await this.#haveScene();
      return await this.#program.call("save", {name});
    } finally {
      --this.#saves;
    }
  }

  /** Gives up what the program does, and goes on with what it has taken last. */
  stop() {
    this.#forgetWishes();
    this.#keptProblems.clear();
    this.onProblems([]);
    this.#replaceProgram();
    if (this.facts) this.onOpened(this.facts);
  }

  #forgetWishes() {
    this.#trying = NOTHING;
    this.#edits = new Edits();
    this.#texts.clear();
    this.#wantedPlace = null;
  }

  async #call(task, details) {
    await this.#program.started;
    this.#since = performance.now();
    try {
      if (task === "show") await this.#haveScene();
      return await this.#program.call(task, details);
    } finally {
      this.#since = null;
    }
  }

  #replaceIfBroken() {
    if (this.#program.isStopped) this.#replaceProgram();
  }

  #replaceProgram() {
    this.#program.stop();
    this.#program = new Program();
    this.#reopened = null;
    this.#since = null;
  }

  #haveScene() {
    this.#reopened ??= this.#reopen();
    return this.#reopened;
  }

  async #reopen() {
    const program = this.#program;
    const places = [this.#place];
    try {
      const {shown} = await program.call("open",
        {text: this.#text, settings: this.#taken.lines, places});
      this.onPicture(shown);
    } catch (error) {
      if (program === this.#program) this.#reopened = null;
      throw error;
    }
  }

  /** Does what is asked for, when the program has time; of several wishes the last. */
  #work() {
    // Somebody who goes on while the program still works does not want that work.
    const isLong = this.#since !== null && performance.now() - this.#since > this.#patience_ms;
    if (isLong && this.#saves === 0) {
      this.#patience_ms *= 2;
      this.#replaceProgram();
    }
    this.#jobs.add(async () => {
      this.onBusy(true);
      try {
        this.#replaceIfBroken();
        const wantsOpening = this.#wantsOpening || this.#texts.size > 0;
        this.#wantsOpening = false;
        await (wantsOpening ? this.#openEdited() : this.#showWanted());
        this.#patience_ms = PATIENCE_ms;
      } catch (error) {
        if (!(error instanceof Failure)) throw error;
        this.#recover(error);
      } finally {
        this.onBusy(false);
      }
    });
  }

  /** After work that broke down or was ended. It is not tried again. */
  #recover({message}) {
    this.#replaceIfBroken();
    if (message === STOPPED) {
      this.#leaveSlow();
      return;
    }
    this.#forgetWishes();
    this.#keptProblems.clear();
    if (this.facts) this.onOpened(this.facts);
    const words = `The program crashed and was restarted; the last change was dropped (${message}).`;
    this.onProblems([{key: "program", words}]);
  }

  #leaveSlow() {
    const {edits, key: keyOfText} = this.#trying;
    const keys = edits.filter(edit => this.#edits.has(edit)).map(([key]) => key);
    for (const key of keys) this.#edits.delete(key);
    if (keyOfText !== null && !this.#texts.has(keyOfText)) keys.push(keyOfText);
    for (const key of keys) {
      this.#keptProblems.set(key, [{key, words: TOO_LONG}]);
    }
    // Edits that were refused before are tried again, so that their messages stay.
    this.#wantsOpening ||= !this.#edits.isEmpty;
    if (keys.length > 0) this.onProblems(this.#allKept);
  }
  get #allKept() {
    return [...this.#keptProblems.values()].flat();
  }

  #apply() {
    this.#wantsOpening = true;
    this.#work();
  }

  async #showWanted() {
    const wanted = this.#wantedPlace;
    this.#wantedPlace = null;
    if (wanted === null || !this.facts) return;
    try {
      const shown = await this.#call("show", {place: wanted});
      // There may be no collision to step to.
      if (shown) this.#showPlace(shown, wanted);
      this.onPlaceProblem("");
    } catch (error) {
      if (!(error instanceof Problem)) throw error;
      this.onPlaceProblem(error.message);
    }
  }

  #showPlace(shown, wanted) {
    const {frame, state} = shown.place;
    if (!wanted.step) this.#place = wanted;
    else this.#place = frame === null ? {instant: `#${JSON.parse(state).collisions}`} : {frame};
    this.onPicture(shown);
    this.onShown(shown.place);
  }

  /** Opens a text with these edits, which are kept if the program takes them.
   * @param place  to be shown, if another one than now
   * @returns what the program says is wrong; empty if it has taken it. */
  async #try(text, edits, place = null) {
    // A step is one from what is shown.
    const wanted = place ?? (this.#wantedPlace?.step ? null : this.#wantedPlace);
    const places = wanted ? [wanted, this.#place] : [this.#place];
    let answer;
    try {
      answer = await this.#call("open", {text, settings: edits.lines, places});
    } catch (error) {
      if (!(error instanceof Problem)) throw error;
      return error.message;
    }
    this.#trying = NOTHING;
    this.#reopened = Promise.resolve();
    this.facts = answer.facts;
    this.#text = text;
    this.#taken = edits;
    for (const edit of edits.list) {
      if (this.#edits.has(edit)) this.#edits.delete(edit[0]);
    }
    if (wanted && wanted === this.#wantedPlace) this.#wantedPlace = null;
    if (wanted && answer.placeProblem === "") this.#place = wanted;
    this.#tell(answer, wanted);
    // Another kind of scene has other keys.
    for (const [key] of this.#edits.list) {
      if (!this.hasField(key)) this.#edits.delete(key);
    }
    return "";
  }

  /** The picture first: it is what a hand on a slider waits for. */
  #tell({facts, shown, placeProblem}, wanted) {
    this.onPicture(shown);
    this.onOpened(facts);
    this.onShown(shown.place);
    this.onPlaceProblem(wanted ? placeProblem : "");
  }

  async #openEdited() {
    const keysOfTexts = await this.#openTexts();
    const problems = this.facts ? await this.#tryEdits(this.#edits.list) : [];
    this.onProblems([...problems, ...this.#allKept]);
    // A key that could not be given its default has its value again.
    for (const key of keysOfTexts) {
      if (key !== "text" && key !== "bodies") this.#keptProblems.delete(key);
    }
    this.#trying = NOTHING;
    await this.#showWanted();
  }

  /** All edits together; if something is wrong, one by one, the newest first, so that what is wrong
   * with one does not hold up the others. */
  async #tryEdits(edits) {
    this.#trying = {edits, key: null};
    const message = edits.length > 0 ? await this.#try(this.#text, this.#taken.with(edits)) : "";
    const problems = [];
    for (const edit of message ? edits.reverse() : []) {
      if (!this.#edits.has(edit)) continue;
      this.#trying = {edits: [edit], key: null};
      const words = edits.length > 1 ? await this.#try(this.#text, this.#taken.with([edit])) : message;
      if (words) problems.push(...wordsOf(words, edit[0]).map(line => ({key: edit[0], words: line})));
    }
    return problems;
  }

  /** @returns what the texts come from that were refused. */
  async #openTexts() {
    const refused = [];
    for (const [key, {make, place}] of this.#texts) {
      this.#texts.delete(key);
      this.#keptProblems.delete(key);
      this.#trying = {edits: [], key};
      const message = await this.#try(make(this.facts), new Edits(), place);
      if (message === "") continue;
      this.#keptProblems.set(key, problemsOfText(message, key));
      refused.push(key);
    }
    return refused;
  }
}
