// The scene that the page shows, and the one that somebody wants.
// In: wishes: a text, edits of keys, a place in the film, a size. Out: calls of `on…`: what the program
// makes of them.
//
// There is one state, which the program has accepted, and what is wanted beyond it: another text, newer
// edits. Both go to the program as a whole. Edits that were typed and refused stay wanted, with what is
// wrong; others are dropped.

import {Failure, Program, Refusal, STOPPED} from "./program.js";

/** A newer wish ends work that has lasted longer than this; longer each time, until work is done. */
const PATIENCE_ms = 1500;
const TOO_LONG = {origin: "", key: "", reason: "Not applied: it took too long, and something else was asked for."};
/** The problems of the text and of the program are under these names, those of an edit under its key. */
export const TEXT = "text";
export const BROKEN = "program";

/** The lines that the program reads: a value, or null for the key's default. */
const linesOf = edits => edits.map(([key, value]) => value === null ? key : `${key}=${value}`).join("\n");

/** The number in "body 2" or "body 2.mass". */
const numberOf = key => Number(key.match(/^body (\d+)/)?.[1]);

const nothing = () => ({text: null, edits: []});

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
  /** Lists of keys that set one value, from the program. */
  keysOfOneValue = [];

  #program = new Program();
  /** What the program has accepted: `edits` are [key, value] in the order in which they were made. */
  #state = {text: "", edits: []};
  /** @type {Place} */
  #place = {frame: 0};
  /** What is wanted beyond the state: edits of it or, if there is a text, of that. */
  #wanted = nothing();
  /** @type {Place | null} */
  #wantedPlace = null;
  #screen = "";
  #leftOut = [];
  #isNewer = false;
  #isWorking = false;
  #work = Promise.resolve();
  /** The newest task that is no wish: choices, or a file.
   * @type {Promise<any>} */
  #sideTask = Promise.resolve();
  /** What is wrong with edits that are still wanted, and what was with those that were dropped. */
  #refused = new Map();
  #dropped = new Map();
  #problemsOfText = [];
  #typed = new Set();
  /** What the program tries. */
  #tried = nothing();
  /** Whether the program has the scene; false after a restart. */
  #hasScene = false;
  /** When the program began its task; null while it has none. */
  #since = null;
  #patience_ms = PATIENCE_ms;

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
  get refusedKeys() {
    return [...this.#refused.keys()];
  }
  problemsOf(name) {
    return name === TEXT ? this.#problemsOfText : this.#refused.get(name) ?? [];
  }
  /** Why the last edit of this key was dropped. */
  reasonsAgainst(key) {
    return this.#dropped.get(key) ?? [];
  }

  /** Shows another scene. @param place  in its film, as that of worker.js; or where it is now */
  open(text, place = null) {
    this.restore({text, edits: [], place});
  }

  /** The same, but the message about the refused text stays. */
  openInstead(text) {
    const problems = this.#problemsOfText;
    this.open(text, {frame: 0});
    this.#problemsOfText = problems;
  }

  restore({text, edits, place}) {
    this.#forgetWishes();
    this.#problemsOfText = [];
    this.#want({text, edits}, place);
  }

  /** @param value  null for the default
   * @param isTyped  only what is typed can be wrong; anything else is dropped if the program refuses it */
  edit(key, value, isTyped = false) {
    if (isTyped) this.#typed.add(key);
    else this.#typed.delete(key);
    for (const other of this.refusedKeys) {
      if (this.replaces(key, other)) this.#refused.delete(other);
    }
    this.#want({...this.#wanted, edits: this.#with(this.#wanted.edits, [[key, value]])});
  }

  /** Drops an edit that was refused. */
  forget(key) {
    if (!this.#refused.delete(key)) return;
    this.#want({...this.#wanted, edits: this.#wanted.edits.filter(([other]) => other !== key)});
  }

  /** Whether there is a newer value of this key than that of the facts. */
  isWaiting(key) {
    return this.#isNewer && this.#wanted.edits.some(([other]) => other === key);
  }
  get isTextWaiting() {
    return this.#wanted.text !== null;
  }

  /** @param place  as that of worker.js, or {step: 1}: the next collision, {step: -1}: the one before */
  show(place) {
    this.#wantedPlace = place;
    this.#begin();
  }

  /** Lays the picture out in this size, "1080x1350", or in the scene's own if it is empty. */
  setScreen(screen) {
    if (screen === this.#screen) return;
    this.#screen = screen;
    if (this.facts) this.#want(this.#wanted);
  }

  /** What cannot be added to the picture, and why. */
  choices() {
    return this.#callAside("choices");
  }

  /** Gives back the memory of a picture that is on the canvas. */
  recycle(pixels) {
    this.#program.call("recycle", {pixels}, [pixels]).catch(() => {});
  }

  /** A file of what is shown. */
  save(name) {
    return this.#callAside("save", {name});
  }

  /** Ends what the program does, and goes on with the scene that it has accepted. */
  stop() {
    this.#forgetWishes();
    this.#tried = nothing();
    this.#replaceProgram();
    this.#tellAgain();
  }

  /** Whether an edit of one key takes the place of one of another. A key that also sets something else
   * stays. */
  replaces(key, other) {
    if (key === other) return true;
    const lists = this.keysOfOneValue.filter(list => list.includes(other));
    return lists.length > 0 && lists.every(list => list.includes(key));
  }
  #with(edits, newer) {
    return [...edits.filter(([key]) => !newer.some(([by]) => this.replaces(by, key))), ...newer];
  }
  /** A text and its edits. */
  #whole({text, edits}) {
    if (text !== null) return {text, edits};
    return {text: this.#state.text, edits: this.#with(this.#state.edits, edits)};
  }

  #want(wanted, place = null) {
    this.#wanted = wanted;
    this.#isNewer = true;
    if (place) this.#wantedPlace = place;
    this.#begin();
  }

  #forgetWishes() {
    this.#wanted = nothing();
    this.#isNewer = false;
    this.#wantedPlace = null;
    this.#refused.clear();
    this.#dropped.clear();
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

  #tellAgain() {
    this.onRefused();
    if (this.facts) this.onOpened(this.facts, this.#leftOut);
  }

  async #haveScene() {
    if (this.#hasScene) return;
    const {picture} = await this.#program.call("open",
      {...this.source, places: [this.#place], screen: this.#screen});
    this.#hasScene = true;
    this.onPicture(picture);
  }

  /** Makes a file, or asks for choices, after all wishes. Only Stop ends it. */
  async #callAside(task, details = {}) {
    await this.#work;
    this.#replaceIfBroken();
    await this.#haveScene();
    this.#sideTask = this.#program.call(task, details);
    return this.#sideTask;
  }

  async #call(task, details) {
    const program = this.#program;  // one that Stop has ended stays ended
    await program.started;
    await this.#sideTask.catch(() => {});
    this.#since = performance.now();
    try {
      if (task === "show") await this.#haveScene();
      return await program.call(task, details);
    } finally {
      this.#since = null;
    }
  }

  /** Does what is asked for, when the program has time; of several wishes the last. */
  #begin() {
    // Somebody who goes on while the program still works does not want that work.
    if (this.#since !== null && performance.now() - this.#since > this.#patience_ms) {
      this.#patience_ms *= 2;
      this.#replaceProgram();
    }
    if (!this.#isWorking) this.#work = this.#workOn();
  }

  async #workOn() {
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
      // A wish that was replaced gets no message.
      const slow = this.#tried.edits.filter(edit => this.#wanted.edits.includes(edit));
      for (const [key] of slow) this.#refused.set(key, [TOO_LONG]);
      if (this.#tried.text !== null && this.#tried.text === this.#wanted.text) {
        this.#problemsOfText = [TOO_LONG];
        this.#wanted.text = null;
      }
      this.#wanted = {...this.#wanted, edits: this.#wanted.edits.filter(edit => !slow.includes(edit))};
    } else {
      this.#forgetWishes();
      const reason = "The program crashed and was restarted; changes that it had not accepted were " +
        `dropped (${error.message}).`;
      this.#refused.set(BROKEN, [{origin: "", key: "", reason}]);
      if (!(error instanceof Failure)) reportError(error);
    }
    this.#tried = nothing();
    this.#tellAgain();
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
    const {text, edits: all} = this.#wanted;
    this.#isNewer = false;
    this.#dropped.clear();
    const refused = new Map([...this.#refused].filter(([, problems]) => problems.includes(TOO_LONG)));
    for (let edits = all; ;) {
      const problems = await this.#try({text, edits});
      if (problems.length === 0) break;
      const wrong = this.#culprits(problems, edits);
      if (wrong.length === 0) {
        this.#problemsOfText = problems;
        if (this.#wanted.text === text) this.#wanted.text = null;
        break;
      }
      for (const key of wrong) {
        const mine = problems.filter(({origin}) => origin === key);
        (this.#typed.has(key) ? refused : this.#dropped).set(key, mine.length > 0 ? mine : problems);
      }
      edits = edits.filter(([key]) => !wrong.includes(key));
      // What is left is shown already.
      if (text === null && edits.length === 0) break;
    }
    this.#tried = nothing();
    const isDropped = edit => all.includes(edit) && this.#dropped.has(edit[0]);
    this.#wanted = {...this.#wanted, edits: this.#wanted.edits.filter(edit => !isDropped(edit))};
    if (!this.#isNewer) this.#refused = refused;
    this.onRefused();
  }

  /** The keys of the edits that are wrong; where the program names none of them, the last one. */
  #culprits(problems, edits) {
    const named = edits.map(([key]) => key).filter(key => problems.some(({origin}) => origin === key));
    return named.length > 0 ? named : edits.slice(-1).map(([key]) => key);
  }

  /** @returns what is wrong; nothing if the program has accepted it. */
  async #try(wanted) {
    // A step is relative to the picture that is shown, so it means nothing in another scene.
    const place = this.#wantedPlace?.step ? null : this.#wantedPlace;
    this.#tried = wanted;
    const whole = this.#whole(wanted);
    let answer;
    try {
      answer = await this.#call("open", {text: whole.text, settings: linesOf(whole.edits),
        places: place ? [place, this.#place] : [this.#place], screen: this.#screen});
    } catch (error) {
      if (!(error instanceof Refusal)) throw error;
      return error.problems;
    }
    this.#hasScene = true;
    this.facts = answer.facts;
    this.#leftOut = answer.leftOut;
    this.#accept(wanted, whole);
    if (place && place === this.#wantedPlace) this.#wantedPlace = null;
    if (place && answer.placeProblem === "") this.#place = place;
    // The picture first: it is what a hand on a slider waits for.
    this.onPicture(answer.picture);
    this.onShown(answer.picture.shown);
    this.onOpened(answer.facts, answer.leftOut);
    this.onPlaceProblem(place ? answer.placeProblem : "");
    return [];
  }

  #accept(wanted, whole) {
    this.#state = whole;
    const {text} = this.#wanted;
    let edits = this.#wanted.edits.filter(edit => !wanted.edits.includes(edit));
    if (whole.edits.some(([key]) => key.startsWith("body "))) {
      // Bodies are counted from those of the text, so it has to have them before the next edit.
      this.#state = {text: this.facts.toml, edits: []};
      edits = renumbered(edits, whole.edits.filter(([, value]) => value === null).map(([key]) => numberOf(key)));
    }
    this.#wanted = {text: text === wanted.text ? null : text, edits};
  }
}

/** Edits of bodies after these numbers are gone. */
function renumbered(edits, removed) {
  return edits.filter(([key]) => !removed.includes(numberOf(key))).map(edit => {
    const number = numberOf(edit[0]);
    const less = removed.filter(one => one < number).length;
    return less === 0 ? edit : [edit[0].replace(/\d+/, String(number - less)), edit[1]];
  });
}
