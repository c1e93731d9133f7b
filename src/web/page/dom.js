// Elements of the page, its address and delays; numbers as people read them.

/** @returns {any} the element of this id */
export const byId = id => document.getElementById(id);
/** @returns {any[]} the elements that a selector of CSS finds */
export const all = selector => [...document.querySelectorAll(selector)];
/** What the address says after its question mark. */
export const options = new URLSearchParams(location.search);
/** @returns {any} what an event has happened to */
export const targetOf = event => event.target;

/** Makes an element: element("p", {className: "hint"}, "text", child).
 * @returns {any} */
export function element(name, properties = {}, ...children) {
  const made = document.createElement(name);
  for (const [property, value] of Object.entries(properties)) {
    if (property.includes("-") || property === "role") made.setAttribute(property, value);
    else made[property] = value;
  }
  made.append(...children);
  return made;
}

/** A line of text. @param given  what it does at each input, and at Escape: the last value comes back
 * @returns {any} */
export function lineOf({onInput, onEscape}, properties) {
  const line = element("input", {type: "text", spellcheck: false, autocapitalize: "off", ...properties});
  line.addEventListener("input", onInput);
  line.addEventListener("keydown", event => {
    if (event.key !== "Escape") return;
    line.blur();
    onEscape();
  });
  return line;
}

/** A timer that calls something so many milliseconds after its last start(). */
export function makeTimer(ms, action) {
  const delay = {timer: null,
    start() {
      delay.stop();
      delay.timer = setTimeout(() => {
        delay.timer = null;
        action();
      }, ms);
    },
    stop() {
      clearTimeout(delay.timer);
      delay.timer = null;
    },
    get isRunning() {
      return delay.timer !== null;
    }};
  return delay;
}

/** Shows words; writes them only if they differ, so that they are read out once. */
export function sayIn(target, words) {
  if (target.textContent !== words) target.textContent = words;
  target.hidden = words === "";
}

/** "1/3" or "2.5" or "10^4", near enough for a slider. */
export function approximate(text) {
  const [, base, exponent] = text.match(/^(\d+)\^(\d+)$/) ?? [];
  if (base) return Number(base) ** Number(exponent);
  const [above, below = "1"] = text.split("/");
  return Number(above) / Number(below);
}

/** Digits in groups of three, by narrow spaces. */
export const grouped = digits => String(digits).replace(/\B(?=(\d{3})+$)/g, "\u202F");

/** A number with so many decimals; one that is beyond reading in this form as a power of ten. */
export function fixed(value, decimals) {
  const number = Number(value);
  if (!Number.isFinite(number)) return String(value);
  if (Math.abs(number) >= 1e7) return number.toExponential(decimals).replace("e+", "e");
  return number.toFixed(decimals).replace("-", "\u2212");
}

/** "1 collision", "31 collisions". */
export const counted = (number, noun) => `${grouped(number)} ${noun}${String(number) === "1" ? "" : "s"}`;

/** What is kept from visit to visit; nothing where the browser keeps nothing, as for some files. */
export const kept = {
  get(name) {
    try {
      return localStorage.getItem(name);
    } catch {
      return null;
    }
  },
  set(name, value) {
    try {
      localStorage.setItem(name, value);
    } catch {
      // The choice holds until the page is left.
    }
  },
};
