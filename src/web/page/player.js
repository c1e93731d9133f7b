// Time: the film runs, or goes from frame to frame and from collision to collision.
// In: what is shown, buttons, keys. Out: places to show.

import {all, approximate, byId, makeTimer, sayIn} from "./dom.js";
import {SoundPlayer} from "./sound.js";

const seconds = () => performance.now() / 1000;

export class Player {
  #session;
  #sound = new SoundPlayer();
  #isSoundOn = false;
  #isPlaying = false;
  /** Whether somebody has chosen the place that is shown. */
  isPlaceChosen = true;
  /** Seconds of the film in a second. */
  #speed = 1;
  /** What is shown, as the program says. */
  #shown = null;
  /** When second 0 of the film was, on the clock in use. */
  #start_s = 0;
  #clock_s = seconds;
  /** Identifies the playback that goes on; a newer one replaces it. */
  #playback = null;
  #restart = makeTimer(300, () => this.#isPlaying && this.play());
  onPause = () => {};
  /** Somebody has stepped to another place, or has gone there. */
  onStep = () => {};
  onPlay = () => {};

  constructor(session) {
    this.#session = session;
    this.#sound.onDelay = delay_s => this.#start_s += delay_s;
    this.#sound.onFailed = error => this.#goOnSilently(error);
    this.slider = byId("time-slider");
    this.slider.addEventListener("input", () => this.goTo(Number(this.slider.value)));
    const actions = {play: () => this.toggle(), "play-first": () => this.play(), start: () => this.goTo(0),
      end: () => this.goTo(this.frames - 1), turn: () => this.show({instant: "turn"}), "turn-in-more": () => this.show({instant: "turn"}),
      "previous-frame": () => this.#stepFrames(-1), "next-frame": () => this.#stepFrames(1),
      "previous-collision": () => this.step(-1), "next-collision": () => this.step(1),
      sound: () => this.#toggleSound(), go: () => this.#goToInstant()};
    for (const [name, action] of Object.entries(actions)) byId(name).addEventListener("click", action);
    byId("instant").addEventListener("keydown", event => {
      if (event.key === "Enter") this.#goToInstant();
    });
    for (const button of all("#speeds button")) {
      button.addEventListener("click", () => this.#setSpeed(Number(button.value)));
    }
  }

  get frames() {
    return this.#session.facts?.frames ?? 0;
  }
  get #rate() {
    const [above, below] = this.#session.facts.rate;
    return above / below;
  }
  get frame() {
    return this.#shown?.frame ?? this.#shown?.nearFrame ?? 0;
  }
  get isPlaying() {
    return this.#isPlaying;
  }

  show(place) {
    this.pause();
    this.#session.show(place);
    this.onStep();
  }
  goTo(frame) {
    if (this.frames > 0) this.show({frame: Math.max(0, Math.min(this.frames - 1, Math.round(frame)))});
  }
  /** To the next collision (1), or the one before (-1). */
  step(direction) {
    this.show({step: direction});
  }
  #stepFrames(count) {
    this.goTo(this.frame + count);
  }
  #goToInstant() {
    const instant = byId("instant").value.trim();
    if (instant) this.show({instant});
  }

  update(facts) {
    this.slider.max = Math.max(0, this.frames - 1);
    const hasFilm = facts.frames !== null;
    this.slider.disabled = !hasFilm;
    for (const name of ["play", "start", "end", "previous-frame", "next-frame"]) byId(name).disabled = !hasFilm;
    for (const name of ["previous-collision", "next-collision"]) byId(name).disabled = facts.kind !== "scene";
    for (const name of ["turn", "turn-in-more"]) {
      byId(name).disabled = !facts.hasTurn;
      byId(name).title = facts.hasTurn ? "The turn, where the blocks are nearest to the wall and collisions are densest"
        : "Only two blocks beside a wall have a turn.";
    }
    if (this.#isPlaying && hasFilm) this.#goOnInAnotherFilm();
    else if (this.#isPlaying) this.pause();
  }

  updateShown(shown) {
    this.#shown = shown;
    if (shown.nearFrame !== null) this.slider.value = shown.nearFrame;
    this.slider.setAttribute("aria-valuetext", `${(this.frame / this.#rate).toFixed(2)} s of the film`);
  }

  toggle() {
    if (this.#isPlaying) this.pause();
    else this.play();
  }

  /** From its start without the hold there, which is for lecturers. */
  async play({isSilent = !this.#isSoundOn} = {}) {
    if (this.frames === 0) return;
    const isAtEnd = this.frame === 0 || this.frame >= this.frames - 1;
    const second = isAtEnd ? approximate(this.#session.facts.keys["time.hold-start"]?.[0] ?? "0") : this.frame / this.#rate;
    this.isPlaceChosen = false;
    this.#setPlaying(true);
    this.#sound.stop();
    this.#restart.stop();
    const playback = {};
    this.#playback = playback;
    this.#setClock(second, seconds);
    // A film that is slowed down would have to be resampled.
    if (!isSilent && this.#speed === 1) await this.#playSound(playback, second);
    this.#tick(playback);
  }

  async #playSound(playback, second) {
    try {
      const heard_s = await this.#sound.play(this.#session.source, second);
      if (heard_s === null || playback !== this.#playback) return;
      this.#clock_s = () => this.#sound.now_s();
      this.#start_s = heard_s - second;
    } catch (error) {
      if (playback !== this.#playback) return;
      this.#goOnSilently(error);
      this.#setClock(second, seconds);
    }
  }

  #setClock(second, clock_s) {
    this.#clock_s = clock_s;
    this.#start_s = clock_s() - second / this.#speed;
  }
  get #second() {
    return (this.#clock_s() - this.#start_s) * this.#speed;
  }

  #goOnSilently(error) {
    this.#setSound(false);
    sayIn(byId("sound-problem"), `No sound: ${error.message}`);
    this.#setClock(this.#second, seconds);
  }

  /** Silently while somebody still changes it; its sound begins a moment after the last change. */
  #goOnInAnotherFilm() {
    this.play({isSilent: true});
    if (this.#isSoundOn) this.#restart.start();
  }

  #tick(playback) {
    if (playback !== this.#playback) return;
    const frame = Math.floor(this.#second * this.#rate);
    if (frame >= this.frames) {
      this.goTo(this.frames - 1);
      this.isPlaceChosen = false;
      return;
    }
    if (frame >= 0 && frame !== this.frame && !this.#session.isBusy) this.#session.show({frame});
    requestAnimationFrame(() => this.#tick(playback));
  }

  pause() {
    this.#sound.stop();
    this.#restart.stop();
    this.#playback = null;
    this.isPlaceChosen = true;
    const wasPlaying = this.#isPlaying;
    this.#setPlaying(false);
    if (wasPlaying) this.onPause();
  }

  #setPlaying(isPlaying) {
    this.#isPlaying = isPlaying;
    byId("play").textContent = isPlaying ? "Pause" : "Play";
    document.body.dataset.isPlaying = String(isPlaying);
    if (isPlaying) this.onPlay();
  }

  #setSound(isOn) {
    this.#isSoundOn = isOn;
    sayIn(byId("sound-problem"), "");
    byId("sound").setAttribute("aria-pressed", String(isOn));
  }
  #toggleSound() {
    this.#setSound(!this.#isSoundOn);
    if (this.#isSoundOn && this.#speed !== 1) this.#setSpeed(1);
    else if (this.#isPlaying) this.play();
  }

  #setSpeed(speed) {
    this.#speed = speed;
    for (const button of all("#speeds button")) {
      button.setAttribute("aria-pressed", String(Number(button.value) === speed));
    }
    if (speed !== 1 && this.#isSoundOn) sayIn(byId("sound-problem"), "Sound is heard at 1× only.");
    else sayIn(byId("sound-problem"), "");
    if (this.#isPlaying) this.play();
  }
}
