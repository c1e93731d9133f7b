// Decoders of npm: Hantro's, which came with Android, in WebAssembly and in asm.js.
// In: "tinyh264" or "broadway-player", its folder, a byte stream. Out, on standard output: for each
// picture its width and height as 32-bit integers, and its planes, not cropped.
import fs from "node:fs";
import {createRequire} from "node:module";
import path from "node:path";

const [name, folder, stream] = process.argv.slice(2);

/** The NAL units of a byte stream, each with its start code. */
function* nalUnits(bytes) {
  let start = -1;
  for (let at = bytes.indexOf("\0\0\x01"); at >= 0; at = bytes.indexOf("\0\0\x01", at + 3)) {
    if (start >= 0) yield bytes.subarray(start, at - (bytes[at - 1] === 0));
    start = at;
  }
  yield bytes.subarray(start);
}

function show(planes, width, height) {
  const head = Buffer.alloc(8);
  head.writeInt32LE(width, 0);
  head.writeInt32LE(height, 4);
  fs.writeSync(1, head);
  for (let at = 0; at < planes.length;) at += fs.writeSync(1, planes, at);
}

/** An ES module in a package that does not say so. */
function load(file) {
  const text = fs.readFileSync(path.join(folder, file)).toString("base64");
  return import(`data:text/javascript;base64,${text}`);
}

async function tinyh264() {
  globalThis.self = {location: {href: ""}};
  const {default: Decoder} = await load("lib/TinyH264Decoder.js");
  const {default: makeModule} = await load("lib/TinyH264.js");
  return new Decoder(await makeModule(), show);
}

function broadway() {
  globalThis.print = globalThis.printErr = console.error;  // or it takes node for nothing it knows
  const {Decoder} = createRequire(import.meta.url)(folder);
  const decoder = new Decoder();
  decoder.onPictureDecoded = show;
  return decoder;
}

const decoder = name === "tinyh264" ? await tinyh264() : broadway();
for (const unit of nalUnits(fs.readFileSync(stream))) decoder.decode(unit);
