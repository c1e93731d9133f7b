// What GPAC's reader for browsers says of an MP4 file.
// In: the folder of the package mp4box, a file. Out: JSON; warnings on standard error.
import fs from "node:fs";
import {createRequire} from "node:module";
import path from "node:path";

const [folder, name] = process.argv.slice(2);
const {createFile, Log} = createRequire(import.meta.url)(
  path.join(folder, "dist", "mp4box.all.cjs"));
Log.setLogLevel(Log.warn);
const file = createFile();
file.onReady = ({tracks: [track]}) => console.log(JSON.stringify({
  frames: track.nb_samples,
  duration: track.duration / track.timescale,
  size: [track.video.width, track.video.height],
  codec: track.codec
}));
const bytes = new Uint8Array(fs.readFileSync(name)).buffer;
bytes.fileStart = 0;
file.appendBuffer(bytes);
file.flush();
