"""Decoders of H.264 that may be installed.

In: a byte stream in a file. Out: a hash of the planes of every picture.
"""

import functools
import hashlib
import os
import pathlib
import re
import shutil
import struct
import subprocess

HERE = pathlib.Path(__file__).resolve().parent


class Failed(Exception):
    """A decoder gives up, or has something to say."""


def run(*command):
    """What it prints; it may not complain."""
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    complaints = done.stderr.decode(errors="replace").strip()
    if done.returncode != 0 or complaints:
        raise Failed(f"{command[0]}: exit code {done.returncode}: {complaints[:500]}")
    return done.stdout


class Stream:
    """A byte stream, its size in pixels, and where its access units are."""

    def __init__(self, file, width, height):
        self.file, self.width, self.height = file, width, height

    def hashes(self, planes):
        """Of pictures one after another."""
        size = self.width * self.height * 3 // 2
        if len(planes) % size:
            raise Failed("not a whole number of pictures")
        return [hashlib.sha256(planes[at:at + size]).hexdigest()
                for at in range(0, len(planes), size)]

    def units(self):
        """[first byte, number of bytes, whether it is a key frame] of each."""
        data = self.file.read_bytes()
        starts, is_key, has_slice = [], [], True
        at = data.find(b"\0\0\1")
        while at >= 0:
            kind = data[at + 3] & 31
            is_first_slice = kind in (1, 5) and data[at + 4] & 128 != 0
            if has_slice and (is_first_slice or kind in (6, 7, 8, 9)):
                starts.append(at - (at > 0 and data[at - 1] == 0))
                is_key.append(False)
                has_slice = False
            if kind in (1, 5):
                has_slice = True
                is_key[-1] = kind == 5
            at = data.find(b"\0\0\1", at + 3)
        ends = [*starts[1:], len(data)]
        return [[start, end - start, key] for start, end, key in zip(starts, ends, is_key)]

    def codec(self):
        """As browsers call it."""
        data = self.file.read_bytes()
        at = data.index(b"\0\0\1\x67") + 4
        return "avc1." + data[at:at + 3].hex()


class Libavcodec:
    """What the others are compared with."""

    name = "libavcodec (ffmpeg)"
    package = "ffmpeg"

    def is_there(self):
        return shutil.which("ffmpeg")

    def pictures(self, stream):
        text = run("ffmpeg", "-v", "warning", "-xerror", "-err_detect", "explode", "-i", stream.file,
                   "-fps_mode", "passthrough", "-f", "framehash", "-hash", "SHA256", "-").decode()
        return re.findall(r"^0,.* (\w{64})$", text, re.MULTILINE)


class GStreamer:
    package = "gstreamer1.0-tools and gstreamer1.0-plugins-bad"

    def __init__(self, element, package=None):
        self.element, self.name = element, f"{element} (GStreamer)"
        self.package = package or self.package

    def is_there(self):
        return shutil.which("gst-inspect-1.0") and all(
            subprocess.run(["gst-inspect-1.0", "--exists", element]).returncode == 0
            for element in (self.element, "h264parse", "videocodectestsink"))

    def pictures(self, stream):
        planes = stream.file.with_suffix(".yuv")
        printed = run("gst-launch-1.0", "-q", "filesrc", f"location={stream.file}", "!", "h264parse",
                      "!", self.element, "!", "videocodectestsink", f"location={planes}")
        if printed:
            raise Failed(printed.decode(errors="replace")[:500])
        found = planes.read_bytes()
        planes.unlink()
        return stream.hashes(found)


@functools.cache
def npm_folder(package):
    """Where a package is that was installed globally, or where NODE_PATH says; None if nowhere."""
    if not shutil.which("node") or not shutil.which("npm"):
        return None
    known = subprocess.run(["npm", "root", "-g"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                           text=True, check=True).stdout.strip()
    folders = [pathlib.Path(path) / package
               for path in [*os.environ.get("NODE_PATH", "").split(":"), known] if path]
    return next((folder for folder in folders if folder.is_dir()), None)


class Npm:
    """A package that node_decoders.mjs knows. Its pictures are not cropped."""

    def __init__(self, module):
        self.module, self.name, self.package = module, f"{module} (Node.js)", f"{module} of npm"

    def is_there(self):
        return npm_folder(self.module)

    def pictures(self, stream):
        found = run("node", HERE / "node_decoders.mjs", self.module,
                    npm_folder(self.module), stream.file)
        planes, at = [], 0
        while at < len(found):
            width, height = struct.unpack_from("<ii", found, at)
            at += 8
            for step in (1, 2, 2):
                for y in range(stream.height // step):
                    row = at + y * (width // step)
                    planes.append(found[row:row + stream.width // step])
                at += width // step * (height // step)
        return stream.hashes(b"".join(planes))


DECODERS = [
    Libavcodec(),
    GStreamer("avdec_h264", "gstreamer1.0-libav"),
    GStreamer("openh264dec"),
    GStreamer("vah264dec", "a graphics processor that decodes"),
    Npm("tinyh264"),
    Npm("broadway-player"),
]
