// What has been shown: each scene and each edit is a step back.
// In: accepted scenes. Out: steps in the browser's history, whose Back and Forward go through them.

/** Changes of one key that follow each other so soon are one step: a slider that is dragged. */
const ONE_STEP_ms = 1000;

export class Steps {
  #session;
  /** Snapshots of the session, by their numbers, which are in history.state. */
  #snapshots = [];
  #now = -1;
  #last = {words: "", time: 0};
  /** Something has been taken back, or done again. */
  onRestored = () => {};

  constructor(session) {
    this.#session = session;
    addEventListener("popstate", event => {
      const snapshot = this.#snapshots[event.state?.step];
      if (!snapshot) return;
      this.#now = event.state.step;
      session.restore(snapshot);
      this.onRestored();
    });
  }

  get canUndo() {
    return this.#now > 0;
  }
  undo() {
    if (this.canUndo) history.back();
  }
  /** To the newest step with this property. @returns whether there is one */
  backTo(isIt) {
    const step = this.#snapshots.slice(0, this.#now).map(isIt).lastIndexOf(true);
    if (step >= 0) history.go(step - this.#now);
    return step >= 0;
  }
  has(isIt) {
    return this.#snapshots.slice(0, Math.max(0, this.#now)).some(isIt);
  }

  /** The program has accepted a scene. @param leftOut  what it could not show */
  note(leftOut) {
    const snapshot = {...this.#session.snapshot, leftOut};
    const before = this.#snapshots[this.#now];
    const isSame = before && before.text === snapshot.text &&
      JSON.stringify(before.edits) === JSON.stringify(snapshot.edits);
    if (isSame) {
      this.#snapshots[this.#now] = snapshot;
      return;
    }
    const words = `${snapshot.text}\n${snapshot.edits.at(-1)?.[0] ?? ""}`;
    const isSoon = snapshot.edits.length > 0 && words === this.#last.words &&
      performance.now() - this.#last.time < ONE_STEP_ms;
    this.#last = {words, time: performance.now()};
    if (!isSoon) {
      this.#snapshots.length = ++this.#now;
    }
    this.#snapshots[this.#now] = snapshot;
    this.#change(isSoon || this.#now === 0 ? "replaceState" : "pushState", location.href);
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
      history[method]({step: this.#now}, "", address);
    } catch {
      // Some browsers and frames let pages change no address, or not so long ones, or not so often.
    }
  }
}
