// The sound of an MP4, which the browser encodes: the program has no encoder of sound here.
// In: samples, a piece after the other. Out: packets of AAC or Opus, and what the file says of them.

const RATE_hz = 48000;
/** Pairs of samples in a piece. */
const PIECE = 24000;
/** Pieces that may wait for the encoder. */
const MOST_WAITING = 4;

/** WebKitGTK 2.50 crashes when decoded samples are read, and without them the delay of its AAC is unknown. */
const canReadDecodedSound = !/Linux.*AppleWebKit(?!.*Chrome)/.test(navigator.userAgent);

/** Best first: older players know AAC alone in an MP4. */
const CODECS = [
  ...canReadDecodedSound ? [{codec: "mp4a.40.2", packetSamples: 1024, delay: measureDelay}] : [],
  // The pre-skip of its header.
  {codec: "opus", packetSamples: 960, delay: (config, header) => header[10] + 256 * header[11]},
];

const configOf = codec => ({codec, sampleRate: RATE_hz, numberOfChannels: 2, bitrate: 160000});

const bytesOf = source => ArrayBuffer.isView(source)
  ? new Uint8Array(source.buffer, source.byteOffset, source.byteLength) : new Uint8Array(source);

/** The microsecond at which a pair of samples begins. */
const timestampOf = pair => Math.round(pair / RATE_hz * 1e6);

/** Encodes pieces, left and right in turn. @returns packets, and the description of the decoder
 * @throws DOMException if the encoder refuses the samples, or breaks down later */
async function encode(config, pieces) {
  const packets = [];
  let description;
  let wake = _ => {};
  const encoder = new AudioEncoder({
    output(chunk, metadata) {
      const bytes = new Uint8Array(chunk.byteLength);
      chunk.copyTo(bytes);
      packets.push(bytes);
      description ??= metadata?.decoderConfig?.description;
    },
    error: error => wake(error),
  });
  encoder.ondequeue = event => wake(event);
  try {
    encoder.configure(config);
    let first = 0;
    for await (const data of pieces) {
      const shape = {format: "f32", sampleRate: RATE_hz, numberOfChannels: 2, numberOfFrames: PIECE};
      const samples = new AudioData({...shape, timestamp: timestampOf(first), data});
      encoder.encode(samples);
      samples.close();
      first += PIECE;
      while (encoder.state === "configured" && encoder.encodeQueueSize > MOST_WAITING) {
        await new Promise(done => wake = done);
      }
    }
    await encoder.flush();
  } finally {
    if (encoder.state !== "closed") encoder.close();
  }
  if (!description) throw new DOMException("the packets have no description");
  return {packets, description: bytesOf(description)};
}

/** Decodes packets. @returns where the left side is loudest */
async function loudestPair(config, {packets, description}, packetSamples) {
  let loudest = {value: 0, pair: 0};
  let first = 0;
  const decoder = new AudioDecoder({
    output(data) {
      const samples = new Float32Array(data.numberOfFrames);
      data.copyTo(samples, {planeIndex: 0, format: "f32-planar"});
      data.close();
      samples.forEach((sample, i) => {
        if (Math.abs(sample) > loudest.value) loudest = {value: Math.abs(sample), pair: first + i};
      });
      first += samples.length;
    },
    error() {},
  });
  decoder.configure({...config, description});
  packets.forEach((data, i) =>
    decoder.decode(new EncodedAudioChunk({type: "key", timestamp: timestampOf(i * packetSamples), data})));
  await decoder.flush();
  decoder.close();
  return loudest.pair;
}

/** Pairs of samples that an encoder of AAC puts before those that it is given. Each system has its own
 * number, and no browser tells it. */
async function measureDelay(config, _, packetSamples) {
  const click = PIECE / 2;
  const samples = new Float32Array(2 * PIECE).fill(1, 2 * click, 2 * click + 2);
  const encoded = await encode(config, [samples, new Float32Array(2 * PIECE)]);
  const delay = await loudestPair(config, encoded, packetSamples) - click;
  if (delay < 0 || delay > 8 * packetSamples) throw new DOMException("the delay of the encoder is unknown");
  return delay;
}

/** Whole pieces of the film's sound, the last one of them silent. */
async function* piecesOf(read) {
  for (let first = 0, isOver = false; !isOver; first += PIECE) {
    const samples = await read(first, PIECE);
    isOver = samples.length === 0;
    const piece = new Float32Array(2 * PIECE);
    piece.set(samples);
    yield piece;
  }
}

/** Encodes the sound of a film.
 * @param read  the samples of {first, count} pairs, left and right in turn; fewer at the end
 * @returns null if this browser encodes none */
export async function encodeSoundtrack(read) {
  if (typeof AudioEncoder === "undefined") return null;
  for (const {codec, packetSamples, delay} of CODECS) {
    const config = configOf(codec);
    try {
      if (!(await AudioEncoder.isConfigSupported(config)).supported) continue;
      const {packets, description} = await encode(config, piecesOf(read));
      return {codec, packets, config: description, packetSamples,
        delay: await delay(config, description, packetSamples)};
    } catch (error) {
      if (!(error instanceof DOMException)) throw error;
    }
  }
  return null;
}
