// The program, away from the page, so that the page answers while it works.
// In: messages {id, task, ...}. Out: {id, value}, {id, problems}: a list {origin, key, reason} of what
// is wrong, or {id, failure}: the program has broken down; {progress} meanwhile.

let program;

class Refusal extends Error {
  constructor(problems) {
    super();
    this.problems = problems;
  }
}

/** The program refuses texts of this length. Longer ones are cut, since it has no room for them. */
const REFUSED_LENGTH = (1 << 20) + 1;

/** Checks an argument. The program reads C strings, which end at the first NUL. */
function argument(value) {
  if (typeof value !== "string") return value;
  if (value.includes("\0")) {
    throw new Refusal([{origin: "", key: "", reason: "The text has a character U+0000."}]);
  }
  return value.slice(0, REFUSED_LENGTH);
}

/** Calls a function that answers in text. */
function ask(name, ...given) {
  const values = given.map(argument);
  const types = values.map(value => ArrayBuffer.isView(value) ? "array" : typeof value);
  const isDone = program.ccall(name, "boolean", types, values);
  const answer = program.ccall("live_answer", "string", [], []);
  if (!isDone) throw new Refusal(JSON.parse(answer).problems);
  return answer;
}

/** The program's own memory, which it writes to in the next task. */
function memoryAt(name, size) {
  const start = program.ccall(name, "pointer", [], []);
  return program.HEAPU8.subarray(start, start + size);
}

/** Memory of an earlier picture, for the next one: new memory takes longer than its pixels. */
let spare = new ArrayBuffer(0);

/** @returns memory that begins with these bytes. */
function copied(bytes) {
  const memory = spare.byteLength < bytes.length ? new ArrayBuffer(bytes.length) : spare;
  spare = new ArrayBuffer(0);
  new Uint8Array(memory).set(bytes);
  return memory;
}

function readAndRemove(name) {
  const bytes = program.FS.readFile(name);
  program.FS.unlink(name);
  return bytes;
}

/** The line that the program reads for a place: {frame} of the film, or {instant}. */
const lineOf = ({frame, instant}) => instant === undefined ? `frame ${frame}` : `instant ${instant}`;

/** The picture: `pixels` begins with those of a rectangle, outside of which it is the one before;
 * `shown` is what it shows. */
function pictureOf({shown, rect: [x, y, width, height]}) {
  return {shown, x, y, width, height, pixels: copied(memoryAt("live_pixels", 4 * width * height))};
}

const tasks = {
  async start({module}) {
    let failed;
    const failure = new Promise((_, reject) => failed = reject);
    const started = makeLive({
      instantiateWasm(imports, done) {
        WebAssembly.instantiate(module, imports).then(instance => done(instance, module)).catch(failed);
        return {};
      },
      onProgress: (done, count) => postMessage({progress: count > 0 ? done / count : 0}),
    });
    program = await Promise.race([started, failure]);
    return JSON.parse(ask("live_program"));
  },
  /** Opens a scene and shows the first of the places that it has, otherwise its start.
   * @param places  if there are none, nothing is shown
   * @param screen  the size of the picture, "1080x1350", if it is not the scene's */
  open({text, settings, places = [], screen = ""}) {
    const {picture, ...answer} =
      JSON.parse(ask("live_open", text, settings, places.map(lineOf).join("\n"), screen));
    return {...answer, picture: picture && pictureOf(picture)};
  },
  /** What cannot be added to the picture, and why. */
  choices: () => JSON.parse(ask("live_choices")),
  /** @param place  or {step}: 1 is the next collision, -1 the one before, or the start before the first
   * @returns null if there is no such collision */
  show({place}) {
    const answer = place.step ? ask("live_step", place.step) : ask("live_show", lineOf(place));
    const picture = JSON.parse(answer);
    return picture && pictureOf(picture);
  },
  /** Takes back the memory of a picture. */
  recycle({pixels}) {
    spare = pixels;
  },
  save({name}) {
    ask("live_save", name);
    return readAndRemove(name);
  },
  /** @param number, count  the shard; count is 0 for the whole film */
  render({name, number, count}) {
    const file = ask("live_render", name, number, count);
    return {file, bytes: readAndRemove(file)};
  },
  /** @param shards  {file, bytes} of all, as render() returns them
   * @param sound  as encodeSoundtrack() returns it */
  join({name, shards, sound}) {
    if (sound) {
      ask("live_begin_sound", sound.codec, sound.config, sound.config.length, sound.packetSamples, sound.delay);
      for (const packet of sound.packets) ask("live_add_sound", packet, packet.length);
    }
    for (const {file, bytes} of shards) program.FS.writeFile(file, bytes);
    const whole = readAndRemove(ask("live_join", name, shards.length));
    for (const {file} of shards) program.FS.unlink(file);
    return whole;
  },
  openSound: () => ask("live_open_sound"),
  readSound({first, count}) {
    const pairs = Number(ask("live_read_sound", first, count));
    return new Float32Array(memoryAt("live_samples", 8 * pairs).slice().buffer);
  },
};

/** Memory that the page may have, instead of a copy. */
function transferred(value) {
  const bytes = value?.bytes ?? value;
  if (ArrayBuffer.isView(bytes)) return [bytes.buffer];
  const picture = value?.picture ?? value;
  return picture?.pixels ? [picture.pixels] : [];
}

self.onmessage = async ({data: {id, task, ...details}}) => {
  try {
    const value = await tasks[task](details);
    postMessage({id, value}, transferred(value));
  } catch (error) {
    if (error instanceof Refusal) postMessage({id, problems: error.problems});
    else postMessage({id, failure: String(error?.message ?? error)});
  }
};
