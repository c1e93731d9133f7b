// Edits of a scene's keys, and what the program says of them.
// In: values of keys, messages of the program. Out: the lines that the program reads; for each message
// the key that it belongs to.

/** Keys that set the same value: an edit of one replaces those of the others. */
const KEYS_OF_ONE_VALUE = [["digits", "mass-ratio", "red.mass"], ["time.speed", "time.duration"]];
const isAlike = (one, other) =>
  one === other || KEYS_OF_ONE_VALUE.some(keys => keys.includes(one) && keys.includes(other));

/** The lines of what the program says of an edit, without the name of its key. */
const messageLines = (message, key) => message.split("\n")
  .map(line => line.startsWith(`${key}: `) ? line.slice(key.length + 2) : line)
  .map(line => line.replace(/^scene:\d+: /, ""));

/** Problems {key, words} of a text: of the lines of a file, or {…, body, property} of the bodies in a
 * table. */
function problemsOfText(message, key) {
  return message.split("\n").map(line => {
    if (key !== "bodies") return {key, words: line.replace(/^scene:(\d+):/, "line $1:")};
    const words = line.replace(/^scene:\d+: /, "");
    const [, body, property] = words.match(/^body (\d+)\.(\w+)/) ?? [];
    return {key, words, body: Number(body), property};
  });
}

/** Values of keys, in the order in which they were set; no two set the same. */
class Edits {
  #values;

  constructor(values = []) {
    this.#values = new Map(values);
  }

  get list() {
    return [...this.#values];
  }
  get isEmpty() {
    return this.#values.size === 0;
  }
  has([key, value]) {
    return this.#values.get(key) === value;
  }
  hasKey(key) {
    return this.#values.has(key);
  }
  set(key, value) {
    for (const other of this.#values.keys()) {
      if (isAlike(key, other)) this.#values.delete(other);
    }
    this.#values.set(key, value);
  }
  /** @returns whether it was there. */
  delete(key) {
    return this.#values.delete(key);
  }
  /** These, and then the others. */
  with(others) {
    const all = new Edits(this.#values);
    for (const [key, value] of others) all.set(key, value);
    return all;
  }
  /** The lines that the program reads. */
  get lines() {
    return this.list.map(([key, value]) => `${key}=${value}`).join("\n");
  }
}
