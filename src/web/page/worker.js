// The program, away from the page, so that the page answers while it works.
// In: messages {id, task, ...}. Out: {id, value}, {id, problem}: what is wrong in the program's
// words, or {id, failure}: the program has broken down; {progress} meanwhile.

let program;

class Refusal extends Error {}

/** The program refuses texts of this length. Longer ones are cut, since it has no room for them. */
const REFUSED_LENGTH = (1 << 20) + 1;

/** What the program can be given: it sees the end of a text in a letter 0. */
function argument(value) {
  if (typeof value !== "string") return value;
  if (value.includes("\0")) throw new Refusal("scene: has a character U+0000");
  return value.slice(0, REFUSED_LENGTH);
}

/** Calls a function that answers in text. */
function ask(name, ...given) {
  const values = given.map(argument);
  const types = values.map(value => typeof value);
  const isDone = program.ccall(name, "boolean", types, values);
  const answer = program.ccall("live_answer", "string", [], []);
  if (!isDone) throw new Refusal(answer);
  return answer;
}

const bytesAt = (name, size) => {
  const start = program.ccall(name, "pointer", [], []);
  return program.HEAPU8.slice(start, start + size);
};

function take(name) {
  const bytes = program.FS.readFile(name);
  program.FS.unlink(name);
  return bytes;
}

/** A place is a frame of the film {frame} or an instant {instant}. */
const lineOf = ({frame, instant}) => instant === undefined ? `frame ${frame}` : `instant ${instant}`;

/** What is shown, with the pixels that differ from the picture before. */
function shownOf({place, rect: [x, y, width, height]}) {
  return {place, x, y, width, height, pixels: bytesAt("live_pixels", 4 * width * height).buffer};
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
  /** Shows the first of the places that the scene has; nothing if there are none. */
  open({text, settings, places = []}) {
    const {facts, shown, placeProblem} =
      JSON.parse(ask("live_open", text, settings, places.map(lineOf).join("\n")));
    return {facts, shown: shown && shownOf(shown), placeProblem};
  },
  /** @param place  or {step}: 1 is the next collision, -1 the one before. @returns null if there is none */
  show({place}) {
    const answer = place.step ? ask("live_step", place.step) : ask("live_show", lineOf(place));
    const shown = JSON.parse(answer);
    return shown && shownOf(shown);
  },
  save({name}) {
    ask("live_save", name);
    return take(name);
  },
  render: ({name, number, count}) => take(ask("live_render", name, number, count)),
  join({name, parts}) {
    parts.forEach((bytes, i) =>
      program.FS.writeFile(`${name}.part-${i + 1}-of-${parts.length}`, bytes));
    const whole = take(ask("live_join", name, parts.length));
    parts.forEach((_, i) => program.FS.unlink(`${name}.part-${i + 1}-of-${parts.length}`));
    return whole;
  },
  openSound: () => ask("live_open_sound"),
  readSound({first, count}) {
    const pairs = Number(ask("live_read_sound", first, count));
    return new Float32Array(bytesAt("live_samples", 8 * pairs).buffer);
  },
};

/** Memory that the page may have, instead of a copy. */
function transferred(value) {
  if (ArrayBuffer.isView(value)) return [value.buffer];
  const shown = value?.shown ?? value;
  return shown?.pixels ? [shown.pixels] : [];
}

self.onmessage = async ({data: {id, task, ...details}}) => {
  try {
    const value = await tasks[task](details);
    postMessage({id, value}, transferred(value));
  } catch (error) {
    if (error instanceof Refusal) postMessage({id, problem: error.message});
    else postMessage({id, failure: String(error?.message ?? error)});
  }
};
