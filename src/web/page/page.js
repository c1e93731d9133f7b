// The page: its parts, and what flows between them. Controls make wishes of the session, the session
// tells what the program makes of them, and the parts show that.

import {Bodies} from "./bodies.js";
import {byId, makeTimer, element, options, sayIn, targetOf} from "./dom.js";
import {Fields} from "./fields.js";
import {Steps} from "./history.js";
import {listenToKeys} from "./keys.js";
import {Lecture} from "./lecture.js";
import {placeAddress, sceneAddress, sceneOf} from "./link.js";
import {Player} from "./player.js";
import {wordsOf} from "./program.js";
import {Readouts, wordsOfPicture} from "./readouts.js";
import {Saving} from "./saving.js";
import {BROKEN, Session, TEXT} from "./session.js";
import {copy, offerSharing} from "./sharing.js";
import {Stage} from "./stage.js";

/** What is shown if nothing else can be. */
const FIRST_SCENE = "lecture";
if (options.get("embed") === "1") document.body.classList.add("embedded");
if (options.get("controls") === "0") document.body.classList.add("bare");

const session = new Session();
const {scenes, alike, ...lists} = await session.started.catch(error => {
  document.documentElement.className = "";
  sayIn(byId("problem"), `This browser cannot run the program: ${error.message}`);
  throw error;
});
session.keysOfOneValue = alike;
const player = new Player(session);
const stage = new Stage(session, player);
const steps = new Steps(session);
const fields = new Fields(session, lists);
const bodies = new Bodies(session);
const readouts = new Readouts();
offerSharing(() => addressNow(), () => session.text);
const saving = new Saving(session, () => player.isPlaying && player.pause());
new Lecture(session);
listenToKeys(() => steps.undo());

const text = byId("text");
/** Sends the typed text to the program after a pause. */
const typing = makeTimer(150, () => session.open(text.value));
const busyNotice = makeTimer(400, () => byId("busy").hidden = false);
/** Browsers allow few changes of the address a second. */
const addressUpdate = makeTimer(250, () => addressOfScene && !player.isPlaying && steps.update(addressNow()));
const choicesUpdate = makeTimer(150, updateChoices);
/** The facts of the scene whose choices are known or asked for. */
let choicesOf = null;
/** Whether somebody has typed what the program has not seen, or has refused. */
let isTextNewer = false;
/** Stays until another scene is opened. */
let linkProblem = "";
let shown = null;
/** The part of the address that names the scene; made once for each scene. */
let addressOfScene = "";
let leftOut = [];
/** The key that was edited last before something was left out, and its edits until then. */
let cause = null;
/** What the program had accepted before. */
let accepted = {text: "", edits: []};
let announcesNext = false;
/** The place of the first scene, until it is shown. */
let firstPlace = null;

/** The scene of the program that is shown; undefined if it is another one. */
const shippedScene = () => scenes.find(one => one.text === session.text);
const shippedText = name => scenes.find(one => one.name === name).text;

/** Writes the scene into the text area, if nothing newer is there. */
function showText() {
  const isUsed = document.activeElement === text && isTextNewer;
  if (isUsed || typing.isRunning || session.isTextWaiting || session.problemsOf(TEXT).length > 0) return;
  if (text.value !== session.text) text.value = session.text;
  isTextNewer = false;
}

/** Shows another scene.
 * @param {import("./session.js").Place} place
 * @param problem  why it is not the one that the address names */
function open(words, place = {frame: 0}, problem = "") {
  typing.stop();
  isTextNewer = false;
  player.pause();
  linkProblem = problem;
  text.value = words;
  session.open(words, place);
}
const openShipped = name => open(shippedText(name));

session.onShown = now => {
  shown = now;
  stage.updateShown(now);
  player.updateShown(now);
  readouts.show(now, session.facts);
  if (!player.isPlaying) describePicture();
  addressUpdate.start();
};

/** Steps are read out; what is played is not. */
function describePicture() {
  const words = wordsOfPicture(shown, session.facts);
  byId("picture").setAttribute("aria-label", words);
  if (announcesNext) byId("announcement").textContent = words;
  announcesNext = false;
}
player.onPause = describePicture;
player.onStep = () => {
  announcesNext = true;
  invitation.hidden = true;
};

/** A link from a film that is playing begins at its start. */
const addressNow = () => addressOfScene + (shown && player.isPlaceChosen ? placeAddress(session.snapshot.place, shown, session.facts.rate) : "");

async function updateScene() {
  const {text} = session;
  const made = await sceneAddress(text, shippedScene()?.name);
  if (text !== session.text) return;
  addressOfScene = made;
  addressUpdate.start();
}

session.onOpened = (facts, left) => {
  const {text: words, edits} = session.snapshot;
  const key = words === accepted.text ? edits.at(-1)?.[0] : undefined;
  if (left.length === 0) cause = null;
  else if (left.length > leftOut.length) cause = key && {key, edits: accepted.edits.filter(([one]) => session.replaces(key, one))};
  leftOut = left;
  accepted = session.snapshot;
  const name = shippedScene()?.name;
  byId("scenes").value = name ?? "";
  saving.name = name ?? "scene";
  steps.add();
  byId("undo").disabled = !steps.canUndo;
  showText();
  fields.update(facts);
  bodies.update(facts);
  bodies.setRoom(undefined);
  player.update(facts);
  byId("of-storyboard").hidden = facts.kind === "scene";
  const notes = [facts.filmProblem && `No film: ${facts.filmProblem}`, ...(facts.notes ?? [])];
  sayIn(byId("notes"), notes.filter(note => note).join("\n"));
  sayLeftOut();
  updateScene();
  document.body.dataset.hasChoices = "false";  // for tests, which wait for it
  choicesOf = null;
  choicesUpdate.start();
  if (firstPlace) invite(firstPlace);
  firstPlace = null;
};

async function updateChoices() {
  choicesUpdate.stop();
  const {facts} = session;
  // While nobody sees them, they would only keep the program from its frames.
  if (!facts || facts === choicesOf || !byId("more").open && !facts.bodies) return;
  if (session.isBusy) return choicesUpdate.start();
  choicesOf = facts;
  const made = await session.choices().catch(() => null);
  if (facts !== session.facts) return;
  if (!made) {
    choicesOf = null;
    return;
  }
  fields.disable(made);
  bodies.setRoom(made.room);
  document.body.dataset.hasChoices = "true";
}

/** What the picture had to do without. */
function sayLeftOut() {
  const byReason = new Map();
  for (const {key, item, reason} of leftOut) {
    byReason.set(reason, (byReason.get(reason) ?? new Set()).add(item || (fields.labelOf(key) ?? key)));
  }
  const words = [...byReason].map(([reason, names]) => `${[...names].join(", ")} (${reason})`);
  byId("left-out").hidden = leftOut.length === 0;
  byId("left-out").firstElementChild.textContent = `Left out: ${words.join("; ")}.`;
  byId("bring-back").hidden = !cause;
}
/** Takes back the edits of the key because of which it was left out. */
byId("bring-back").addEventListener("click", () => {
  const {edits, ...others} = session.snapshot;
  session.restore({...others, edits: [...edits.filter(([key]) => key !== cause.key), ...cause.edits]});
});

session.onRefused = () => {
  const keysWithField = [...fields.say(), ...bodies.say()];
  const ofText = session.problemsOf(TEXT);
  const lines = ofText.map(problem => {
    const line = problem.origin.match(/:(\d+)$/)?.[1];
    return `${line ? `Line ${line}: ` : ""}${wordsOf(problem)}`;
  });
  sayIn(byId("text-problem"), lines.join("\n"));
  text.setAttribute("aria-invalid", String(ofText.length > 0));
  if (ofText.length > 0) byId("more").open = byId("text-group").open = true;
  // Nobody can correct a refused value that has no field any more.
  const lost = session.refusedKeys.filter(key => key !== BROKEN && !keysWithField.includes(key));
  for (const key of lost) session.forget(key);
  const broken = session.problemsOf(BROKEN).map(problem => wordsOf(problem));
  sayIn(byId("problem"), [linkProblem, ...broken].filter(words => words).join("\n"));
  // If the scene of a link is wrong, the first scene is shown.
  if (!session.facts && ofText.length > 0) session.openInstead(shippedText(FIRST_SCENE));
};

session.onPlaceProblem = words => {
  sayIn(byId("instant-problem"), words);
  byId("instant").setAttribute("aria-invalid", String(words !== ""));
  if (words) byId("more").open = true;
};

session.onBusy = isBusy => {
  document.body.dataset.isBusy = String(isBusy);  // for tests, which wait for it
  if (isBusy) return busyNotice.start();
  busyNotice.stop();
  byId("busy").hidden = true;
  document.documentElement.className = "";  // no poster: the program has drawn, or failed
};

byId("stop").addEventListener("click", () => {
  session.stop();
  byId("play").focus({preventScroll: true});
  if (!session.facts) openShipped(FIRST_SCENE);
});

byId("scenes").append(element("option", {value: "", hidden: true}, "my own"),
  ...scenes.map(({name, summary}) => element("option", {value: name}, `${name}: ${summary}`)));
byId("scenes").addEventListener("change", () => openShipped(byId("scenes").value));
byId("undo").addEventListener("click", () => steps.undo());
steps.onRestored = () => {
  player.pause();
  linkProblem = "";
};
steps.onAddress = () => openAddress(null);

text.addEventListener("input", () => {
  isTextNewer = true;
  linkProblem = "";
  typing.start();
});
text.addEventListener("blur", showText);
byId("show-text").addEventListener("click", () => session.facts && open(session.text, session.snapshot.place));
byId("copy-text").addEventListener("click", event => copy(event.target, text.value, text));
byId("settings").addEventListener("submit", event => event.preventDefault());
byId("more").addEventListener("toggle", updateChoices);
document.addEventListener("click", event => {
  if (!targetOf(event).closest("#menu")) byId("menu").open = false;
  if (!targetOf(event).closest("#notices, #share")) byId("saved").hidden = byId("shared").hidden = true;
});
byId("menu").addEventListener("keydown", event => {
  if (event.key !== "Escape") return;
  byId("menu").open = false;
  byId("menu").querySelector("summary").focus();
});

/** The button over the picture, until the film has been played. */
const invitation = byId("invitation");
player.onPlay = () => invitation.hidden = true;

/** Plays once by itself, unless the reader wants no motion or a place was asked for. */
function invite(place) {
  const isStill = matchMedia("(prefers-reduced-motion: reduce)").matches;
  if (place.frame !== 0 || player.frames === 0) return;
  invitation.hidden = false;
  if (isStill || options.get("autoplay") === "0") return;
  // A page that nobody sees waits.
  requestAnimationFrame(() => player.play({isSilent: true}));
}

/** Opens the scene that the address names.
 * @param otherwise  text and place to open if the address names no readable scene; null opens nothing */
async function openAddress(otherwise) {
  let problem = "";
  const wanted = await sceneOf(location.hash, scenes).catch(error => {
    linkProblem = problem = `Link: ${error.message}`;
    sayIn(byId("problem"), problem);
  }) ?? otherwise;
  if (!wanted) return;
  if (!session.facts) firstPlace = wanted.place;
  open(wanted.text, wanted.place, problem);
}
const given = JSON.parse(byId("opened-scene").textContent);
await openAddress({text: given?.text ?? shippedText(FIRST_SCENE), place: {frame: 0}});
