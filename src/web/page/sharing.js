// Links to the scene, and the page inside other pages.
// In: the address of the scene that is shown. Out: a link, shared or copied; words for an iframe.

import {byId} from "./dom.js";

/** Where the page is published; empty if its makers said nothing. */
const PUBLISHED = document.querySelector("meta[name=piblocks-url]").getAttribute("content");
const isOfServer = location.protocol.startsWith("http");

/** @param field  gets the words, selected, if the browser forbids the page to copy */
export async function copy(button, words, field) {
  const {label = button.textContent} = button.dataset;
  button.dataset.label = label;
  try {
    await navigator.clipboard.writeText(words);
    button.textContent = "Copied";
  } catch {
    field.value = words;
    field.hidden = false;
    field.focus();
    field.select();
    button.textContent = "Press Ctrl+C";
  }
  setTimeout(() => button.textContent = label, 1500);
}

export class Sharing {
  #page = isOfServer ? location.href.split(/[?#]/)[0] : PUBLISHED;
  /** What is behind the page's address for the scene that is shown: always ready, because browsers
   * let a page copy and share only in the moment of a click. */
  #address = "";
  #scene = "";

  constructor() {
    byId("share").addEventListener("click", event => this.#share(event.target));
    byId("copy-embed").addEventListener("click", event => copy(event.target, this.#embed(), byId("embed")));
    for (const name of ["embed-size", "embed-controls"]) byId(name).addEventListener("change", () => this.#showEmbed());
    byId("link").addEventListener("blur", () => byId("link").hidden = true);
    if (!this.#page) byId("share").textContent = "Copy scene";
  }

  /** @param scene  as a scene file */
  update(address, scene) {
    this.#address = address;
    this.#scene = scene;
    this.#showEmbed();
  }

  async #share(button) {
    if (!this.#page) {
      byId("shared").hidden = false;
      return copy(button, this.#scene, byId("link"));
    }
    const url = this.#page + this.#address;
    const isTouched = matchMedia("(pointer: coarse)").matches;
    if (!isTouched || !navigator.share) return copy(button, url, byId("link"));
    // Whoever closes the list of programs has changed his mind.
    return navigator.share({title: document.title, url}).catch(() => {});
  }

  #embed() {
    const [width, height] = byId("embed-size").value.split("x");
    const controls = byId("embed-controls").checked ? "" : "&controls=0";
    const address = `${this.#page || "https://example.org/piblocks.html"}?embed=1${controls}${this.#address}`;
    return `<iframe src="${address.replaceAll("&", "&amp;")}" width="${width}" height="${height}" ` +
      `allow="fullscreen; autoplay" style="border:0" title="Blocks that count the digits of pi"></iframe>`;
  }
  #showEmbed() {
    byId("embed").value = this.#embed();
  }
}
