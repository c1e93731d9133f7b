// What the program says of the instant that is shown, in numbers.
// In: what is shown. Out: rows of numbers, words for people who do not see the picture.

import {byId, counted, element, fixed, grouped, kept} from "./dom.js";

/** If there are more bodies, only the first ones are listed. */
const MOST_BODIES = 6;
const TIME_DECIMALS = 2;
const DECIMALS = 4;

const countText = count => count === "infinite" ? "∞" : grouped(count);

export class Readouts {
  #shown = null;
  #facts = null;
  #exact = byId("exact");

  constructor() {
    this.#exact.checked = kept.get("exact") === "on";
    this.#exact.addEventListener("change", () => {
      kept.set("exact", this.#exact.checked ? "on" : "off");
      if (this.#shown) this.show(this.#shown, this.#facts);
    });
  }

  #number(value, decimals) {
    return this.#exact.checked ? String(value) : fixed(value, decimals);
  }
  /** A position or velocity, on a line or in a plane. */
  #vector(numbers) {
    return [numbers].flat().map(number => this.#number(number, DECIMALS)).join("; ");
  }
  #row(name, ...values) {
    return element("div", {}, element("dt", {}, name), ...values.map(value => element("dd", {}, value)));
  }
  #motion(name, {position, velocity}) {
    return this.#row(name, `x = ${this.#vector(position)}`, `v = ${this.#vector(velocity)}`);
  }

  show(shown, facts) {
    this.#shown = shown;
    this.#facts = facts;
    const {state, frame} = shown;
    const rows = [];
    if (state !== null) {
      const {collisions, time, blue, red, bodies} = JSON.parse(state);
      rows.push(this.#row("Collisions", countText(collisions)), this.#row("Time", this.#number(time, TIME_DECIMALS)));
      if (bodies) bodies.slice(0, MOST_BODIES).forEach((body, i) => rows.push(this.#motion(`Body ${i + 1}`, body)));
      else rows.push(this.#motion("Blue", blue), this.#motion("Red", red));
    }
    if (frame !== null) rows.push(this.#row("Frame", `${grouped(frame)} of ${grouped(facts.frames - 1)}`));
    byId("state").replaceChildren(...rows);
  }
}

/** The picture in words. */
export function wordsOfPicture({state, frame}, facts) {
  if (state === null) return `Frame ${grouped(frame)} of a film of ${grouped(facts.frames)} frames`;
  const {collisions, time, blue, red} = JSON.parse(state);
  const where = blue ? `, blue at ${fixed(blue.position, 2)}, red at ${fixed(red.position, 2)}` : "";
  const count = collisions === "infinite" ? "infinitely many collisions" : counted(collisions, "collision");
  return `${count} at time ${fixed(time, TIME_DECIMALS)}${where}`;
}
