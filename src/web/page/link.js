// The scene in the address of the page.
// In: an address, or a scene and an instant. Out: the scene and the instant, or the address:
// "#lecture@16" is a scene of the program at time 16, "#toml=…" any other, compressed.

const toBase64 = bytes => btoa(Array.from(bytes, byte => String.fromCharCode(byte)).join(""))
  .replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
const fromBase64 = text =>
  Uint8Array.from(atob(text.replaceAll("-", "+").replaceAll("_", "/")), c => c.charCodeAt(0));

/** Longer texts than the program takes are not even unpacked. */
const MOST_BYTES = 1 << 20;

async function packed(text) {
  const stream = new Blob([text]).stream().pipeThrough(new CompressionStream("deflate-raw"));
  return toBase64(new Uint8Array(await new Response(stream).arrayBuffer()));
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

/** The part of an address that says which scene it is. @param name  of the program's, or undefined */
export const sceneAddress = async (text, name) => `#${name ?? `toml=${await packed(text)}`}`;

/** The part that says which place; nothing for the start.
 * @param {{instant?: string, frame?: number}} place
 * @param rate  frames and seconds of the film */
export function placeAddress({instant, frame}, shown, rate) {
  if (instant !== undefined) return `@${encodeURIComponent(instant)}`;
  if (frame === 0) return "";
  const time = shown.state === null ? frame * rate[1] / rate[0] : JSON.parse(shown.state).time;
  return `@${time}`;
}

/** @returns text and place of the address; null if it has none. @throws Error if it cannot be read. */
export async function sceneOf(address, scenes) {
  if (address.length < 2) return null;
  const [scene, instant] = address.slice(1).split("@").map(decodeURIComponent);
  const place = instant ? {instant} : {frame: 0};
  const shipped = scenes.find(one => one.name === scene);
  if (shipped) return {text: shipped.text, place};
  const bytes = scene.match(/^toml=([A-Za-z0-9_-]+)$/)?.[1];
  if (!bytes) throw new Error(`there is no scene '${scene}'`);
  try {
    return {text: await unpacked(fromBase64(bytes)), place};
  } catch (error) {
    throw new Error(`the scene in the link cannot be read: ${error.message}`);
  }
}
