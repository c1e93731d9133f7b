// Functions that stay in the page while it is checked.
// In: what a person would do. Out: what the page shows and saves.

const LIMIT_ms = 60000;
const byId = id => document.getElementById(id);
const later = milliseconds => new Promise(done => setTimeout(done, milliseconds));

/** Waits until it is so. */
async function until(what, isSo, limit_ms = LIMIT_ms) {
  for (const start = performance.now(); !isSo(); await later(1)) {
    if (performance.now() - start > limit_ms) throw new Error(`${what}: not within ${limit_ms} ms`);
  }
}

function set(input, value) {
  if (input.type === "checkbox") input.checked = value;
  else input.value = value;
  input.dispatchEvent(new Event("input", {bubbles: true}));
  input.dispatchEvent(new Event("change", {bubbles: true}));
}

const isThere = one => !one.closest("[hidden]");
const isSeen = one => one.checkVisibility ? one.checkVisibility() : isThere(one);

/** What is wrong, as far as it can be seen. */
const problems = () => [...document.querySelectorAll("#problem, .problem")]
  .filter(one => isSeen(one) && one.textContent).map(one => one.textContent);

const idle = () => until("the page is idle", () => document.body.dataset.isBusy === "false");

/** Presses a button, or does anything else, and waits for what comes of it. */
async function after(action) {
  action();
  await idle();
  return problems();
}

/** Where its value is typed or chosen; a key may have a slider elsewhere. */
const field = key => document.querySelector(`[data-key="${key}"] input[type=text]`) ??
  document.querySelector(`[data-key="${key}"] :is(select, input)`);

/** What is said beside a field, or in an element of this id. */
function said(name) {
  const problem = byId(name) ?? byId(field(name).getAttribute("aria-describedby"));
  return problem.hidden ? "" : problem.textContent;
}

/** What all fields show, and whether they are wrong. Those in closed groups count, too. */
function shown() {
  const values = {};
  for (const input of document.querySelectorAll("[data-key] :is(input, select), .bodies input")) {
    if (!isThere(input)) continue;
    const root = input.closest("[data-key]");
    const index = root ? [...root.querySelectorAll("input, select")].indexOf(input) : "";
    const name = `${root?.dataset.key ?? input.getAttribute("aria-label")} ${index}`;
    const isWrong = input.getAttribute("aria-invalid") === "true";
    values[name] = `${input.type === "checkbox" ? input.checked : input.value}${isWrong ? ", wrong" : ""}`;
  }
  return values;
}

/** {name: texts} of the state. */
const stateRows = () => Object.fromEntries([...document.querySelectorAll("#state dt")].map(
  name => [name.textContent, [...name.parentElement.querySelectorAll("dd")].map(one => one.textContent)]));

function words(source, width, height) {
  const data = source.getContext("2d").getImageData(0, 0, width, height).data;
  return new Uint32Array(data.buffer);
}

/** The picture in few letters. */
function digest() {
  const {width, height} = byId("picture");
  let sum = 0x811c9dc5;
  for (const word of words(byId("picture"), width, height)) sum = Math.imul(sum ^ word, 0x01000193);
  return `${width}x${height} ${(sum >>> 0).toString(16)}`;
}

async function decoded(png) {
  const bytes = Uint8Array.from(atob(png), c => c.charCodeAt(0));
  const image = await createImageBitmap(new Blob([bytes], {type: "image/png"}),
    {premultiplyAlpha: "none", colorSpaceConversion: "none"});
  const canvas = document.createElement("canvas");
  Object.assign(canvas, {width: image.width, height: image.height});
  canvas.getContext("2d", {willReadFrequently: true}).drawImage(image, 0, 0);
  return canvas;
}

/** Pixels of the page's picture that differ from this PNG, as this browser decodes it. */
async function differences(png) {
  const expected = await decoded(png);
  const {width, height} = expected;
  const picture = byId("picture");
  if (picture.width !== width || picture.height !== height) return width * height;
  const found = words(picture, width, height);
  return words(expected, width, height).reduce((sum, one, i) => sum + (one !== found[i]), 0);
}

/** What the page has saved, the last one last. Scripts of workers are no files. */
const files = [];
const createAddress = URL.createObjectURL;
URL.createObjectURL = blob => {
  if (!blob.type.startsWith("text/")) files.push(blob);
  return createAddress.call(URL, blob);
};

async function base64(blob) {
  const address = await new Promise(done => {
    const reader = new FileReader();
    reader.onload = () => done(reader.result);
    reader.readAsDataURL(blob);
  });
  return address.split(",")[1];
}

const saver = extension => document.querySelector(`[data-save=${extension}]`);

/** Saves by a button. @returns {base64, seconds} of the file, or {problem} */
async function save(extension) {
  const start = performance.now();
  const count = files.length;
  saver(extension).click();
  await until(`${extension} is saved`, () => files.length > count || said("saving-problem"));
  if (files.length === count) return {problem: said("saving-problem")};
  const seconds = (performance.now() - start) / 1000;
  return {base64: await base64(files.at(-1)), seconds};
}

window.check = {
  after, base64, differences, digest, field, files, idle, isThere, later, problems, stateRows, said, save,
  saver, set, shown, until,
  /** Later than the page waits for more of a text. */
  async open(text) {
    set(byId("text"), text);
    await later(160);
    await idle();
    return problems();
  },
  go(instant) {
    byId("instant").value = instant;
    return check.press("go");
  },
  press: id => after(() => byId(id).click()),
  edit: (key, value) => after(() => set(field(key), value)),
  moveSlider: (key, value) =>
    after(() => set(document.querySelector(`[data-key="${key}"] input[type=range]`), value)),
  choose: name => after(() => set(byId("scenes"), name)),
  /** A cell of the table of bodies, which are counted from 0. */
  cell: (number, property) => document.querySelectorAll(`.bodies input[data-property=${property}]`)[number],
  editCell: (number, property, value) => after(() => set(check.cell(number, property), value)),
};
