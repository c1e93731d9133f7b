// The program in workers.
// In: tasks of worker.js. Out: promises of what they say.

import {byId} from "./dom.js";

/** The program says that this cannot be done: `problems` are {origin, key, reason}. */
export class Refusal extends Error {
  constructor(problems) {
    super(problems.map(wordsOf).join("\n"));
    this.problems = problems;
  }
}
/** The program has broken down, or was stopped. */
export class Failure extends Error {}
/** What a Failure says of work that somebody has ended. */
export const STOPPED = "stopped";

/** A problem as a sentence. @param own  the key of the field beside which it stands, if there is one */
export const wordsOf = ({key, reason}, own = "") =>
  !key || key === own ? reason.replace(/^= \S*?: (?=\S)/, "") : `${key} ${reason}`;

async function compiledProgram() {
  const text = atob(byId("program").textContent);
  byId("program").remove();
  const packed = new Uint8Array(text.length);
  // Uint8Array.from() takes half a second.
  for (let i = 0; i < text.length; ++i) packed[i] = text.charCodeAt(i);
  const unpacked = new Response(packed).body.pipeThrough(new DecompressionStream("gzip"));
  const type = {headers: {"Content-Type": "application/wasm"}};
  return WebAssembly.compileStreaming(new Response(unpacked, type));
}

/** One worker, which does one task after the other. */
export class Program {
  static #module = compiledProgram();
  static #script = URL.createObjectURL(
    new Blob([byId("worker").textContent], {type: "text/javascript"}));

  #worker = new Worker(Program.#script);
  #waiting = new Map();
  #next = 0;
  /** What the program has, once it has started. */
  started;
  onProgress = done => {};

  constructor() {
    this.#worker.onmessage = ({data}) => this.#receive(data);
    this.#worker.onerror = event => this.stop(event.message || "the worker cannot be started");
    this.started = Program.#module.then(module => this.#send("start", {module}));
    this.started.catch(() => {});
  }

  async call(task, details = {}, transfer = []) {
    await this.started;
    return this.#send(task, details, transfer);
  }

  #send(task, details, transfer = []) {
    if (this.isStopped) return Promise.reject(new Failure(STOPPED));
    const id = this.#next++;
    this.#worker.postMessage({id, task, ...details}, transfer);
    return new Promise((resolve, reject) => this.#waiting.set(id, {resolve, reject}));
  }

  #receive({id, progress, value, problems, failure}) {
    if (this.isStopped) return;
    if (progress !== undefined) {
      this.onProgress(progress);
      return;
    }
    const {resolve, reject} = this.#waiting.get(id);
    this.#waiting.delete(id);
    if (problems !== undefined) reject(new Refusal(problems));
    else if (failure === undefined) resolve(value);
    else {
      reject(new Failure(failure));
      // Pending calls would never finish.
      this.stop(failure);
    }
  }

  /** Ends the worker, even in the middle of a task. Pending and later calls fail. */
  stop(reason = STOPPED) {
    if (this.isStopped) return;
    this.isStopped = true;
    this.#worker.terminate();
    for (const {reject} of this.#waiting.values()) reject(new Failure(reason));
    this.#waiting.clear();
  }
}
