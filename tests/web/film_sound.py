"""The sound of films that the live page saves.

In: MP4 and WAV files; packets that a browser's encoder is to make. Out: samples, and how they lie to
each other; scripts for a page.
"""

import array
import base64
import json
import subprocess

RATE_hz = 48000

# Stands for a browser's encoder of AAC: it hands out packets that were made before, one list for each
# encoder that the page makes, and keeps what it is given.
ENCODER = """
window.check.heard = [];
const packets = %s.map(list => list.map(text => Uint8Array.from(atob(text), c => c.charCodeAt(0))));
window.AudioEncoder = class {
  static isConfigSupported = async ({codec}) => ({supported: codec === "mp4a.40.2"});
  state = "configured";
  encodeQueueSize = 0;
  #heard = [];
  constructor({output}) {
    this.output = output;
    window.check.heard.push(this.#heard);
  }
  configure() {}
  encode(data) {
    const samples = new Float32Array(2 * data.numberOfFrames);
    data.copyTo(samples, {planeIndex: 0});
    this.#heard.push(samples);
  }
  async flush() {
    for (const packet of packets[window.check.heard.indexOf(this.#heard)]) {
      this.output({byteLength: packet.length, copyTo: to => to.set(packet)},
        {decoderConfig: {description: Uint8Array.of(0x11, 0x90)}});
    }
  }
  close() {}
};"""
# What the encoder of this number was given.
HEARD = "check.base64(new Blob(check.heard[%d]))"


def ffmpeg(*arguments, given=None):
    return subprocess.run(["ffmpeg", "-v", "error", *map(str, arguments)], input=given, check=True,
                          capture_output=True).stdout


def streams_of(file):
    """{"audio": …, "video": …} as ffprobe tells them."""
    answer = subprocess.run(["ffprobe", "-v", "error", "-of", "json", "-show_streams", file], check=True,
                            capture_output=True)
    return {stream["codec_type"]: stream for stream in json.loads(answer.stdout)["streams"]}


def pictures_of(file):
    """A hash of the packets."""
    return ffmpeg("-i", file, "-map", "0:v", "-c", "copy", "-f", "md5", "-")


def left_of(file):
    """Samples of the left side, the first at time 0."""
    raw = ffmpeg("-i", file, "-map", "0:a", "-af", "aresample=async=1:first_pts=0,pan=mono|c0=c0", "-ar", RATE_hz,
                 "-f", "f32le", "-")
    return array.array("f", raw)


def lag_of(samples, original, begin, most=40):
    """By how many samples they are late, in a tenth of a second; and how like they are then: 1 is equal."""
    end = min(begin + RATE_hz // 10, len(original) - most)
    part = original[begin:end]
    alike = {lag: sum(a * b for a, b in zip(part, samples[begin + lag:end + lag])) for lag in range(-most, most + 1)}
    best = max(alike, key=alike.get)
    return best, alike[best] / sum(a * a for a in part)


def clacks(samples):
    """Where the first and the last one are: samples above a tenth of the loudest."""
    least = max(map(abs, samples)) / 10
    loud = [i for i, sample in enumerate(samples) if abs(sample) > least]
    return loud[0], loud[-1]


def aac_packets(raw, delay):
    """Packets of AAC, of samples that are left and right in turn. @param delay  of the encoder, 1024 or more"""
    silence = bytes(8 * (delay - 1024))
    stream = ffmpeg("-f", "f32le", "-ar", RATE_hz, "-ac", 2, "-i", "-", "-c:a", "aac", "-b:a", "160k", "-f", "adts", "-",
                    given=silence + raw)
    packets = []
    while stream:
        size = (stream[3] & 3) << 11 | stream[4] << 3 | stream[5] >> 5
        packets.append(stream[7:size])
        stream = stream[size:]
    return packets


def use_encoder(page, *lists):
    """Makes the page use ENCODER, with these lists of packets."""
    page.run(ENCODER % json.dumps([[base64.b64encode(one).decode() for one in packets] for packets in lists]))


def heard(page, number):
    """The samples that the encoder of this number was given, as aac_packets() takes them."""
    return base64.b64decode(page.value(HEARD % number))
