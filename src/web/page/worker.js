// The program, away from the page, so that the page answers while it works.
// In: messages {id, task, ...}. Out: {id, value}, {id, problem}: what is wrong in the program's
// words, or {id, failure}: the program has broken down; {progress} meanwhile.

let program;

class Refusal extends Error {}

const TYPES = {string: "string", number: "number"};

/** Calls a function that answers in text. */
function ask(name, ...values) {
  const types = values.map(value => TYPES[typeof value]);
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

/** A frame of the film {frame}, or an instant {instant}. */
function show(place) {
  const answer = JSON.parse(place.instant === undefined
    ? ask("live_show_frame", place.frame) : ask("live_show_instant", place.instant));
  const [x, y, width, height] = answer.rect;
  return {place: answer.place, x, y, width, height,
    pixels: bytesAt("live_pixels", 4 * width * height).buffer};
}

/** Another scene may not have what the last one was looked at. */
function showIfPossible(place) {
  try {
    return show(place);
  } catch (error) {
    if (!(error instanceof Refusal)) throw error;
    return show({frame: 0});
  }
}

const tasks = {
  async start({module}) {
    program = await makeLive({
      instantiateWasm(imports, done) {
        WebAssembly.instantiate(module, imports).then(instance => done(instance, module));
        return {};
      },
      onProgress: (done, count) => postMessage({progress: count > 0 ? done / count : 0}),
    });
    return JSON.parse(ask("live_program"));
  },
  /** With a place it is also shown. */
  open({text, settings, place}) {
    const facts = JSON.parse(ask("live_open", text, settings));
    return {facts, shown: place && showIfPossible(place)};
  },
  show: ({place}) => show(place),
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
  openSound: () => Number(ask("live_open_sound")),
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
