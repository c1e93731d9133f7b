"""A screen that nobody looks at, and what is seen on it.

In: programs that open windows, keys. Out: grey pictures of the screen, 20 a second.
"""

import os
import subprocess
import time

from destination import require
from pixels import are_alike, grey, is_same

WIDTH, HEIGHT = 1280, 720
SEEN_WIDTH, SEEN_HEIGHT = 320, 180
RATE = 20
# What a film shows that does not play: the slide before, nothing, its last picture behind the video, its
# first frame. A film that plays has more.
LEAST_PICTURES = 5
REST_S = 1.5  # after which a film has ended


class Screen:
    """An X server with one program on it."""

    programs = {"Xvfb": "xvfb", "xdotool": "xdotool", "ffmpeg": "ffmpeg"}

    def __init__(self, folder):
        self._seen = folder / "seen.grey"
        self._processes = []
        number, written_number = os.pipe()
        self._begin(["Xvfb", "-displayfd", str(written_number), "-screen", "0", f"{WIDTH}x{HEIGHT}x24",
                     "-nolisten", "tcp"], pass_fds=[written_number])
        os.close(written_number)
        with os.fdopen(number) as line:
            display = ":" + line.readline().strip()
        # Of a person's desktop nothing may be found.
        self._environment = {**os.environ, "DISPLAY": display, "HOME": str(folder), "XDG_RUNTIME_DIR": str(folder)}
        for name in ("WAYLAND_DISPLAY", "DBUS_SESSION_BUS_ADDRESS"):
            self._environment.pop(name, None)
        self._grab = ["ffmpeg", "-loglevel", "error", "-y", "-f", "x11grab", "-draw_mouse", "0", "-framerate",
                      str(RATE), "-video_size", f"{WIDTH}x{HEIGHT}", "-i", display]
        self._begin([*self._grab, "-vf", f"scale={SEEN_WIDTH}:{SEEN_HEIGHT}:flags=area", "-pix_fmt", "gray",
                     "-flush_packets", "1", "-f", "rawvideo", self._seen])

    def __enter__(self):
        return self

    def __exit__(self, *_):
        for process in reversed(self._processes):
            process.terminate()
            process.wait()

    def _begin(self, command, **options):
        process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                   stderr=subprocess.DEVNULL, **options)
        self._processes.append(process)
        return process

    def start(self, command, folder, **environment):
        return self._begin(command, cwd=folder, env={**self._environment, **environment})

    def do(self, *actions):
        """By mouse or keyboard, as xdotool calls it."""
        subprocess.run(["xdotool", *actions], env=self._environment, check=True)

    def now(self):
        """How many pictures have been seen."""
        return self._seen.stat().st_size // (SEEN_WIDTH * SEEN_HEIGHT) if self._seen.exists() else 0

    def seen(self, begin):
        """Pictures from this one on."""
        size = SEEN_WIDTH * SEEN_HEIGHT
        if not self._seen.exists():
            return []
        with self._seen.open("rb") as file:
            file.seek(begin * size)
            data = file.read()
        return [data[at:at + size] for at in range(0, len(data) - size + 1, size)]

    def require_end(self, what, begin, picture, seconds, plays=True):
        """From picture `begin` on, a film plays to this end and stays there."""
        expected = grey(picture, SEEN_WIDTH, SEEN_HEIGHT, fit=True)
        rest = round(REST_S * RATE)
        deadline = time.monotonic() + seconds
        while True:
            seen = self.seen(begin)
            if len(seen) > rest and all(is_same(one, seen[-1]) for one in seen[-rest:]) and are_alike(
                    seen[-1], expected, SEEN_WIDTH):
                break
            require(f"{what}: its last picture, and nothing else, within {seconds} s",
                    time.monotonic() < deadline)
            time.sleep(0.1)
        count = 1 + sum(not is_same(one, other) for one, other in zip(seen, seen[1:]))
        require(f"{what}: at least {LEAST_PICTURES} pictures, found {count}", not plays or count >= LEAST_PICTURES)

    def save_picture(self, file):
        subprocess.run([*self._grab, "-frames:v", "1", file], stdin=subprocess.DEVNULL, check=True)
