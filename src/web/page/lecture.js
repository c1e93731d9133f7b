// The picture on a projector, on a telephone, and as large as the screen.
// In: the size of the window, a press of the button "full-screen". Out: the size in which the program
// lays the picture out; a bar that fades.

import {byId, makeTimer} from "./dom.js";

const BAR_ms = 2000;
/** More pixels than most projectors have; in fewer than the least there is no room for text. */
const MOST_PIXELS = 3840 * 2160;
const LEAST_SIDE_px = 1280;
/** As in live.css. */
const UPRIGHT_TELEPHONE = "(max-width: 639.98px) and (max-aspect-ratio: 639/640)";
const even = length => 2 * Math.round(length / 2);

/** The pixels of an area of the page. */
function pixelsOf(width, height) {
  const density = Math.max(devicePixelRatio || 1, LEAST_SIDE_px / Math.max(width, height));
  const scale = Math.min(density, Math.sqrt(MOST_PIXELS / (width * height)));
  return `${even(width * scale)}x${even(height * scale)}`;
}

export class Lecture {
  #session;
  #screen = byId("screen");
  #idle = makeTimer(BAR_ms, () => document.body.classList.add("idle"));
  #isOn = false;

  constructor(session) {
    this.#session = session;
    byId("full-screen").addEventListener("click", () => this.#isOn ? this.#leave() : this.#enter());
    byId("blank").addEventListener("click", () => this.#screen.classList.toggle("blank"));
    document.addEventListener("fullscreenchange", () => {
      if (!document.fullscreenElement && this.#isOn) this.#leave();
    });
    for (const kind of ["pointermove", "pointerdown", "focusin"]) {
      document.addEventListener(kind, () => this.#isOn && this.#showBar());
    }
    document.addEventListener("keydown", event => {
      if (event.key === "Escape" && this.#isOn) this.#leave();
    });
    addEventListener("resize", () => this.update());
    this.update();
  }

  /** The shape of the screen, or of the frame in another page; upright on a telephone that is held so;
   * else the scene's own. */
  update() {
    const {classList} = document.body;
    if (this.#isOn) {
      this.#session.setScreen(pixelsOf(innerWidth, innerHeight));
    } else if (classList.contains("embedded")) {
      const bar_px = classList.contains("bare") ? 0 : 6 * 16;
      this.#session.setScreen(pixelsOf(innerWidth, Math.max(innerHeight - bar_px, innerWidth / 3)));
    } else {
      this.#session.setScreen(matchMedia(UPRIGHT_TELEPHONE).matches ? "1080x1350" : "");
    }
  }

  /** Some telephones give a page no screen of its own; there it fills the window. */
  async #enter() {
    this.#isOn = true;
    document.body.classList.add("lecture");
    byId("full-screen").setAttribute("aria-pressed", "true");
    // A clicker's keys are not those of a field.
    byId("settings").inert = true;
    byId("full-screen").focus();
    await document.documentElement.requestFullscreen?.().catch(() => {});
    if (!this.#isOn) {
      document.exitFullscreen?.().catch(() => {});
      return;
    }
    this.update();
    this.#showBar();
  }

  #leave() {
    this.#isOn = false;
    this.#idle.stop();
    document.body.classList.remove("lecture", "idle");
    this.#screen.classList.remove("blank");
    byId("settings").inert = false;
    byId("full-screen").setAttribute("aria-pressed", "false");
    if (document.fullscreenElement) document.exitFullscreen();
    this.update();
  }

  #showBar() {
    document.body.classList.remove("idle");
    this.#idle.start();
  }
}
