// The scene in the address of the page.
// In: an address, or the text of a scene. Out: the text, or the address: "#lecture" is a scene of
// the program, "#toml=…" any other, compressed.

const toBase64 = bytes => btoa(Array.from(bytes, byte => String.fromCharCode(byte)).join(""))
  .replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
const fromBase64 = text =>
  Uint8Array.from(atob(text.replaceAll("-", "+").replaceAll("_", "/")), c => c.charCodeAt(0));

async function through(stream, bytes) {
  const result = new Blob([bytes]).stream().pipeThrough(stream);
  return new Uint8Array(await new Response(result).arrayBuffer());
}

/** Longer texts than the program takes are not even unpacked. */
const MOST_BYTES = 1 << 20;

async function addressOf(text) {
  const bytes = await through(new CompressionStream("deflate-raw"), new TextEncoder().encode(text));
  return `#toml=${toBase64(bytes)}`;
}

async function unpacked(bytes) {
  const reader = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw"))
    .getReader();
  const decoder = new TextDecoder("utf-8", {fatal: true});
  let text = "";
  for (let size = 0; ;) {
    const {done, value} = await reader.read();
    if (done) return text + decoder.decode();
    size += value.length;
    if (size > MOST_BYTES) throw new Error("longer than 1 MiB");
    text += decoder.decode(value, {stream: true});
  }
}

/** @returns the text of a scene; null if the address has none. @throws Error if it cannot be read. */
async function sceneOf(address, scenes) {
  if (address.length < 2) return null;
  const name = decodeURIComponent(address.slice(1));
  const shipped = scenes.find(scene => scene.name === name);
  if (shipped) return shipped.text;
  const packed = name.match(/^toml=([A-Za-z0-9_-]+)$/)?.[1];
  if (!packed) throw new Error(`there is no scene '${name}'`);
  try {
    return await unpacked(fromBase64(packed));
  } catch (error) {
    throw new Error(`the scene in the link cannot be read: ${error.message}`);
  }
}
