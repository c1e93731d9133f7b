// Random edits of the fields of the page, and what has to be so after each.
// In: live_page.js. Out: check.record(names), check.random(seed, count, text, next).

/** None of these is valid for a key in STRICT. */
const WRONG = ["x", "1/0", "--1", "1e", "0x10", "nan", "\u221e", "1,,2", "{", "'", "\"", "\\", "]",
  "\u05d0\u05d1", "\ud83d\ude00", "1\u00a02", "=", "#", "3 4 5", "--", "..", "1/", "/2", "e5", "[1, 2]"];
const STRICT = ["digits", "base", "mass-ratio", "blue.mass", "red.mass", "blue.position", "red.position",
  "blue.velocity", "red.velocity", "blue.width", "blocks.restitution", "wall.restitution", "wall.face",
  "time.speed", "time.ease", "time.hold-start", "time.hold-end", "view.fps", "view.shutter", "view.size"];
const NUMBERS = ["0", "1", "-1", "2", "0.5", "1/3", "1e-9", "1e9", "100^3", "100^19", "-2.5", "3.25",
  "1e400", "1e-400", "9".repeat(120), "7/5", "16", "1000000", "-0", "0.999", "12", "36", "2^2001"];
const TEXTS = ["", "turn", "last", "last+1", "turn-0.3", "#10", "#-3", "#100000000000000000000", "auto",
  "off", "turn-0.1:turn+0.1:8", "turn:1", "320x180", "640x360", "1x1", "20000x20000", "161x91",
  "a title", "1/2", "a very long title ".repeat(30), "x".repeat(3000), "30000/1001", "inf"];

const {after, isThere, stateRows, said, set, shown} = check;
const byId = id => document.getElementById(id);

/** Numbers below a size, the same for the same seed. */
function chance(seed) {
  let state = seed >>> 0;
  return size => {
    state = (state + 0x6d2b79f5) >>> 0;
    let t = Math.imul(state ^ (state >>> 15), state | 1);
    t ^= t + Math.imul(t ^ (t >>> 7), t | 61);
    return ((t ^ (t >>> 14)) >>> 0) % size;
  };
}

const anyOf = (list, below) => list[below(list.length)];

/** @returns {input, key} of a field, or of a cell of the table of bodies. */
function anyInput(below) {
  const cells = [...document.querySelectorAll(".bodies input")].filter(isThere);
  if (cells.length > 0 && below(3) === 0) return {input: anyOf(cells, below), key: "body"};
  const root = anyOf([...document.querySelectorAll("[data-key]")].filter(isThere), below);
  return {input: anyOf([...root.querySelectorAll("input, select")], below), key: root.dataset.key};
}

function anyValue(input, below) {
  if (input.type === "checkbox") return below(2) === 0;
  if (input.type === "range") return String(Number(input.min) + below(101) / 100 * (input.max - input.min));
  if (input.tagName === "SELECT") return anyOf([...input.options], below).value;
  return anyOf(anyOf([WRONG, NUMBERS, NUMBERS, TEXTS], below), below);
}

const messages = () => [...document.querySelectorAll(".field .problem, #bodies-problem, #text-problem")]
  .filter(one => !one.hidden && one.textContent);

/** Messages are beside their fields, and what cannot be a value has one. */
function faultsOfMessages(input, key, value) {
  const faults = [];
  if (said("problem")) faults.push(`no message beside a field: ${said("problem")}`);
  const isNoValue = input.type === "text" && STRICT.includes(key) && WRONG.includes(value);
  if (isNoValue && !isWrong(input)) faults.push("taken");
  if (said("text-problem")) faults.push(`beside the text: ${said("text-problem")}`);
  return faults;
}

/** Whatever is in the fields, the scene that was taken can be shown elsewhere. */
async function faultsOfNextFrame() {
  if (byId("next-frame").disabled) return [];
  const frameOf = () => (stateRows().Frame?.[0].replaceAll("\u202f", "").match(/^(\d+) of (\d+)$/) ?? []).slice(1).map(Number);
  const [before, count] = frameOf();
  await check.press("next-frame");
  const [frame] = frameOf();
  const expected = before === undefined ? frame : Math.min(before + 1, count);
  if (said("instant-problem")) return [`the next frame: ${said("instant-problem")}`];
  return frame !== undefined && frame === expected ? [] : [`the next frame is ${frame} after ${before}`];
}

async function faultsOfGoing() {
  await check.go("0");
  if (said("instant-problem")) return [`to 0: ${said("instant-problem")}`];
  const time = stateRows().Time?.[0] ?? "0";
  return Number(time) === 0 ? [] : [`at ${time} instead of 0`];
}

const goToStart = () => byId("start").disabled ? check.go("0") : check.press("start");

const look = () => ({picture: check.digest(), ...shown()});

/** What is different between two looks. */
function changes(found, expected) {
  const names = new Set([...Object.keys(expected), ...Object.keys(found)]);
  return [...names].filter(name => found[name] !== expected[name])
    .map(name => `${name}: ${found[name]} instead of ${expected[name]}`.slice(0, 200));
}

/** Fields and the picture are those of the text. */
async function faultsOfText() {
  await goToStart();
  const text = byId("text").value;
  const before = look();
  // Nothing of the scene stays.
  await check.open("");
  const problems = await check.open(text);
  if (problems.length > 0) return [`its own text: ${problems.join("; ")}`];
  // What was kept because somebody had just chosen it is left out now.
  if (isThere(byId("left-out"))) return [];
  await goToStart();
  return changes(before, look()).map(words => `unlike its own text: ${words}`);
}

/** How scenes look in a page where nothing has been edited. */
const looks = {};

check.record = async names => {
  for (const name of names) {
    await check.choose(name);
    looks[name] = look();
  }
  return true;
};

/** Another scene takes nothing with it. */
async function faultsOfScene(name) {
  await check.choose(name);
  const faults = messages().map(one => `a message stays: ${one.textContent}`);
  return [...faults, ...changes(look(), looks[name])].map(words => `${name} chosen: ${words}`);
}

const isWrong = input => input.getAttribute("aria-invalid") === "true";

/** Gives up what is wrong. */
const forget = input => after(() => {
  input.focus();
  input.dispatchEvent(new KeyboardEvent("keydown", {key: "Escape", bubbles: true}));
  input.blur();
});

async function forgetAll() {
  for (const input of document.querySelectorAll("[data-key] :is(input, select)")) {
    if (isThere(input) && isWrong(input)) await forget(input);
  }
}

/** Whoever waits so long presses Stop. */
const PATIENCE_ms = 8000;

/** @returns whether the page had to be stopped. */
async function stopIfSlow() {
  const isIdle = () => document.body.dataset.isBusy === "false";
  await check.until("the page is idle or slow", isIdle, PATIENCE_ms).catch(() => {});
  if (isIdle()) return false;
  await check.press("stop");
  return true;
}

/** The scene before is there again. */
function faultsOfStop(before) {
  const faults = messages().map(one => `a message stays after Stop: ${one.textContent}`);
  const now = look();
  const seen = Object.fromEntries(Object.keys(before).map(name => [name, now[name]]));
  return [...faults, ...changes(seen, before).map(words => `after Stop: ${words}`)];
}

/** @returns {faults, isRefused, isStopped} of one edit. */
async function editOne(below, where) {
  const {input, key} = anyInput(below);
  const value = anyValue(input, below);
  const before = messages().length === 0 ? look() : {picture: check.digest()};
  set(input, value);
  const isStopped = await stopIfSlow();
  const faults = isStopped ? faultsOfStop(before) : faultsOfMessages(input, key, value);
  const isRefused = messages().length > 0;
  // Half of the people give up what is wrong, the others go on elsewhere.
  if (isWrong(input) && below(2) === 0) await forget(input);
  if (below(4) === 0) faults.push(...await faultsOfNextFrame());
  if (below(4) === 0) faults.push(...await faultsOfGoing());
  const what = `${where}: ${key} = ${JSON.stringify(value).slice(0, 60)}`;
  return {faults: faults.map(words => `${what}: ${words}`), isRefused, isStopped};
}

/** Adds what is wrong with the text of the page, if it is that of the scene. */
async function tryText(all, where) {
  if (messages().length > 0) return;
  ++all.reopened;
  all.faults.push(...(await faultsOfText()).map(words => `${where}: ${words}`));
}

/** What was wrong with the page's answers to edits of this text, and to another scene after them. */
check.random = async (seed, count, text, next) => {
  const below = chance(seed);
  const all = {faults: [], refused: 0, reopened: 0, stopped: 0};
  await check.open(text);
  await check.edit("view.size", "640x360");
  for (let i = 0; i < count; ++i) {
    const {faults, isRefused, isStopped} = await editOne(below, `edit ${i} of seed ${seed}`);
    all.faults.push(...faults);
    all.refused += isRefused;
    all.stopped += isStopped;
    if (below(5) === 0) await tryText(all, `after edit ${i} of seed ${seed}`);
  }
  const where = `after ${count} edits of seed ${seed}`;
  if (below(2) === 0) await forgetAll();
  await tryText(all, where);
  all.faults.push(...(await faultsOfScene(next)).map(words => `${where}: ${words}`));
  return {...all, faults: all.faults.slice(0, 20)};
};
