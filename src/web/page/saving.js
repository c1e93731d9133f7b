// Files that the page makes: pictures of what is shown; the film by several workers.
// In: the scene and an ending. Out: a download, or a problem in the program's words.

const MEDIA_TYPES = {png: "image/png", svg: "image/svg+xml", pdf: "application/pdf",
  mp4: "video/mp4", wav: "audio/wav"};
const MOST_WORKERS = 8;
const isFilm = ending => ending === "mp4" || ending === "wav";

/** The film in one file. The pieces that workers render are joined as those of several machines. */
class FilmMaking {
  #workers = [];

  /** @param source  {text, edits} of the scene
   * @param onProgress  is told the share that is done */
  async make({text, edits}, ending, {seconds, onProgress}) {
    const name = `film.${ending}`;
    const isSound = ending === "wav";
    // Pieces are cut at whole seconds.
    const most = Math.min(navigator.hardwareConcurrency || 2, MOST_WORKERS, Math.ceil(seconds));
    const count = isSound ? 1 : Math.max(1, most);
    const shares = new Array(count).fill(0);
    this.#workers = shares.map(() => new Program());
    // The page has no encoder of AAC.
    const settings = (isSound ? edits : edits.with([["sound.on", "false"]])).lines;
    const parts = await Promise.all(this.#workers.map(async (worker, i) => {
      worker.onProgress = share => {
        shares[i] = share;
        onProgress(shares.reduce((sum, one) => sum + one, 0) / count);
      };
      await worker.call("open", {text, settings});
      return worker.call("render", {name, number: i + 1, count});
    }));
    if (count === 1) return parts[0];
    return this.#workers[0].call("join", {name, parts}, parts.map(part => part.buffer));
  }

  stop() {
    for (const worker of this.#workers) worker.stop();
    this.#workers = [];
  }
}

class Saving {
  #scene;
  #making = null;
  #link = null;
  #buttons = [...document.querySelectorAll("[data-save]")];
  /** What files are called, without an ending. */
  name = "scene";

  constructor(scene, pause) {
    this.#scene = scene;
    for (const button of this.#buttons) {
      button.addEventListener("click", () => {
        pause();
        this.#save(button.dataset.save);
      });
    }
    byId("cancel").addEventListener("click", () => this.#making?.stop());
  }

  async #save(ending) {
    if (!this.#scene.facts) return;
    const name = `${this.name}.${ending}`;
    sayIn(byId("saving-problem"), "");
    byId("saved").hidden = true;
    try {
      const bytes = isFilm(ending) ? await this.#makeFilm(ending) : await this.#scene.save(`/picture.${ending}`);
      this.#download(bytes, name, ending);
    } catch (error) {
      if (!(error instanceof Failure && error.message === STOPPED)) {
        sayIn(byId("saving-problem"), error.message);
      }
    }
  }

  /** @throws Failure with STOPPED if it is cancelled. */
  async #makeFilm(ending) {
    const {frames, rate, filmProblem} = this.#scene.facts;
    if (frames === null) throw new Problem(filmProblem);
    const making = new FilmMaking();
    this.#showMaking(making, `Rendering ${frames.toLocaleString("en")} frames`);
    try {
      const onProgress = share => byId("saving-progress").value = share;
      return await making.make(this.#scene.source, ending,
        {seconds: frames * rate[1] / rate[0], onProgress});
    } finally {
      making.stop();
      const wasOnCancel = document.activeElement === byId("cancel");
      this.#showMaking(null, "");
      const button = this.#buttons.find(one => one.dataset.save === ending);
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

  #download(bytes, name, ending) {
    if (this.#link) URL.revokeObjectURL(this.#link.href);
    const href = URL.createObjectURL(new Blob([bytes], {type: MEDIA_TYPES[ending]}));
    this.#link = element("a", {href, download: name}, name);
    const size = bytes.length < 1e6 ? `${Math.ceil(bytes.length / 1e3)} kB`
      : `${(bytes.length / 1e6).toFixed(1)} MB`;
    byId("saved").replaceChildren("Saved as ", this.#link, `, ${size}.`);
    byId("saved").hidden = false;
    this.#link.click();
  }
}
