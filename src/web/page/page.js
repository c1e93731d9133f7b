// The page: its parts, and what flows between them.

const picture = byId("picture");
const canvas = picture.getContext("2d");
const scene = new Scene();
const {scenes, ...lists} = await scene.started.catch(error => {
  sayProblem(`This browser cannot run the program: ${error.message}`);
  throw error;
});
const player = new Player(scene);
const saving = new Saving(scene, () => player.pause());
const fields = new Fields(scene, lists, byId("save-group"));
const bodies = new Bodies(scene, byId("settings").firstElementChild);
const text = byId("text");

/** The name of the scene of the program that is shown, and its text; null of any other. */
let shipped = null;
let busyTimer = null;
/** Stays until another scene is opened. */
let linkProblem = "";

function sayProblem(words) {
  byId("problem").textContent = words;
  byId("problem").hidden = words === "";
}

/** Of more, the first ones are read out. */
const MOST_BODIES = 6;

function grouped(count) {
  return count === "infinite" ? "∞" : count.replace(/\B(?=(\d{3})+$)/g, "\u202F");
}

function readOut(name, ...values) {
  return element("div", {}, element("dt", {}, name),
    ...values.map(value => element("dd", {}, value)));
}

/** A position or velocity, on a line or in a plane. */
const vectorText = numbers => [numbers].flat().join("; ");

const motionReadOut = (name, {position, velocity}) =>
  readOut(name, `x = ${vectorText(position)}`, `v = ${vectorText(velocity)}`);

/** Numbers as `piblocks state` prints them. */
function readOutsOf({state, frame}, facts) {
  const rows = [];
  if (state !== null) {
    const {collisions, time, blue, red, bodies: moving} = JSON.parse(state);
    rows.push(readOut("Collisions", grouped(collisions)), readOut("Time", String(time)));
    if (moving) moving.slice(0, MOST_BODIES).forEach((body, i) => rows.push(motionReadOut(`Body ${i + 1}`, body)));
    else rows.push(motionReadOut("Blue", blue), motionReadOut("Red", red));
  }
  if (frame !== null) {
    rows.push(readOut("Frame", `${frame + 1} of ${facts.frames}`));
  }
  return rows;
}

function describe({state, frame}, facts) {
  if (state === null) return `Frame ${frame + 1} of a film of ${facts.frames} frames`;
  const {collisions, time, blue, red} = JSON.parse(state);
  const where = blue ? `, blue at ${blue.position}, red at ${red.position}` : "";
  return `${collisions} collisions at time ${time}${where}`;
}

scene.onPicture = ({x, y, width, height, pixels}) => {
  const {facts} = scene;
  if (picture.width !== facts.width || picture.height !== facts.height) {
    picture.width = facts.width;
    picture.height = facts.height;
  }
  if (width > 0) {
    canvas.putImageData(new ImageData(new Uint8ClampedArray(pixels), width, height), x, y);
  }
};

scene.onShown = place => {
  const {facts} = scene;
  player.updatePlace(place);
  byId("read-outs").replaceChildren(...readOutsOf(place, facts));
  if (!player.isPlaying) picture.setAttribute("aria-label", describe(place, facts));
};

let addressTimer = null;

/** Once nothing has changed for a while: browsers allow few changes of the address a second. */
function updateAddress(sceneText) {
  clearTimeout(addressTimer);
  addressTimer = setTimeout(async () => {
    const address = shipped ? `#${shipped.name}` : await addressOf(sceneText);
    history.replaceState(null, "", address);
  }, 400);
}

scene.onOpened = (facts, sceneText) => {
  if (shipped && sceneText !== shipped.text) shipped = null;
  byId("scenes").value = shipped?.name ?? "";
  saving.name = shipped?.name ?? "scene";
  if (document.activeElement !== text && byId("text-problem").hidden) text.value = sceneText;
  fields.update(facts);
  bodies.update(facts);
  player.update(facts);
  const notes = [facts.filmProblem && `No film: ${facts.filmProblem}`, ...(facts.notes ?? [])];
  byId("notes").textContent = notes.filter(note => note).join("\n");
  byId("notes").hidden = byId("notes").textContent === "";
  updateAddress(sceneText);
};

scene.onProblems = problems => {
  const others = bodies.say(fields.say(problems));
  const ofText = others.filter(problem => problem.key === "text");
  byId("text-problem").textContent = ofText.map(problem => problem.words).join("\n");
  byId("text-problem").hidden = ofText.length === 0;
  text.setAttribute("aria-invalid", String(ofText.length > 0));
  if (ofText.length > 0) byId("text-group").open = true;
  const elsewhere = others.filter(problem => problem.key !== "text");
  const names = problems.filter(problem => !elsewhere.includes(problem)).map(({key, body, property}) =>
    key === "text" ? "the scene file" : body ? `body ${body}.${property}` : key);
  const leftOut = names.length > 0 && `Not shown, because it is wrong: ${[...new Set(names)].join(", ")}.`;
  sayProblem([linkProblem, ...elsewhere.map(problem => problem.words), leftOut]
    .filter(words => words).join("\n"));
};

scene.hasField = key => fields.has(key) || bodies.has(key);

scene.onPlaceProblem = words => {
  byId("instant-problem").textContent = words;
  byId("instant-problem").hidden = words === "";
  byId("instant").setAttribute("aria-invalid", String(words !== ""));
};

scene.onBusy = isBusy => {
  document.body.dataset.isBusy = String(isBusy);
  clearTimeout(busyTimer);
  if (isBusy) busyTimer = setTimeout(() => byId("busy").hidden = false, 400);
  else byId("busy").hidden = true;
};

byId("stop").addEventListener("click", () => scene.stop());

byId("scenes").append(element("option", {value: "", hidden: true}, "my own"),
  ...scenes.map(({name, summary}) => element("option", {value: name}, `${name}: ${summary}`)));
byId("scenes").addEventListener("change", () => openShipped(byId("scenes").value));

function open(found) {
  player.pause();
  linkProblem = "";
  byId("text-problem").hidden = true;
  shipped = found.name ? found : null;
  scene.open(found.text, {frame: 0});
}

const openShipped = name => open(scenes.find(one => one.name === name));

let textTimer = null;
text.addEventListener("input", () => {
  clearTimeout(textTimer);
  textTimer = setTimeout(() => {
    shipped = null;
    scene.open(text.value);
  }, 150);
});

async function copy(button, words) {
  const label = button.textContent;
  try {
    await navigator.clipboard.writeText(words);
    button.textContent = "Copied";
  } catch {
    text.closest("details").open = true;
    text.focus();
    text.select();
    button.textContent = "Press Ctrl+C";
  }
  setTimeout(() => button.textContent = label, 1500);
}

byId("undo-text").addEventListener("click", () => {
  byId("text-problem").hidden = true;
  scene.open(scene.text);
});
byId("copy-text").addEventListener("click", event => copy(event.target, text.value));
byId("copy-link").addEventListener("click", async event => {
  const address = shipped ? `#${shipped.name}` : await addressOf(scene.text);
  copy(event.target, new URL(address, location.href).href);
});
byId("go-to-save").addEventListener("click", () => {
  byId("save-group").open = true;
  byId("save-group").scrollIntoView({block: "nearest"});
  byId("save-group").querySelector("button").focus({preventScroll: true});
});
byId("settings").addEventListener("submit", event => event.preventDefault());

/** @returns whether the address has a scene. */
async function openAddress() {
  try {
    const found = await sceneOf(location.hash, scenes);
    if (found) open(found);
    return found !== null;
  } catch (error) {
    linkProblem = `Link: ${error.message}`;
    sayProblem(linkProblem);
    return false;
  }
}
addEventListener("hashchange", openAddress);

const given = JSON.parse(byId("opened-scene").textContent);
if (!await openAddress()) {
  const words = linkProblem;
  if (given) open({text: given.text, name: null});
  else openShipped("lecture");
  linkProblem = words;
}
