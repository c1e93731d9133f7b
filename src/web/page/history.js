// What has been shown: each scene and each edit is a step back.
// In: accepted scenes. Out: steps in the browser's history, whose Back and Forward go through them.

import {options} from "./dom.js";

/** Changes of one key that follow each other so soon are one step: a slider that is dragged. */
const ONE_STEP_ms = 1000;
/** Steps of an earlier load of the page are only addresses. */
const LOAD = Math.random();
/** A page inside another one leaves that one's Back alone. */
const isEmbedded = options.get("embed") === "1";

const isOwnStep = () => history.state?.load === LOAD;

export class Steps {
  #session;
  /** Snapshots of the session, by their numbers, which are in history.state. */
  #snapshots = [];
  #now = -1;
  #last = {target: "", time: 0};
  /** Something has been taken back, or done again. */
  onRestored = () => {};
  /** Somebody has gone to another address of the page. */
  onAddress = () => {};

  constructor(session) {
    this.#session = session;
    addEventListener("popstate", () => {
      const snapshot = isOwnStep() ? this.#snapshots[history.state.step] : null;
      if (!snapshot) {
        this.onAddress();
        return;
      }
      this.#now = history.state.step;
      this.#last = {target: "", time: 0};
      session.restore(snapshot);
      this.onRestored();
    });
  }

  get canUndo() {
    return this.#now > 0 && !isEmbedded;
  }
  undo() {
    if (this.canUndo) history.back();
  }

  /** The program has accepted a scene. */
  add() {
    const {snapshot} = this.#session;
    const before = this.#snapshots[this.#now];
    if (before && before.text === snapshot.text && JSON.stringify(before.edits) === JSON.stringify(snapshot.edits)) return;
    const target = `${snapshot.text}\n${snapshot.edits.at(-1)?.[0] ?? ""}`;
    const isSoon = snapshot.edits.length > 0 && target === this.#last.target &&
      performance.now() - this.#last.time < ONE_STEP_ms;
    this.#last = {target, time: performance.now()};
    if (!isSoon) this.#snapshots.length = ++this.#now;
    this.#snapshots[this.#now] = snapshot;
    // An address that somebody went to has made an entry already.
    if (!isSoon) this.#change(isOwnStep() && !isEmbedded ? "pushState" : "replaceState", location.href);
  }

  /** The place that is shown belongs to the step, and so does the address. */
  update(address) {
    const snapshot = this.#snapshots[this.#now];
    if (!snapshot) return;
    snapshot.place = this.#session.snapshot.place;
    this.#change("replaceState", address);
  }

  #change(method, address) {
    try {
      history[method]({load: LOAD, step: this.#now}, "", address);
    } catch {
      // Some browsers and frames let pages change no address, or not so long ones, or not so often.
    }
  }
}
