"""Programs that read MP4 files, and may be installed.

In: a file. Out: what they say of it. A warning is a failure.
"""

import json
import re
import shutil

from decoders import HERE, Failed, npm_folder, run


class Reader:
    """Says what it finds, by the names that check_decoders expects."""

    def __init__(self, program, package):
        self.name, self.package = program, package

    def is_there(self):
        return shutil.which(self.name)


class Ffprobe(Reader):
    def about(self, file):
        text = run("ffprobe", "-v", "warning", "-of", "json", "-show_streams", "-show_format",
                   "-count_frames", file)
        found = json.loads(text)
        stream, = found["streams"]
        return {"frames": int(stream["nb_frames"]), "frames decoded": int(stream["nb_read_frames"]),
                "duration": float(found["format"]["duration"]),
                "size": (stream["width"], stream["height"]), "level": stream["level"],
                "profile": stream["profile"]}


class Mediainfo(Reader):
    def about(self, file):
        text = run("mediainfo", "--Output=JSON", file).decode()
        if re.search(r"conformance|truncated", text, re.IGNORECASE):
            raise Failed(f"mediainfo: {text}")
        _, video = json.loads(text)["media"]["track"]
        return {"frames": int(video["FrameCount"]), "duration": float(video["Duration"]),
                "size": (int(video["Width"]), int(video["Height"])),
                "level": round(10 * float(video["Format_Level"])), "profile": video["Format_Profile"]}


class Mkvmerge(Reader):
    """Says little of a file that it has not copied."""

    def about(self, file):
        found = json.loads(run("mkvmerge", "-J", file))
        if found["warnings"] or found["errors"]:
            raise Failed(f"mkvmerge: {found['warnings']} {found['errors']}")
        copy = file.with_suffix(".mkv")
        # Its exit code is 1 if there are warnings.
        run("mkvmerge", "--quiet", "-o", copy, file)
        found = json.loads(run("mkvmerge", "-J", copy))
        frames = re.findall(r"^[IPB] frame, ", run("mkvinfo", "-s", copy).decode(), re.MULTILINE)
        width, height = found["tracks"][0]["properties"]["pixel_dimensions"].split("x")
        copy.unlink()
        return {"frames": len(frames), "size": (int(width), int(height)),
                "duration": found["container"]["properties"]["duration"] / 1e9}


class GstDiscoverer(Reader):
    def about(self, file):
        text = run("gst-discoverer-1.0", "-v", file).decode()
        if re.search("warning|error|missing", text, re.IGNORECASE):
            raise Failed(text)
        caps = dict(re.findall(r"([\w-]+)=\(\w+\)([^,\n]+)", text))
        return {"duration": seconds(re.search(r"Duration: (\S+)", text)[1]),
                "size": (int(caps["width"]), int(caps["height"])),
                "level": round(10 * float(caps["level"])),
                "profile": caps["profile"].replace("-", " ").title()}


class Exiftool(Reader):
    def about(self, file):
        found, = json.loads(run("exiftool", "-n", "-json", "-validate", "-warning", "-error", "-a",
                                "-MediaDuration", "-ImageWidth", "-ImageHeight", file))
        # Numbers of errors, of warnings, and of minor ones.
        if found["Validate"] != "0 0 0":
            raise Failed(f"exiftool: {found}")
        return {"duration": found["MediaDuration"],
                "size": (found["ImageWidth"], found["ImageHeight"])}


class Mp4box:
    """GPAC's reader for browsers; GPAC itself is not in Debian 12."""

    name, package = "mp4box (Node.js)", "mp4box of npm"

    def is_there(self):
        return npm_folder("mp4box")

    def about(self, file):
        found = json.loads(run("node", HERE / "node_mp4box.mjs", npm_folder("mp4box"), file))
        return {"frames": found["frames"], "duration": found["duration"],
                "size": tuple(found["size"]), "level": int(found["codec"][-2:], 16)}


def seconds(clock):
    """Of hours:minutes:seconds."""
    hours, minutes, rest = clock.split(":")
    return 3600 * int(hours) + 60 * int(minutes) + float(rest)


READERS = [Ffprobe("ffprobe", "ffmpeg"), Mediainfo("mediainfo", "mediainfo"),
           Mkvmerge("mkvmerge", "mkvtoolnix"),
           GstDiscoverer("gst-discoverer-1.0", "gstreamer1.0-plugins-base-apps"),
           Exiftool("exiftool", "libimage-exiftool-perl"), Mp4box()]
