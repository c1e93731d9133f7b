// Keys of the whole page: those of players of video, and of clickers.
// In: keys. Out: presses of buttons.

import {byId, kept, targetOf} from "./dom.js";

const BUTTONS = {" ": "play", Home: "start", End: "end", ArrowLeft: "previous-frame", ArrowRight: "next-frame",
  PageUp: "previous-collision", PageDown: "next-collision", ",": "previous-collision", ".": "next-collision",
  t: "turn", m: "sound", f: "full-screen", b: "blank"};

/** Whether somebody types there. */
const isText = target => target.closest("textarea, select, input:not([type=range]):not([type=checkbox])") !== null;

/** Whether an element does something of its own at this key. */
function isTakenBy(target, key) {
  if (isText(target)) return true;
  if (target.matches("input[type=range]")) return key.startsWith("Arrow") || key === "Home" || key === "End" ||
    key.startsWith("Page");
  return target.matches("input[type=checkbox]") && key === " ";
}

/** Keys for full screen only: elsewhere PageUp and PageDown scroll. */
const isOfLecture = key => key === "b" || key.startsWith("Page");

/** @param undo  takes back the last change */
export function listenToKeys(undo) {
  const letters = byId("letters");
  letters.checked = kept.get("letters") !== "off";
  letters.addEventListener("change", () => kept.set("letters", letters.checked ? "on" : "off"));
  document.addEventListener("keydown", event => {
    if ((event.ctrlKey || event.metaKey) && event.key === "z" && !event.shiftKey && !isText(targetOf(event))) {
      event.preventDefault();
      undo();
    }
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    if (isOfLecture(event.key) && !document.body.classList.contains("lecture")) return;
    const isLetter = /^[a-z,.]$/.test(event.key);
    const button = byId(BUTTONS[event.key]);
    if (!button || isLetter && !letters.checked || isTakenBy(targetOf(event), event.key)) return;
    event.preventDefault();
    // What is held down steps on, but does not play and pause.
    if (!event.repeat || /^(Arrow|Page|[,.])/.test(event.key)) button.click();
  });
  // A button is pressed when Space is let go, and Space has played already.
  document.addEventListener("keyup", event => {
    if (event.key === " " && targetOf(event).closest("button, summary, a")) event.preventDefault();
  });
}
