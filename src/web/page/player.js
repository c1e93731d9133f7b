// Time: the film runs, or goes from frame to frame and from collision to collision.
// In: what is shown, buttons, keys, fingers. Out: places to show.

/** Plays the sound of the film that is open: the program's samples, a piece after the other. */
class SoundPlayer {
  static #rate_hz = 48000;
  static #piece = 24000;
  static #ahead_s = 1.2;

  #program = null;
  /** The film whose sound the program has. */
  #opened = null;
  #context = null;
  #sources = new Set();
  #playback = 0;
  /** Samples came too late; all later ones are heard so much later. */
  onDelay = delay_s => {};
  onFailed = error => {};

  /** Begins at this second of the film.
   * @param source  {text, edits} of the scene
   * @returns when the second is heard, on the clock now_s(); null if another call has ended this one */
  async play({text, edits}, second) {
    this.stop();
    const playback = this.#playback;
    this.#context ??= new AudioContext({sampleRate: SoundPlayer.#rate_hz});
    await Promise.race([this.#context.resume(), SoundPlayer.#startTimeout()]);
    try {
      const isOpen = playback === this.#playback && await this.#open(playback, text, edits.lines);
      if (!isOpen) return null;
      const first = Math.round(second * SoundPlayer.#rate_hz);
      const samples = await this.#read(first);
      if (playback !== this.#playback) return null;
      const start_s = this.#context.currentTime + 0.05;
      this.#feed(playback, first, samples, start_s).catch(error => this.#fail(playback, error));
      return start_s - first / SoundPlayer.#rate_hz + second;
    } catch (error) {
      if (error instanceof Failure) this.#program = null;
      if (playback !== this.#playback) return null;
      throw error;
    }
  }

  #fail(playback, error) {
    if (error instanceof Failure) this.#program = null;
    if (playback === this.#playback) this.onFailed(error);
  }

  /** A browser that refuses sound does not say so. */
  static async #startTimeout() {
    const wasUsed = navigator.userActivation?.hasBeenActive ?? true;
    await new Promise(resolve => setTimeout(resolve, wasUsed ? 5000 : 1000));
    throw new Error(wasUsed ? "the audio device did not start" : "the browser allows it only after a click");
  }

  /** @returns whether it is still wanted. */
  async #open(playback, text, settings) {
    if (!this.#program) this.#opened = null;
    this.#program ??= new Program();
    const film = `${settings}\n${text}`;
    if (this.#opened === film) return true;
    this.#opened = null;
    await this.#program.call("open", {text, settings});
    if (playback !== this.#playback) return false;
    await this.#program.call("openSound");
    if (playback !== this.#playback) return false;
    this.#opened = film;
    return true;
  }

  #read(first) {
    return this.#program.call("readSound", {first, count: SoundPlayer.#piece});
  }

  /** What is heard now began to be played a little earlier. */
  now_s() {
    return this.#context.currentTime - (this.#context.outputLatency || 0);
  }

  async #feed(playback, first, samples, at_s) {
    while (samples.length > 0) {
      this.#start(samples, at_s);
      first += samples.length / 2;
      at_s += samples.length / 2 / SoundPlayer.#rate_hz;
      samples = await this.#read(first);
      while (at_s - this.#context.currentTime > SoundPlayer.#ahead_s) {
        await new Promise(resolve => setTimeout(resolve, 100));
        if (playback !== this.#playback) return;
      }
      if (playback !== this.#playback) return;
      const delay_s = this.#context.currentTime - at_s;
      if (delay_s > 0) {
        at_s += delay_s;
        this.onDelay(delay_s);
      }
    }
  }

  #start(samples, at_s) {
    const pairs = samples.length / 2;
    const buffer = this.#context.createBuffer(2, pairs, SoundPlayer.#rate_hz);
    for (const side of [0, 1]) {
      const channel = buffer.getChannelData(side);
      for (let i = 0; i < pairs; ++i) channel[i] = samples[2 * i + side];
    }
    const source = new AudioBufferSourceNode(this.#context, {buffer});
    source.connect(this.#context.destination);
    source.onended = () => this.#sources.delete(source);
    source.start(at_s);
    this.#sources.add(source);
  }

  stop() {
    ++this.#playback;
    for (const source of this.#sources) source.stop();
    this.#sources.clear();
  }
}

class Player {
  #scene;
  #sound = new SoundPlayer();
  #isSoundOn = false;
  #isPlaying = false;
  /** What is shown, as the program says. */
  #shown = null;
  /** When second 0 of the film was, on the clock in use. */
  #start_s = 0;
  #clock_s = () => performance.now() / 1000;
  /** Identifies the playback that goes on; a newer one replaces it. */
  #playback = null;
  #restart = null;
  onPause = () => {};

  constructor(scene) {
    this.#scene = scene;
    this.#sound.onDelay = delay_s => this.#start_s += delay_s;
    this.#sound.onFailed = error => this.#goOnSilently(error);
    this.slider = byId("time-slider");
    this.slider.addEventListener("input", () => this.#goTo(Number(this.slider.value)));
    const actions = {play: () => this.toggle(), start: () => this.#goTo(0),
      end: () => this.#goTo(this.#frames - 1), turn: () => this.#show({instant: "turn"}),
      "previous-frame": () => this.#step(-1), "next-frame": () => this.#step(1),
      "previous-collision": () => this.#show({step: -1}),
      "next-collision": () => this.#show({step: 1}), sound: () => this.#toggleSound(),
      "full-screen": () => this.#toggleFullScreen(), go: () => this.#goToInstant()};
    for (const [name, action] of Object.entries(actions)) {
      byId(name).addEventListener("click", action);
    }
    byId("instant").addEventListener("keydown", event => {
      if (event.key === "Enter") this.#goToInstant();
    });
    byId("full-screen").hidden = !byId("screen").requestFullscreen;
    this.#listenToKeys();
    this.#listenToFingers(byId("picture"));
  }

  get #facts() {
    return this.#scene.facts;
  }
  get #frames() {
    return this.#facts?.frames ?? 0;
  }
  get #rate() {
    const [above, below] = this.#facts.rate;
    return above / below;
  }
  get #frame() {
    return this.#shown?.frame ?? this.#shown?.nearFrame ?? 0;
  }

  #show(place) {
    this.pause();
    this.#scene.show(place);
  }
  #goTo(frame) {
    if (this.#frames > 0) this.#show({frame: Math.max(0, Math.min(this.#frames - 1, frame))});
  }
  #goToInstant() {
    const instant = byId("instant").value.trim();
    if (instant) this.#show({instant});
  }
  #step(frames) {
    this.#goTo(this.#frame + frames);
  }

  update(facts) {
    this.slider.max = Math.max(0, this.#frames - 1);
    const hasFilm = facts.frames !== null;
    this.slider.disabled = !hasFilm;
    for (const name of ["play", "start", "end", "previous-frame", "next-frame"]) {
      byId(name).disabled = !hasFilm;
    }
    const isScene = facts.kind === "scene";
    for (const name of ["previous-collision", "next-collision"]) byId(name).disabled = !isScene;
    byId("turn").disabled = !facts.hasTurn;
    if (this.#isPlaying && hasFilm) this.#goOnInAnotherFilm();
    else if (this.#isPlaying) this.pause();
  }

  updateShown(shown) {
    this.#shown = shown;
    if (shown.nearFrame !== null) this.slider.value = shown.nearFrame;
    const time = `${(this.#frame / this.#rate).toFixed(2)} s of the film`;
    this.slider.setAttribute("aria-valuetext", time);
  }

  get isPlaying() {
    return this.#isPlaying;
  }

  toggle() {
    if (this.#isPlaying) this.pause();
    else this.play();
  }

  async play({isSilent = !this.#isSoundOn} = {}) {
    if (this.#frames === 0) return;
    const isAtEnd = this.#frame >= this.#frames - 1;
    const second = isAtEnd ? 0 : this.#frame / this.#rate;
    this.#setPlaying(true);
    this.#sound.stop();
    clearTimeout(this.#restart);
    const playback = {};
    this.#playback = playback;
    this.#setClock(second, () => performance.now() / 1000);
    if (!isSilent) await this.#playSound(playback, second);
    this.#tick(playback);
  }

  async #playSound(playback, second) {
    try {
      const heard_s = await this.#sound.play(this.#scene.source, second);
      if (heard_s === null || playback !== this.#playback) return;
      this.#clock_s = () => this.#sound.now_s();
      this.#start_s = heard_s - second;
    } catch (error) {
      if (playback !== this.#playback) return;
      this.#goOnSilently(error);
      this.#setClock(second, () => performance.now() / 1000);
    }
  }

  #setClock(second, clock_s) {
    this.#clock_s = clock_s;
    this.#start_s = clock_s() - second;
  }

  #goOnSilently(error) {
    this.#setSound(false);
    sayIn(byId("sound-problem"), `No sound: ${error.message}`);
    this.#setClock(this.#clock_s() - this.#start_s, () => performance.now() / 1000);
  }

  /** Silently while somebody still changes it; its sound begins a moment after the last change. */
  #goOnInAnotherFilm() {
    this.play({isSilent: true});
    if (this.#isSoundOn) this.#restart = setTimeout(() => this.#isPlaying && this.play(), 300);
  }

  #tick(playback) {
    if (playback !== this.#playback) return;
    const frame = Math.floor((this.#clock_s() - this.#start_s) * this.#rate);
    if (frame >= this.#frames) {
      this.#goTo(this.#frames - 1);
      return;
    }
    if (frame >= 0 && frame !== this.#frame && !this.#scene.isBusy) this.#scene.show({frame});
    requestAnimationFrame(() => this.#tick(playback));
  }

  pause() {
    this.#sound.stop();
    clearTimeout(this.#restart);
    this.#playback = null;
    const wasPlaying = this.#isPlaying;
    this.#setPlaying(false);
    if (wasPlaying) this.onPause();
  }

  #setPlaying(isPlaying) {
    this.#isPlaying = isPlaying;
    byId("play").textContent = isPlaying ? "Pause" : "Play";
  }

  #setSound(isOn) {
    this.#isSoundOn = isOn;
    sayIn(byId("sound-problem"), "");
    byId("sound").setAttribute("aria-pressed", String(isOn));
  }
  #toggleSound() {
    this.#setSound(!this.#isSoundOn);
    if (this.#isPlaying) this.play();
  }

  #toggleFullScreen() {
    if (document.fullscreenElement) document.exitFullscreen();
    else byId("screen").requestFullscreen().catch(() => {});
  }

  #listenToKeys() {
    const keys = {" ": "play", Home: "start", End: "end", ArrowLeft: "previous-frame",
      ArrowRight: "next-frame", ",": "previous-collision", ".": "next-collision", t: "turn",
      m: "sound", f: "full-screen"};
    document.addEventListener("keydown", event => {
      if (event.ctrlKey || event.altKey || event.metaKey) return;
      const button = byId(keys[event.key]);
      if (!button || this.#isKeyOf(event.target, event.key)) return;
      event.preventDefault();
      if (!button.disabled) button.click();
    });
  }

  /** Whether an element does something of its own at this key. */
  #isKeyOf(element, key) {
    if (element === this.slider) return key.startsWith("Arrow");
    if (element.closest("button, summary, a")) return key === " ";
    return element.closest("input, select, textarea") !== null;
  }

  /** A drag across the picture goes through the whole film; a tap plays and pauses. */
  #listenToFingers(picture) {
    let start = null;
    picture.addEventListener("pointerdown", event => {
      if (!event.isPrimary || event.button !== 0) return;
      start = {x: event.clientX, frame: this.#frame, isDrag: false, pointer: event.pointerId};
      picture.setPointerCapture(event.pointerId);
    });
    picture.addEventListener("pointermove", event => {
      if (event.pointerId !== start?.pointer) return;
      const moved = event.clientX - start.x;
      start.isDrag ||= Math.abs(moved) > 5;
      const share = moved / picture.getBoundingClientRect().width;
      if (start.isDrag) this.#goTo(Math.round(start.frame + share * (this.#frames - 1)));
    });
    picture.addEventListener("pointerup", event => {
      if (event.pointerId !== start?.pointer) return;
      if (!start.isDrag) this.toggle();
      start = null;
    });
    picture.addEventListener("pointercancel", () => start = null);
  }
}
