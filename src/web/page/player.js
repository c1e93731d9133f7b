// Time: the film runs, or goes from frame to frame and from collision to collision.
// In: what is shown, buttons, keys, fingers. Out: places to show.

/** Sound of the film that is open: the program's samples, a piece after the other. */
class FilmSound {
  static #rate_hz = 48000;
  static #piece = 24000;
  static #ahead_s = 1.2;

  #program = null;
  #text = null;
  #context = null;
  #sources = new Set();
  #run = 0;

  /** Begins at this second of the film. @returns when the second is heard, on the clock now_s(). */
  async play(text, second) {
    this.stop();
    const run = this.#run;
    this.#context ??= new AudioContext({sampleRate: FilmSound.#rate_hz});
    await this.#context.resume();
    this.#program ??= new Program();
    if (this.#text !== text) {
      await this.#program.call("open", {text, settings: ""});
      await this.#program.call("openSound");
      this.#text = text;
    }
    const first = Math.round(second * FilmSound.#rate_hz);
    const samples = await this.#read(first);
    if (run !== this.#run) return null;
    const start_s = this.#context.currentTime + 0.05;
    this.#feed(run, first, samples, start_s);
    return start_s - first / FilmSound.#rate_hz + second;
  }

  #read(first) {
    return this.#program.call("readSound", {first, count: FilmSound.#piece});
  }

  now_s() {
    return this.#context.currentTime;
  }

  async #feed(run, first, samples, at_s) {
    while (samples.length > 0) {
      this.#start(samples, at_s);
      first += samples.length / 2;
      at_s += samples.length / 2 / FilmSound.#rate_hz;
      samples = await this.#read(first);
      while (at_s - this.now_s() > FilmSound.#ahead_s) {
        await new Promise(resolve => setTimeout(resolve, 100));
        if (run !== this.#run) return;
      }
      if (run !== this.#run) return;
    }
  }

  #start(samples, at_s) {
    const pairs = samples.length / 2;
    const buffer = this.#context.createBuffer(2, pairs, FilmSound.#rate_hz);
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
    ++this.#run;
    for (const source of this.#sources) source.stop();
    this.#sources.clear();
  }
}

class Player {
  #scene;
  #sound = new FilmSound();
  #hasSound = false;
  #isPlaying = false;
  /** What is shown, as the program says. */
  #place = null;
  /** When second 0 of the film was, on the clock in use. */
  #start_s = 0;
  #clock_s = () => performance.now() / 1000;

  constructor(scene) {
    this.#scene = scene;
    this.slider = byId("time-slider");
    this.slider.addEventListener("input", () => this.#goTo(Number(this.slider.value)));
    const actions = {play: () => this.toggle(), start: () => this.#goTo(0),
      end: () => this.#goTo(this.#frames - 1), turn: () => this.#show({instant: "turn"}),
      "previous-frame": () => this.#step(-1), "next-frame": () => this.#step(1),
      "previous-collision": () => this.#stepCollision(-1),
      "next-collision": () => this.#stepCollision(1), sound: () => this.#toggleSound(),
      "full-screen": () => this.#toggleFullScreen(), go: () => this.#goToInstant()};
    for (const [name, action] of Object.entries(actions)) {
      byId(name).addEventListener("click", action);
    }
    byId("instant").addEventListener("keydown", event => {
      if (event.key === "Enter") this.#goToInstant();
    });
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
    return this.#place?.frame ?? this.#place?.nearFrame ?? 0;
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

  /** From what is shown to the collision before or after it. */
  #stepCollision(step) {
    if (!this.#place?.state || this.#facts.collisions === "infinite" && this.#count === null) return;
    const isAtCollision = this.#at !== null && this.#at === this.#count;
    const first = BigInt(this.#facts.firstCollision);
    const target = step > 0 ? this.#count + 1n : isAtCollision ? this.#count - 1n : this.#count;
    const last = this.#facts.collisions === "infinite" ? null : BigInt(this.#facts.collisions);
    if (target < first) return this.#goTo(0);
    if (last !== null && target > last && !this.#facts.mayGoOn) return;
    this.#at = target;
    this.#show({instant: `#${target}`});
  }
  /** The collision that was gone to. */
  #at = null;
  get #count() {
    const count = JSON.parse(this.#place.state).collisions;
    return count === "infinite" ? null : BigInt(count);
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
    if (this.#isPlaying) this.play();
  }

  updatePlace(place) {
    this.#place = place;
    if (place.frame !== null) this.#at = null;
    if (place.nearFrame !== null) this.slider.value = place.nearFrame;
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

  async play() {
    if (this.#frames === 0) return;
    const isAtEnd = this.#frame >= this.#frames - 1;
    const second = isAtEnd ? 0 : this.#frame / this.#rate;
    this.#setPlaying(true);
    this.#sound.stop();
    this.#clock_s = () => performance.now() / 1000;
    this.#start_s = this.#clock_s() - second;
    if (this.#hasSound) {
      try {
        const heard_s = await this.#sound.play(this.#scene.text, second);
        if (heard_s === null || !this.#isPlaying) return;
        this.#start_s = heard_s - second;
        this.#clock_s = () => this.#sound.now_s();
      } catch (error) {
        this.#setSound(false);
        byId("notes").hidden = false;
        byId("notes").textContent = `No sound: ${error.message}`;
        this.#start_s = this.#clock_s() - second;
      }
    }
    this.#run = {};
    this.#tick(this.#run);
  }
  #run = null;

  #tick(run) {
    if (!this.#isPlaying || run !== this.#run) return;
    const frame = Math.floor((this.#clock_s() - this.#start_s) * this.#rate);
    const isOver = frame >= this.#frames - 1;
    if (isOver) {
      this.#goTo(this.#frames - 1);
      return;
    }
    if (frame >= 0 && frame !== this.#frame && !this.#scene.isBusy) this.#scene.show({frame});
    requestAnimationFrame(() => this.#tick(run));
  }

  pause() {
    this.#sound.stop();
    this.#setPlaying(false);
  }

  #setPlaying(isPlaying) {
    this.#isPlaying = isPlaying;
    byId("play").textContent = isPlaying ? "Pause" : "Play";
  }

  #setSound(hasSound) {
    this.#hasSound = hasSound;
    byId("sound").setAttribute("aria-pressed", String(hasSound));
  }
  #toggleSound() {
    this.#setSound(!this.#hasSound);
    if (this.#isPlaying) this.play();
  }

  #toggleFullScreen() {
    if (document.fullscreenElement) document.exitFullscreen();
    else byId("screen").requestFullscreen?.();
  }

  #listenToKeys() {
    const keys = {" ": "play", Home: "start", End: "end", ArrowLeft: "previous-frame",
      ArrowRight: "next-frame", ",": "previous-collision", ".": "next-collision", t: "turn",
      m: "sound", f: "full-screen"};
    document.addEventListener("keydown", event => {
      if (event.ctrlKey || event.altKey || event.metaKey) return;
      // Fields and buttons have keys of their own.
      if (event.target.closest("input, select, textarea, button, summary, a")
          && event.target !== this.slider) return;
      const isOfSlider = event.target === this.slider && event.key.startsWith("Arrow");
      const button = byId(keys[event.key]);
      if (!button || isOfSlider) return;
      event.preventDefault();
      if (!button.disabled) button.click();
    });
  }

  /** A drag across the picture goes through the whole film; a tap plays and pauses. */
  #listenToFingers(picture) {
    let start = null;
    picture.addEventListener("pointerdown", event => {
      start = {x: event.clientX, frame: this.#frame, isDrag: false};
      picture.setPointerCapture(event.pointerId);
    });
    picture.addEventListener("pointermove", event => {
      if (start === null) return;
      const moved = event.clientX - start.x;
      start.isDrag ||= Math.abs(moved) > 5;
      const share = moved / picture.getBoundingClientRect().width;
      if (start.isDrag) this.#goTo(Math.round(start.frame + share * (this.#frames - 1)));
    });
    picture.addEventListener("pointerup", () => {
      if (start !== null && !start.isDrag) this.toggle();
      start = null;
    });
    picture.addEventListener("pointercancel", () => start = null);
  }
}
