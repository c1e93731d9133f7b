// The sound of the film in the browser.
// In: the source of a scene, a second of its film. Out: what is heard, and the clock of it.

import {Failure, Program} from "./program.js";

/** Plays the sound of the film that is open: the program's samples, a piece after the other. */
export class SoundPlayer {
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
   * @param source  text and settings of the scene
   * @returns when the second is heard, on the clock now_s(); null if another call has ended this one */
  async play({text, settings}, second) {
    this.stop();
    const playback = this.#playback;
    this.#context ??= new AudioContext({sampleRate: SoundPlayer.#rate_hz});
    await Promise.race([this.#context.resume(), SoundPlayer.#startTimeout()]);
    try {
      const isOpen = playback === this.#playback && await this.#open(playback, text, settings);
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
