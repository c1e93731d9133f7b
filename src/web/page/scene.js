// The scene that the page shows.
// In: texts of scene files, edits of single keys, places in the film. Out: calls of `onPicture`,
// `onOpened`, `onShown`, `onProblems`, `onPlaceProblem`, `onBusy`: what the program makes of them.

/** A newer wish ends work that has lasted longer than this; longer each time, until work is done. */
const PATIENCE_ms = 1500;
const TOO_LONG = "Not applied: it took too long, and something else was asked for.";

/** What is being opened: the edits, and the source of the text: "text", "bodies", a key or null. */
const NO_ATTEMPT = {edits: [], key: null};

class Scene {
  /** What the program says of the scene that it accepted last; null before the first one. */
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
  /** The scene that the program accepted last: a text, edits of it, and the place that is shown. */
  #text = "";
  #accepted = new Edits();
  #place = {frame: 0};
  /** Edits that the program has not seen yet, or has refused; the last one comes last. */
  #edits = new Edits();
  /** Scene files {make(facts), place} still to be opened, by their source: "text", "bodies" or a key. */
  #texts = new Map();
  /** A place that was asked for and not shown yet. */
  #wantedPlace = null;
  #wantsOpening = false;
  /** Problems of texts that were refused and of edits that took too long, by their source or key. They
   * are not tried again, but their messages stay. */
  #keptProblems = new Map();
  /** What the program is opening. */
  #attempt = NO_ATTEMPT;
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
    return this.#accepted.isEmpty ? this.#text : this.facts.toml;
  }
  /** The same for other workers. */
  get source() {
    return {text: this.#text, edits: this.#accepted};
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
   * @param key  its source: "bodies" or a key of the scene */
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
    return this.#edits.hasKey(key) || this.#texts.has(key) || this.#attempt.key === key;
  }

  /** @param place  as that of worker.js, or {step: 1}: the next collision, {step: -1}: the one before */
  show(place) {
    this.#wantedPlace = place;
    this.#work();
  }

  /** Gives back the memory of a picture that is on the canvas. */
  recycle(pixels) {
    this.#program.call("recycle", {pixels}, [pixels]).catch(() => {});
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

  /** Ends what the program does, and goes on with the scene that it accepted last. */
  stop() {
    this.#forgetWishes();
    this.#keptProblems.clear();
    this.onProblems([]);
    this.#replaceProgram();
    if (this.facts) this.onOpened(this.facts);
  }

  #forgetWishes() {
    this.#attempt = NO_ATTEMPT;
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
      const {picture} = await program.call("open",
        {text: this.#text, settings: this.#accepted.lines, places});
      this.onPicture(picture);
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
    const words = `The program crashed and was restarted; changes that it had not accepted were dropped (${message}).`;
    this.onProblems([{key: "program", words}]);
  }

  #leaveSlow() {
    const {edits, key: keyOfText} = this.#attempt;
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
      const picture = await this.#call("show", {place: wanted});
      // There may be no collision to step to.
      if (picture) this.#showPlace(picture, wanted);
      this.onPlaceProblem("");
    } catch (error) {
      if (!(error instanceof Problem)) throw error;
      this.onPlaceProblem(error.message);
    }
  }

  #showPlace(picture, wanted) {
    const {frame, state} = picture.shown;
    if (!wanted.step) this.#place = wanted;
    else this.#place = frame === null ? {instant: `#${JSON.parse(state).collisions}`} : {frame};
    this.onPicture(picture);
    this.onShown(picture.shown);
  }

  /** Opens a text with these edits, which are kept if the program accepts them.
   * @param place  to be shown, if another one than now
   * @returns what the program says is wrong; empty if it has accepted the scene. */
  async #try(text, edits, place = null) {
    // A step is relative to the picture that is shown, so it means nothing in another scene.
    const wanted = place ?? (this.#wantedPlace?.step ? null : this.#wantedPlace);
    const places = wanted ? [wanted, this.#place] : [this.#place];
    let answer;
    try {
      answer = await this.#call("open", {text, settings: edits.lines, places});
    } catch (error) {
      if (!(error instanceof Problem)) throw error;
      return error.message;
    }
    this.#attempt = NO_ATTEMPT;
    this.#reopened = Promise.resolve();
    this.facts = answer.facts;
    this.#text = text;
    this.#accepted = edits;
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
  #tell({facts, picture, placeProblem}, wanted) {
    this.onPicture(picture);
    this.onOpened(facts);
    this.onShown(picture.shown);
    this.onPlaceProblem(wanted ? placeProblem : "");
  }

  async #openEdited() {
    const keysOfTexts = await this.#openTexts();
    const problems = this.facts ? await this.#tryEdits(this.#edits.list) : [];
    this.onProblems([...problems, ...this.#allKept]);
    // The scene still has a value for this key, so the message need not stay.
    for (const key of keysOfTexts) {
      if (key !== "text" && key !== "bodies") this.#keptProblems.delete(key);
    }
    this.#attempt = NO_ATTEMPT;
    await this.#showWanted();
  }

  /** All edits together; if something is wrong, one by one, the newest first, so that what is wrong
   * with one does not hold up the others. */
  async #tryEdits(edits) {
    this.#attempt = {edits, key: null};
    const message = edits.length > 0 ? await this.#try(this.#text, this.#accepted.with(edits)) : "";
    const problems = [];
    for (const edit of message ? edits.reverse() : []) {
      if (!this.#edits.has(edit)) continue;
      this.#attempt = {edits: [edit], key: null};
      const words = edits.length > 1 ? await this.#try(this.#text, this.#accepted.with([edit])) : message;
      if (words) problems.push(...messageLines(words, edit[0]).map(line => ({key: edit[0], words: line})));
    }
    // What was accepted last may have made a scene that has no such field: its edit was dropped.
    return problems.filter(({key}) => this.#edits.hasKey(key));
  }

  /** @returns the sources of the texts that were refused. */
  async #openTexts() {
    const refused = [];
    for (const [key, {make, place}] of this.#texts) {
      this.#texts.delete(key);
      this.#keptProblems.delete(key);
      this.#attempt = {edits: [], key};
      const message = await this.#try(make(this.facts), new Edits(), place);
      if (message === "") continue;
      this.#keptProblems.set(key, problemsOfText(message, key));
      refused.push(key);
    }
    return refused;
  }
}
