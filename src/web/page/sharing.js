// Links to the scene, and the page inside other pages.
// In: the fragment of the address for what is shown. Out: a link, shared or copied; words
// for an iframe.

import {byId} from "./dom.js";

/** Where the page is published; empty if its makers said nothing. */
const PUBLISHED = document.querySelector("meta[name=piblocks-url]").getAttribute("content");
const PAGE = location.protocol.startsWith("http") ? location.href.split(/[?#]/)[0] : PUBLISHED;

/** @param field  gets the words, selected, if the browser forbids the page to copy
 * @returns whether they are copied */
export async function copy(button, words, field) {
  const {label = button.textContent} = button.dataset;
  button.dataset.label = label;
  setTimeout(() => button.textContent = label, 1500);
  try {
    await navigator.clipboard.writeText(words);
    button.textContent = "Copied";
    return true;
  } catch {
    field.value = words;
    field.hidden = false;
    field.focus();
    field.select();
    button.textContent = "Press Ctrl+C";
    return false;
  }
}

async function share(button, url) {
  const isTouched = matchMedia("(pointer: coarse)").matches;
  if (!isTouched || !navigator.share) return copy(button, url, byId("link"));
  return navigator.share({title: document.title, url}).catch(error => {
    // Closing the list of programs is no error.
    if (error.name !== "AbortError") return copy(button, url, byId("link"));
  });
}

function embed(address) {
  const [width, height] = byId("embed-size").value.split("x");
  const controls = byId("embed-controls").checked ? "" : "&controls=0";
  const url = `${PAGE || "https://example.org/piblocks.html"}?embed=1${controls}${address}`;
  return `<iframe src="${url.replaceAll("&", "&amp;")}" width="${width}" height="${height}" ` +
    `allow="fullscreen; autoplay" style="border:0" title="Blocks that count the digits of pi"></iframe>`;
}

/** @param addressNow  the address without that of the page, at once: browsers let a page copy and share
 *   only in the moment of a click
 * @param sceneNow  the scene as a scene file */
export function offerSharing(addressNow, sceneNow) {
  const showEmbed = () => byId("embed").value = embed(addressNow());
  byId("menu").addEventListener("toggle", showEmbed);
  for (const name of ["embed-size", "embed-controls"]) byId(name).addEventListener("change", showEmbed);
  byId("copy-embed").addEventListener("click", event => copy(event.target, embed(addressNow()), byId("embed")));
  byId("link").addEventListener("blur", () => byId("link").hidden = true);
  const button = byId("share");
  if (!PAGE) button.textContent = "Copy scene";
  button.addEventListener("click", async () => {
    if (PAGE) return share(button, PAGE + addressNow());
    byId("shared").hidden = !await copy(button, sceneNow(), byId("link"));
  });
}
