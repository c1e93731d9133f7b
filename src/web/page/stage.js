// The picture: the program's pixels, and what fingers do on them.
// In: pictures, pointers. Out: pixels; a block that is dragged, the tip of its arrow, a tap, a drag
// through time.

import {byId} from "./dom.js";

/** How near a pointer has to be to what it grabs, in pixels of the page. */
const REACH_px = 14;
/** What moves less is a tap. */
const TAP_px = 5;

/** The smallest of 0.01, 0.02, 0.05, 0.1 … that is a pixel at least: what is shown is exact. */
function stepOf(pixel) {
  const power = 10 ** Math.floor(Math.log10(Math.max(pixel, 0.01)));
  return [1, 2, 5, 10].map(times => times * power).find(step => step >= pixel) ?? 10 * power;
}
function snapped(value, step, [low, high]) {
  const rounded = Number((Math.round(value / step) * step).toFixed(6));
  return String(Math.min(Math.max(rounded, low), high));
}

export class Stage {
  #session;
  #player;
  #picture = byId("picture");
  #canvas = this.#picture.getContext("2d");
  #shown = null;
  #grab = null;

  constructor(session, player) {
    this.#session = session;
    this.#player = player;
    session.onPicture = picture => this.#draw(picture);
    this.#picture.addEventListener("pointerdown", event => this.#begin(event));
    this.#picture.addEventListener("pointermove", event => this.#move(event));
    this.#picture.addEventListener("pointerup", event => this.#end(event));
    this.#picture.addEventListener("pointercancel", () => this.#grab = null);
  }

  updateShown(shown) {
    this.#shown = shown;
  }

  #draw({x, y, width, height, pixels}) {
    const {facts} = this.#session;
    if (this.#picture.width !== facts.width || this.#picture.height !== facts.height) {
      this.#picture.width = facts.width;
      this.#picture.height = facts.height;
    }
    if (width > 0) {
      const bytes = new Uint8ClampedArray(pixels, 0, 4 * width * height);
      this.#canvas.putImageData(new ImageData(bytes, width, height), x, y);
    }
    // Memory that is too large for this picture goes.
    if (pixels.byteLength <= 4 * facts.width * facts.height) this.#session.recycle(pixels);
  }

  /** {x, y} in pixels of the picture, `unit` of which are a pixel of the page. */
  #placeOf({clientX, clientY}) {
    const {left, top, width, height} = this.#picture.getBoundingClientRect();
    const unit = Math.max(this.#picture.width / width, this.#picture.height / height);
    // It may be smaller than its box, and is in the middle of it then.
    return {x: (clientX - left - width / 2) * unit + this.#picture.width / 2,
      y: (clientY - top - height / 2) * unit + this.#picture.height / 2, unit};
  }

  /** What can be grabbed there: a key, its value and pixels for each unit of it near that value; of an
   * arrow, where it begins. */
  #handleAt({x, y, unit}) {
    const {stage, state} = this.#shown ?? {};
    if (!stage || !state || !this.#session.facts?.ranges) return null;
    const reach = REACH_px * unit;
    const now = JSON.parse(state);
    for (const {key, arrow} of stage.blocks) {
      if (!arrow || !stage.arrowScale) continue;
      if (Math.hypot(x - arrow[2], y - arrow[3]) < 1.5 * reach) {
        return {key: `${key}.velocity`, value: Number(now[key].velocity), scale: stage.arrowScale, from: arrow[0]};
      }
    }
    for (const {key, rect: [left, top, width, height]} of stage.blocks) {
      if (x > left - reach && x < left + width + reach && y > top - reach && y < top + height) {
        return {key: `${key}.position`, value: Number(now[key].position), scale: stage.scale};
      }
    }
    return null;
  }

  #begin(event) {
    if (!event.isPrimary || event.button !== 0) return;
    const place = this.#placeOf(event);
    this.#grab = {pointer: event.pointerId, clientX: event.clientX, place, isDrag: false,
      handle: this.#handleAt(place), frame: this.#player.frame};
    this.#picture.setPointerCapture(event.pointerId);
  }

  #move(event) {
    const grab = this.#grab;
    if (event.pointerId !== grab?.pointer) {
      this.#picture.dataset.over = this.#handleAt(this.#placeOf(event)) ? "handle" : "";
      return;
    }
    const moved = event.clientX - grab.clientX;
    if (!grab.isDrag && Math.abs(moved) <= TAP_px) return;
    if (!grab.isDrag && grab.handle) this.#startAtZero();
    grab.isDrag = true;
    if (grab.handle) this.#drag(grab, this.#placeOf(event));
    else this.#player.goTo(grab.frame + moved / this.#picture.getBoundingClientRect().width * (this.#player.frames - 1));
  }

  /** Positions and velocities of a scene are those at time 0. */
  #startAtZero() {
    this.#player.pause();
    if (Number(JSON.parse(this.#shown.state).time) !== 0) this.#session.show({instant: "0"});
  }

  #drag({handle, place}, {x, unit}) {
    const {key, value, scale, from} = handle;
    const range = this.#session.facts.ranges[key] ?? [-Infinity, Infinity];
    const wanted = from === undefined ? value + (x - place.x) / scale : this.#velocityOf(x - from);
    this.#session.edit(key, snapped(wanted, stepOf(unit / scale), range));
  }

  /** Of an arrow of this length: longer ones stand for ever larger velocities. */
  #velocityOf(length) {
    const {arrowScale, longestArrow} = this.#shown.stage;
    const share = Math.min(Math.abs(length) / longestArrow, 0.95);
    return Math.sign(length) * share * longestArrow / (1 - share) / arrowScale;
  }

  #end(event) {
    if (event.pointerId !== this.#grab?.pointer) return;
    if (!this.#grab.isDrag) this.#player.toggle();
    this.#grab = null;
  }
}
