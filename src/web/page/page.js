// The page: its parts, and what flows between them.

const picture = byId("picture");
const canvas = picture.getContext("2d");
const scene = new Scene();
const {scenes, ...lists} = await scene.started.catch(error => {
  sayIn(byId("problem"), `This browser cannot run the program: ${error.message}`);
  throw error;
});
const player = new Player(scene);
const saving = new Saving(scene, () => player.pause());
const fields = new Fields(scene, lists, byId("save-group"));
const bodies = new Bodies(scene, byId("settings").firstElementChild);
const text = byId("text");

/** What is shown if nothing else can be. */
const FIRST_SCENE = "lecture";

let busyTimer = null;
/** Stays until another scene is opened. */
let linkProblem = "";
/** What is shown, as the program says. */
let shown = null;
let hasTriedFirst = false;
let textTimer = null;
/** Whether somebody has typed what the program has not seen, or has refused. */
let isTextNewer = false;

/** Writes the scene into the text area, if nothing newer is there. */
function showText() {
  const isUsed = document.activeElement === text && isTextNewer;
  if (isUsed || textTimer !== null || scene.isWaiting("text") || !byId("text-problem").hidden) return;
  if (text.value !== scene.text) text.value = scene.text;
  isTextNewer = false;
}

function forgetTyping() {
  clearTimeout(textTimer);
  textTimer = null;
  isTextNewer = false;
  sayIn(byId("text-problem"), "");
}

/** The scene of the program that is shown; undefined if it is another one. */
const shippedScene = () => scenes.find(({text: words}) => words === scene.text);
const addressOfScene = async () => {
  const name = shippedScene()?.name;
  return name ? `#${name}` : await addressOf(scene.text);
};

/** If there are more bodies, only the first ones are listed. */
const MOST_BODIES = 6;

function grouped(count) {
  return count === "infinite" ? "∞" : count.replace(/\B(?=(\d{3})+$)/g, "\u202F");
}

function stateRow(name, ...values) {
  return element("div", {}, element("dt", {}, name),
    ...values.map(value => element("dd", {}, value)));
}

/** A position or velocity, on a line or in a plane. */
const vectorText = numbers => [numbers].flat().join("; ");

const motionRow = (name, {position, velocity}) =>
  stateRow(name, `x = ${vectorText(position)}`, `v = ${vectorText(velocity)}`);

/** The numbers that `piblocks state` prints, as exact as there. */
function stateRows({state, frame}, facts) {
  const rows = [];
  if (state !== null) {
    const {collisions, time, blue, red, bodies: moving} = JSON.parse(state);
    rows.push(stateRow("Collisions", grouped(collisions)), stateRow("Time", String(time)));
    if (moving) moving.slice(0, MOST_BODIES).forEach((body, i) => rows.push(motionRow(`Body ${i + 1}`, body)));
    else rows.push(motionRow("Blue", blue), motionRow("Red", red));
  }
  if (frame !== null) {
    rows.push(stateRow("Frame", `${frame + 1} of ${facts.frames}`));
  }
  return rows;
}

function describe({state, frame}, facts) {
  if (state === null) return `Frame ${frame + 1} of a film of ${facts.frames} frames`;
  const {collisions, time, blue, red} = JSON.parse(state);
  const where = blue ? `, blue at ${blue.position}, red at ${red.position}` : "";
  return `${collisions} ${String(collisions) === "1" ? "collision" : "collisions"} at time ${time}${where}`;
}

scene.onPicture = ({x, y, width, height, pixels}) => {
  const {facts} = scene;
  if (picture.width !== facts.width || picture.height !== facts.height) {
    picture.width = facts.width;
    picture.height = facts.height;
  }
  if (width > 0) {
    const bytes = new Uint8ClampedArray(pixels, 0, 4 * width * height);
    canvas.putImageData(new ImageData(bytes, width, height), x, y);
  }
  // Memory that is too large for this picture goes.
  if (pixels.byteLength <= 4 * facts.width * facts.height) scene.recycle(pixels);
};

scene.onShown = now => {
  shown = now;
  player.updateShown(now);
  byId("state").replaceChildren(...stateRows(now, scene.facts));
  if (!player.isPlaying) labelPicture();
};

const labelPicture = () => picture.setAttribute("aria-label", describe(shown, scene.facts));
player.onPause = labelPicture;

let addressTimer = null;

/** Once nothing has changed for a while: browsers allow few changes of the address a second. */
function updateAddress() {
  clearTimeout(addressTimer);
  addressTimer = setTimeout(async () => {
    const address = await addressOfScene();
    try {
      history.replaceState(null, "", address);
    } catch {
      // Some browsers and frames let pages change no address, or not so long ones.
    }
  }, 400);
}

scene.onOpened = facts => {
  const name = shippedScene()?.name;
  byId("scenes").value = name ?? "";
  saving.name = name ?? "scene";
  showText();
  fields.update(facts);
  bodies.update(facts);
  player.update(facts);
  const notes = [facts.filmProblem && `No film: ${facts.filmProblem}`, ...(facts.notes ?? [])];
  sayIn(byId("notes"), notes.filter(note => note).join("\n"));
  updateAddress();
};

scene.onProblems = problems => {
  const others = bodies.say(fields.say(problems));
  const ofText = others.filter(problem => problem.key === "text");
  sayIn(byId("text-problem"), ofText.map(problem => problem.words).join("\n"));
  text.setAttribute("aria-invalid", String(ofText.length > 0));
  if (ofText.length > 0) byId("text-group").open = true;
  const elsewhere = others.filter(problem => problem.key !== "text");
  const names = problems.filter(problem => !elsewhere.includes(problem)).map(({key, body, property}) =>
    key === "text" ? "the scene file" : key === "bodies" ? body ? `body ${body}, ${property}` : "the bodies"
      : fields.labelOf(key) ?? bodies.labelOf(key) ?? key);
  const leftOut = names.length > 0 && `Not applied: ${[...new Set(names)].join("; ")}. See the message beside it.`;
  sayIn(byId("problem"), [linkProblem, ...elsewhere.map(problem => problem.words), leftOut]
    .filter(words => words).join("\n"));
  // If the scene of a link is wrong, the first scene is shown.
  if (!scene.facts && !hasTriedFirst) {
    hasTriedFirst = true;
    scene.replace(() => shippedText(FIRST_SCENE), "first scene");
  }
};

scene.hasField = key => fields.has(key) || bodies.has(key);

scene.onPlaceProblem = words => {
  sayIn(byId("instant-problem"), words);
  byId("instant").setAttribute("aria-invalid", String(words !== ""));
};

scene.onBusy = isBusy => {
  document.body.dataset.isBusy = String(isBusy);  // for tests, which wait for it
  clearTimeout(busyTimer);
  if (isBusy) busyTimer = setTimeout(() => byId("busy").hidden = false, 400);
  else byId("busy").hidden = true;
};

byId("stop").addEventListener("click", () => {
  scene.stop();
  byId("play").focus({preventScroll: true});
  if (!scene.facts) openShipped(FIRST_SCENE);
});

byId("scenes").append(element("option", {value: "", hidden: true}, "my own"),
  ...scenes.map(({name, summary}) => element("option", {value: name}, `${name}: ${summary}`)));
byId("scenes").addEventListener("change", () => openShipped(byId("scenes").value));

/** Shows the start of another scene. */
function open(words) {
  forgetTyping();
  player.pause();
  linkProblem = "";
  text.value = words;
  scene.open(words, {frame: 0});
}

const shippedText = name => scenes.find(one => one.name === name).text;
const openShipped = name => open(shippedText(name));

text.addEventListener("input", () => {
  clearTimeout(textTimer);
  isTextNewer = true;
  linkProblem = "";
  textTimer = setTimeout(() => {
    textTimer = null;
    scene.open(text.value);
  }, 150);
});
text.addEventListener("blur", showText);

/** @param field  gets the words, selected, if the browser forbids the page to copy */
async function copy(button, words, field) {
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

byId("show-text").addEventListener("click", () => {
  if (!scene.facts) return;
  forgetTyping();
  text.value = scene.text;
  scene.open(scene.text);
});
byId("copy-text").addEventListener("click", event => copy(event.target, text.value, text));
byId("copy-link").addEventListener("click", async event => {
  if (!scene.facts) return;
  copy(event.target, new URL(await addressOfScene(), location.href).href, byId("link"));
});
byId("link").addEventListener("blur", () => byId("link").hidden = true);
byId("go-to-save").addEventListener("click", () => {
  byId("save-group").open = true;
  byId("save-group").scrollIntoView({block: "nearest"});
  byId("save-group").querySelector("button").focus({preventScroll: true});
});
byId("settings").addEventListener("submit", event => event.preventDefault());

/** @returns whether the address has a scene. */
async function openAddress() {
  try {
    const {hash} = location;
    const found = await sceneOf(hash, scenes);
    if (hash !== location.hash) return true;
    if (found !== null) open(found);
    return found !== null;
  } catch (error) {
    linkProblem = `Link: ${error.message}`;
    sayIn(byId("problem"), linkProblem);
    return false;
  }
}
addEventListener("hashchange", openAddress);

const given = JSON.parse(byId("opened-scene").textContent);
if (!await openAddress()) {
  const words = linkProblem;
  open(given?.text ?? shippedText(FIRST_SCENE));
  linkProblem = words;
}
