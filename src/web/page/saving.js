// Files that the page makes: pictures of what is shown; the film by several workers.
// In: the scene and a file extension. Out: a download, or a problem in the program's words.

import {all, byId, element, sayIn} from "./dom.js";
import {Failure, Program, Refusal, STOPPED} from "./program.js";
import {encodeSoundtrack} from "./soundtrack.js";

const MEDIA_TYPES = {png: "image/png", svg: "image/svg+xml", pdf: "application/pdf",
  mp4: "video/mp4", wav: "audio/wav"};
const MOST_WORKERS = 8;
const isFilm = extension => extension === "mp4" || extension === "wav";

/** The film in one file. Workers render shards of it, which are joined as those of several machines. */
class FilmMaking {
  #workers = [];

  /** Tells `onProgress` the fraction that is done. @param source  text and settings of the scene */
  async makeSound(source, {onProgress}) {
    const worker = await this.#open(source);
    worker.onProgress = onProgress;
    return (await worker.call("render", {name: "film.wav", number: 1, count: 0})).bytes;
  }

  /** The same, with pictures.
   * @returns bytes; and whether they lack sound that they should have */
  async make(source, {seconds, hasSound, onProgress}) {
    const name = "film.mp4";
    // Shards are cut at whole seconds.
    const most = Math.min(navigator.hardwareConcurrency || 2, MOST_WORKERS, Math.ceil(seconds));
    const progress = new Array(Math.max(1, most)).fill(0);
    const rendering = progress.map(async (_, i) => {
      // Its sound is added when they are joined.
      const worker = await this.#open({...source, settings: `${source.settings}\nsound.on=false`});
      worker.onProgress = done => {
        progress[i] = done;
        onProgress(progress.reduce((sum, one) => sum + one, 0) / progress.length);
      };
      const shard = await worker.call("render", {name, number: i + 1, count: progress.length});
      if (i > 0) worker.stop();  // the first one joins them
      return shard;
    });
    const [sound, ...shards] = await Promise.all([hasSound ? this.#encodeSound(source) : null, ...rendering]);
    const bytes = await this.#workers[0].call("join", {name, shards, sound},
      shards.map(shard => shard.bytes.buffer));
    return {bytes, lacksSound: hasSound && !sound};
  }

  /** A worker in which this scene is open. */
  async #open(source) {
    const worker = new Program();
    this.#workers.push(worker);
    await worker.call("open", source);
    return worker;
  }

  async #encodeSound(source) {
    const worker = await this.#open(source);
    await worker.call("openSound");
    const sound = await encodeSoundtrack((first, count) => worker.call("readSound", {first, count}));
    worker.stop();
    return sound;
  }

  stop() {
    for (const worker of this.#workers) worker.stop();
  }
}

export class Saving {
  #session;
  #making = null;
  #link = null;
  #buttons = all("[data-save]");
  /** What files are called, without an extension. */
  name = "scene";

  constructor(session, pause) {
    this.#session = session;
    for (const button of this.#buttons) {
      button.addEventListener("click", () => {
        if (!isFilm(button.dataset.save)) pause();
        this.#save(button.dataset.save);
      });
    }
    byId("cancel").addEventListener("click", () => this.#making?.stop());
  }

  async #save(extension) {
    if (!this.#session.facts) return;
    const name = `${this.name}.${extension}`;
    sayIn(byId("saving-problem"), "");
    byId("saved").hidden = true;
    try {
      const {bytes, lacksSound = false} = isFilm(extension) ? await this.#makeFilm(extension)
        : {bytes: await this.#session.save(`/picture.${extension}`)};
      this.#download(bytes, name, extension);
      if (lacksSound) byId("saved").append(" This browser encodes no sound: the film is silent.");
    } catch (error) {
      if (!(error instanceof Failure && error.message === STOPPED)) {
        sayIn(byId("saving-problem"), error.message);
      }
    }
  }

  /** @throws Failure with STOPPED if it is cancelled. */
  async #makeFilm(extension) {
    const {frames, rate, filmProblem, keys} = this.#session.facts;
    if (frames === null) throw new Refusal([{origin: "", key: "", reason: filmProblem}]);
    const making = new FilmMaking();
    this.#showMaking(making, `Rendering ${frames.toLocaleString("en")} frames`);
    try {
      const onProgress = done => byId("saving-progress").value = done;
      const {source} = this.#session;
      if (extension === "wav") return {bytes: await making.makeSound(source, {onProgress})};
      const hasSound = keys["sound.on"][0] === "true";
      return await making.make(source, {seconds: frames * rate[1] / rate[0], hasSound, onProgress});
    } finally {
      making.stop();
      const wasOnCancel = document.activeElement === byId("cancel");
      this.#showMaking(null, "");
      const button = this.#buttons.find(one => one.dataset.save === extension);
      if (wasOnCancel) button.focus({preventScroll: true});
    }
  }

  /** One film at a time. */
  #showMaking(making, words) {
    this.#making = making;
    byId("saving-text").textContent = words;
    byId("saving-progress").value = 0;
    byId("saving").hidden = making === null;
    for (const button of this.#buttons) {
      if (isFilm(button.dataset.save)) button.disabled = making !== null;
    }
  }

  #download(bytes, name, extension) {
    if (this.#link) URL.revokeObjectURL(this.#link.href);
    const href = URL.createObjectURL(new Blob([bytes], {type: MEDIA_TYPES[extension]}));
    this.#link = element("a", {href, download: name}, name);
    const size = bytes.length < 1e6 ? `${Math.ceil(bytes.length / 1e3)} kB`
      : `${(bytes.length / 1e6).toFixed(1)} MB`;
    byId("saved").replaceChildren("Saved as ", this.#link, `, ${size}.`);
    byId("saved").hidden = false;
    this.#link.click();
  }
}
