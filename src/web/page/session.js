// The scene that the page shows, and the one that somebody wants.
// In: wishes: a text, edits of keys, a place in the film, a size. Out: calls of `on…`: what the program
// makes of them.
//
// There is one wish and one state that the program has accepted. A wish that is newer than the state is
// sent to the program as a whole; edits that it refuses wait in the wish, with what is wrong.

import {Failure, Program, Refusal, STOPPED, wordsOf} from "./program.js";

/** A newer wish ends work that has lasted longer than this; longer each time, until work is done. */
const PATIENCE_ms = 1500;
const TOO_LONG = {origin: "", key: "", reason: "Not applied: it took too long, and something else was asked for."};
/** The problems of the text are under this name, those of an edit under its key. */
export const TEXT = "text";

/** Keys that set the same value: an edit of one replaces those of the others. */
const KEYS_OF_ONE_VALUE = [["digits", "mass-ratio", "red.mass"], ["time.speed", "time.duration"],
  ["restitution", "blocks.restitution"], ["restitution", "wall.restitution"]];
const isAlike = (one, other) =>
  one === other || KEYS_OF_ONE_VALUE.some(keys => keys.includes(one) && keys.includes(other));

/** The lines that the program reads: a value, or null for the key's default. */
const linesOf = edits => edits.map(([key, value]) => value === null ? key : `${key}=${value}`).join("\n");
const isOfBodies = ([key]) => key.startsWith("body ");

/** A place in the film: a frame, an instant such as "turn", or a number of collisions from here.
 * @typedef {{frame?: number, instant?: string, step?: number}} Place */

export class Session {
  /** What the program says of the scene that it has accepted; null before the first one. */
  facts = null;
  onPicture = picture => {};
  onOpened = (facts, leftOut) => {};
  onShown = shown => {};
  onRefused = () => {};
  onPlaceProblem = words => {};
  onBusy = isBusy => {};

  #program = new Program();
  /** What the program has accepted: `edits` are [key, value] in the order in which they were made. */
  #state = {text: "", edits: []};
  /** @type {Place} */
  #place = {frame: 0};
  #wish = {text: "", edits: []};
  /** @type {Place | null} */
  #wantedPlace = null;
  #screen = "";
  #isNewer = false;
  #isWorking = false;
  /** {key or TEXT: problems}; an edit in it is in the wish, and not in the state. */
  #refused = new Map();
  #saidOfText = [];
  #leftOut = [];
  #typed = new Set();
  /** What the program tries: the edits that it has not accepted yet, and the text if it is another one. */
  #tried = {edits: [], text: null};
  /** Whether the program has the scene; false after a restart. */
  #hasScene = false;
  /** When the program began its task; null while it has none. */
  #since = null;
  #patience_ms = PATIENCE_ms;
  #saves = 0;

  get started() {
    return this.#program.started;
  }
  get isBusy() {
    return this.#isWorking;
  }
  /** The scene as a scene file: its own text, if no field has changed it. */
  get text() {
    return this.#state.edits.length === 0 ? this.#state.text : this.facts.toml;
  }
  /** The same for other workers. */
  get source() {
    return {text: this.#state.text, settings: linesOf(this.#state.edits)};
  }
  /** What can be shown again by restore(). */
  get snapshot() {
    return {...this.#state, place: this.#place};
  }
  isTyped(key) {
    return this.#typed.has(key);
  }
  problemsOf(name) {
    return this.#refused.get(name) ?? (name === TEXT ? this.#saidOfText : []);
  }
  get refusedKeys() {
    return [...this.#refused.keys()];
  }

  /** Shows another scene. @param place  in its film, as that of worker.js; or where it is now */
  open(text, place = null) {
    this.restore({text, edits: [], place});
  }

  /** The same, while what is wrong with the text that was wanted stays said. */
  openInstead(text) {
    const problems = this.problemsOf(TEXT);
    this.open(text, {frame: 0});
    this.#saidOfText = problems;
  }

  restore({text, edits, place}) {
    this.#refused.clear();
    this.#saidOfText = [];
    this.#want({text, edits}, place);
  }

  /** @param value  null for the default
   * @param isTyped  only what is typed can be wrong; the field takes anything else back */
  edit(key, value, isTyped = false) {
    if (isTyped) this.#typed.add(key);
    else this.#typed.delete(key);
    const others = this.#wish.edits.filter(([other]) => !isAlike(key, other));
    for (const other of this.refusedKeys) {
      if (isAlike(key, other)) this.#refused.delete(other);
    }
    this.#want({text: this.#wish.text, edits: [...others, [key, value]]});
  }

  /** Drops an edit that was refused. */
  forget(key) {
    if (!this.#refused.delete(key)) return;
    this.#want({text: this.#wish.text, edits: this.#wish.edits.filter(([other]) => other !== key)});
  }

  /** Whether there is a newer value of this key than that of the facts. */
  isWaiting(key) {
    const same = ([other]) => other === key;
    return this.#isNewer && this.#wish.edits.find(same) !== this.#state.edits.find(same);
  }
  get isTextWaiting() {
    return this.#isNewer && this.#wish.text !== this.#state.text;
  }

  /** @param place  as that of worker.js, or {step: 1}: the next collision, {step: -1}: the one before */
  show(place) {
    this.#wantedPlace = place;
    this.#work();
  }

  /** Lays the picture out in this size, "1080x1350", or in the scene's own if it is empty. */
  setScreen(screen) {
    if (screen === this.#screen) return;
    this.#screen = screen;
    if (this.facts) this.#want(this.#wish);
  }

  /** What cannot be added to the picture, and why. */
  async choices() {
    await this.#haveScene();
    return this.#program.call("choices");
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

  /** Ends what the program does, and goes on with the scene that it has accepted. */
  stop() {
    this.#forgetWishes();
    this.#tried = {edits: [], text: null};
    this.#replaceProgram();
    this.onRefused();
    if (this.facts) this.onOpened(this.facts, this.#leftOut);
  }

  #want(wish, place = null) {
    this.#wish = wish;
    this.#isNewer = true;
    if (place) this.#wantedPlace = place;
    this.#work();
  }

  #forgetWishes() {
    this.#wish = this.#state;
    this.#isNewer = false;
    this.#wantedPlace = null;
    this.#refused.clear();
  }

  #replaceIfBroken() {
    if (this.#program.isStopped) this.#replaceProgram();
  }
  #replaceProgram() {
    this.#program.stop();
    this.#program = new Program();
    this.#hasScene = false;
    this.#since = null;
  }

  async #haveScene() {
    if (this.#hasScene) return;
    const {picture} = await this.#program.call("open",
      {...this.source, places: [this.#place], screen: this.#screen});
    this.#hasScene = true;
    this.onPicture(picture);
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

  /** Does what is asked for, when the program has time; of several wishes the last. */
  async #work() {
    // Somebody who goes on while the program still works does not want that work.
    const isLong = this.#since !== null && performance.now() - this.#since > this.#patience_ms;
    if (isLong && this.#saves === 0) {
      this.#patience_ms *= 2;
      this.#replaceProgram();
    }
    if (this.#isWorking) return;
    this.#isWorking = true;
    this.onBusy(true);
    while (this.#isNewer || this.#wantedPlace) {
      try {
        this.#replaceIfBroken();
        await (this.#isNewer ? this.#openWanted() : this.#showWanted());
        this.#patience_ms = PATIENCE_ms;
      } catch (error) {
        this.#recover(error);
      }
    }
    this.#isWorking = false;
    this.onBusy(false);
  }

  /** After work that broke down or was ended. It is not tried again. */
  #recover(error) {
    this.#replaceIfBroken();
    if (error instanceof Failure && error.message === STOPPED) {
      // What is wanted no more needs no words.
      const slow = this.#tried.edits.filter(edit => this.#wish.edits.includes(edit));
      for (const [key] of slow) this.#refused.set(key, [TOO_LONG]);
      if (this.#tried.text !== null && this.#tried.text === this.#wish.text) {
        this.#refused.set(TEXT, [TOO_LONG]);
        this.#wish = this.#state;
      }
      this.#wish = {...this.#wish, edits: this.#wish.edits.filter(edit => !slow.includes(edit))};
    } else {
      this.#forgetWishes();
      const reason = "The program crashed and was restarted; changes that it had not accepted were " +
        `dropped (${error.message}).`;
      this.#refused.set("program", [{origin: "", key: "", reason}]);
      if (!(error instanceof Failure)) reportError(error);
    }
    this.#tried = {edits: [], text: null};
    this.onRefused();
    if (this.facts) this.onOpened(this.facts, this.#leftOut);
  }

  async #showWanted() {
    const wanted = this.#wantedPlace;
    this.#wantedPlace = null;
    if (!this.facts) return;
    try {
      const picture = await this.#call("show", {place: wanted});
      // There may be no collision to step to.
      if (picture) this.#take(picture, wanted);
      this.onPlaceProblem("");
    } catch (error) {
      if (!(error instanceof Refusal)) throw error;
      this.onPlaceProblem(error.message);
    }
  }

  #take(picture, place) {
    const {frame, state} = picture.shown;
    if (!place.step) this.#place = place;
    else this.#place = frame === null ? {instant: `#${JSON.parse(state).collisions}`} : {frame};
    this.onPicture(picture);
    this.onShown(picture.shown);
  }

  /** Opens what is wanted: without edits that the program refuses, one after the other. */
  async #openWanted() {
    const wish = this.#wish;
    this.#isNewer = false;
    const refused = new Map();
    for (let edits = wish.edits; ;) {
      const problems = await this.#try({text: wish.text, edits});
      if (problems.length === 0) break;
      const wrong = this.#culprits(problems, edits);
      for (const name of wrong) {
        const mine = problems.filter(({origin}) => origin === name);
        refused.set(name, mine.length > 0 ? mine : problems);
      }
      if (wrong.includes(TEXT)) break;
      edits = edits.filter(([key]) => !wrong.includes(key));
      // What is left is shown already.
      if (wish.text === this.#state.text && linesOf(edits) === linesOf(this.#state.edits)) break;
    }
    this.#tried = {edits: [], text: null};
    if (this.#wish === wish && refused.has(TEXT)) this.#wish = this.#state;
    for (const [key, words] of this.#refused) {
      if (words.includes(TOO_LONG) && !refused.has(key)) refused.set(key, words);
    }
    if (!this.#isNewer) this.#refused = refused;
    this.onRefused();
  }

  /** The keys of the edits that are wrong, or TEXT. Where the program names none, it is the last edit. */
  #culprits(problems, edits) {
    const named = edits.map(([key]) => key).filter(key => problems.some(({origin}) => origin === key));
    if (named.length > 0) return named;
    return [edits.at(-1)?.[0] ?? TEXT];
  }

  /** @returns what is wrong; nothing if the program has accepted it. */
  async #try(wish) {
    // A step is relative to the picture that is shown, so it means nothing in another scene.
    const place = this.#wantedPlace?.step ? null : this.#wantedPlace;
    this.#tried = {edits: wish.edits.filter(edit => !this.#state.edits.includes(edit)),
      text: wish.text === this.#state.text ? null : wish.text};
    let answer;
    try {
      answer = await this.#call("open", {text: wish.text, settings: linesOf(wish.edits),
        places: place ? [place, this.#place] : [this.#place], screen: this.#screen});
    } catch (error) {
      if (!(error instanceof Refusal)) throw error;
      return error.problems;
    }
    this.#hasScene = true;
    this.facts = answer.facts;
    this.#accept(wish);
    if (place && place === this.#wantedPlace) this.#wantedPlace = null;
    if (place && answer.placeProblem === "") this.#place = place;
    // The picture first: it is what a hand on a slider waits for.
    this.onPicture(answer.picture);
    this.onShown(answer.picture.shown);
    this.#leftOut = answer.leftOut;
    this.onOpened(answer.facts, answer.leftOut);
    this.onPlaceProblem(place ? answer.placeProblem : "");
    return [];
  }

  #accept(wish) {
    this.#state = wish;
    // Bodies are counted from those of the text, so it has to have them before the next edit.
    if (!wish.edits.some(isOfBodies)) return;
    this.#state = {text: this.facts.toml, edits: []};
    const isDone = edit => wish.edits.includes(edit);
    this.#wish = {text: this.#state.text, edits: this.#wish.edits.filter(edit => !isDone(edit))};
  }
}

export {wordsOf};
