"""Calls the package with random values of random types.

In: seconds, and a seed. Out: success if nothing crashes, hangs, or raises what is not documented.
Sizes, digits and lengths are small where large ones are legal and only take long.

usage: fuzz_binding.py [SECONDS [SEED]]
"""

import faulthandler
import io
import os
import pickle
import random
import sys
import tempfile
import time
from decimal import Decimal
from fractions import Fraction

import numpy as np

import piblocks
from piblocks import Scene

#: What may be raised: the package's own, and what Python says of wrong types and numbers.
DOCUMENTED = (piblocks.Error, TypeError, IndexError)
LONGEST_S = 5

TEXTS = ["", "0", "1", "last", "turn", "turn-0.3", "#3", "#-1", "#", "1/3", "1/0", "100^7", "9^9^9",
         "2^4000001", "nan", "inf", "-0", "1e400", "1e-400", "a\0b", "\ud800", "é", "x" * 2000,
         "auto", "off", "true", "by-mass", "lecture", "dark", "64x36", "128x72", "0x0", "1x1",
         "-1x5", "3x3x3", "velocity,time", "energy", "opaque", "transparent", "turn:2",
         "turn-1:turn+1:10", "%s%n", "--size", "a.mp4", "..", "/", "\n", "'", '"', "2/3", "{}"]
NUMBERS = [0, 1, -1, 2, 3, 4, 7, 36, 37, 60, 0.1, -0.5, 1e-300, 1e300, float("nan"), float("inf"),
           -float("inf"), 2**31, 2**63, -(2**63), 2**64, 10**50, Fraction(1, 3), Fraction(-7, 2),
           Decimal("0.1"), Decimal("NaN"), Decimal("1e400"), Decimal("-Infinity"), np.float32(0.1),
           np.int8(-3), np.uint64(2**64 - 1), np.float16(3), np.longdouble(2), True, False,
           np.bool_(True)]
OTHERS = [None, b"1", 1j, object(), {1}, {}, [], (), [[1]], range(3), int, len, np.array(3),
          np.array([1.0, 2.0]), np.array([["a"]]), np.zeros((2, 0)), np.array([None]),
          np.array([b"x"]), np.datetime64("2020-01-01"), io.BytesIO(), float, ..., NotImplemented]


class Fuzzer:
    def __init__(self, seed):
        self.random = random.Random(seed)
        self.calls = 0
        self.scene = Scene(1, view_size="64x36", view_fps=5)

    def value(self, depth=0):
        kind = self.random.random()
        if kind < 0.4:
            return self.random.choice(TEXTS)
        if kind < 0.75:
            return self.random.choice(NUMBERS)
        if kind < 0.87 and depth < 3:
            return [self.value(depth + 1) for _ in range(self.random.randrange(4))]
        if kind < 0.9 and depth < 3:
            return {self.random.choice(self.keys()): self.value(depth + 1) for _ in range(2)}
        return self.random.choice(OTHERS)

    def likely(self, *choices):
        return self.random.choice(choices) if self.random.random() < 0.6 else self.value()

    def instant(self):
        return self.likely(0, 3.5, "last", "turn", "#1", "turn+1/7", Fraction(1, 3))

    def keys(self):
        return [*piblocks.keys(), "part", "card", "seconds", "compare", "split", "fade", "view",
                "time", "x", "view.size", "", "\0"]

    def good_key(self):
        return self.random.choice([
            ("digits", 2), ("mass_ratio", "1/3"), ("base", 7), ("blue_position", 1.5),
            ("red_velocity", -3), ("view_theme", "lecture"), ("show_panels", "count"),
            ("show_overlays", ["time", "masses"]), ("view_background", "transparent"),
            ("time_slow_motion", "auto"), ("time_freeze", "turn:0.5"), ("sound_on", True),
            ("view_shutter", 0.5), ("time_loop", True), ("show_title", "π"), ("time_duration", 1)])

    def new_scene(self):
        r = self.random
        keys = dict(self.good_key() for _ in range(r.randrange(4)))
        for _ in range(r.choice([0, 0, 1, 2])):
            keys[r.choice(self.keys())] = self.value()
        if r.random() < 0.1:
            keys["part"] = [dict([self.good_key()]) if r.random() < 0.5 else self.value()
                            for _ in range(r.randrange(4))]
        maker = r.randrange(5)
        if maker == 0:
            return Scene.shipped(self.likely("equal-masses", "storyboard", "base-2"), **keys)
        if maker == 1:
            return Scene.from_toml_text(self.text(), **keys)
        if maker == 2:
            return Scene.from_toml(self.likely("a.toml", "none.toml"), **keys)
        if maker == 3:
            return self.scene.replace(**keys)
        return Scene(**keys)

    def text(self):
        if self.random.random() < 0.2:
            return self.value()
        text = self.scene.to_toml()
        at = self.random.randrange(len(text) + 1)
        return text[:at] + self.random.choice(TEXTS) + text[at + self.random.randrange(3):]

    def bounded(self, scene):
        """Of a size and a length that take no time, or None."""
        small = scene.replace(view_size="64x36", view_fps=5, sound_on=False) if self.random.random(
        ) < 0.95 else scene
        if small.size[0] * small.size[1] > 200 * 200:
            return None
        return small if len(small.frames()) <= 200 else None

    def call(self):
        r = self.random
        if r.random() < 0.5:
            scene = self.new_scene()
            assert pickle.loads(pickle.dumps(scene)) == scene == eval(repr(scene)), repr(scene)
            # The path of a logo becomes absolute.
            text = scene.to_toml()
            if "show.logo" not in text and Scene.from_toml_text(text) != scene:
                raise AssertionError(f"{scene!r}: to_toml() reads back as another scene")
            if (small := self.bounded(scene)) is not None:
                self.scene = small
        ask = r.choice([self.numbers, self.frames, self.files, self.golden,
                        self.compare, self.functions])
        ask(self.scene)

    def numbers(self, scene):
        r = self.random
        scene.state(self.instant(), bounds=self.likely(True, False),
                    engine=self.likely("unfolded", "events"))
        scene.state([self.instant() for _ in range(r.randrange(4))])
        scene.log(from_=self.likely(None), to=self.likely(None), first=self.likely(None, 1),
                  last=self.likely(None), limit=self.likely(1, 100),
                  engine=self.likely("unfolded", "events"))
        assert isinstance(scene.count, int)

    def frames(self, scene):
        frames = scene.frames()
        index = self.likely(0, -1, 5)
        frames = scene.frames(rgba=self.likely(True, False))
        frames[index] if not isinstance(index, slice) else None
        frames[:: self.likely(1, -1, 7)]
        frames.png(self.likely(0))
        frames.time(self.likely(0))
        scene.frame(self.instant())

    def files(self, scene):
        r = self.random
        def progress(done, total):
            if r.random() < 0.1:
                raise piblocks.Error("enough")

        name = self.likely("a.mp4", "a.png", "a.gif", "a.html", "a.webm", "%02d.png", "a.wav",
                           "a.y4m", "null", "a.framehash", "a.apng", "a.webp", "a.svg")
        if isinstance(name, (str, bytes)) and str(name).startswith(("/", "..")):
            return
        kind = r.randrange(4)
        if kind == 0:
            scene.still(self.likely("a.png", "a.svg", io.BytesIO()) if r.random() < 0.5 else name,
                        self.instant(), format=self.likely(None))
        elif kind == 1:
            scene.sheet(name, frames=self.likely(None, 2), by=self.likely(None, "time"),
                        at=self.likely(None))
        else:
            options = {option: self.value() for option in r.sample(
                ["crf", "preset", "encoder", "start_number", "plays", "smallest", "captions", "frames", "part", "bundle", "poster",
                 "max_flashes", "profile", "resume", "jobs"], r.choice([0, 0, 1, 2]))}
            scene.render(name, progress=self.likely(None, progress), for_=self.likely(None, "web"),
                         **options)._repr_html_()

    def golden(self, scene):
        act = self.random.choice([scene.golden_record, scene.golden_approve, scene.golden_check])
        act(self.likely("a", "b"), self.likely("golden"), frames=self.likely(None, ["last"]))

    def picture(self, scene):
        r = self.random
        kind = r.randrange(6)
        if kind == 0:
            return scene.frame(0)
        if kind == 1:
            return scene.frames().png(0)[: self.likely(None, 40, 99, 10**6)]
        if kind == 2:
            shape = [r.choice([0, 1, 2, 3, 4, 36, 64]) for _ in range(r.randrange(5))]
            return np.zeros(shape, r.choice(["u1", "u2", ">u2", "i8", "f4", "?", "O", "U1"]))
        if kind == 3:
            return scene.frame("last")[:: r.choice([1, -1, 2]), :: r.choice([1, -1, 3])]
        name = self.likely("a.png", "%02d.png", "a.mp4", ".", "golden")
        # Others are large folders.
        return "a.png" if isinstance(name, str) and name.startswith(("/", "..")) else name

    def compare(self, scene):
        r = self.random
        choices = {"max_delta": (1, 0.5), "threshold": (0.1,), "count_antialiasing": (True, False),
                   "ignore_transparent": (True, False), "max_pixels": (3, "0.1%"),
                   "hard_delta": (9,), "max_window": ((16, 3), "4:0"),
                   "masks": ([(0, 0, 3, 4)], "5x5+1+1", [self.picture(scene)])}
        given = {name: self.likely(*choices[name]) for name in r.sample(
            list(choices), r.choice([0, 1, 2]))}
        result = piblocks.compare(self.picture(scene), self.picture(scene), **given)
        str(result), repr(result), result.rows, result._repr_html_()
        assert bool(result) == (result.outcome in ("equal", "accepted"))
        result.deltas()
        result.png(self.likely("diff", "actual"))

    def functions(self, scene):
        r = self.random
        repr(scene), hash(scene), scene.notes, scene.fps, scene.is_transparent
        scene == self.value()
        Scene.shipped(self.value())
        piblocks.join(self.likely(["a.mp4.part-1-of-2"]), self.likely("b.mp4"))
        piblocks._piblocks.Script(*[self.value() for _ in range(4)]) if r.random() < 0.5 else None
        piblocks._piblocks.nearest_name(self.value(), self.value())
        piblocks._piblocks.picture_of_samples(self.value())
        piblocks._piblocks.picture_of_png(self.likely(b"x")).png()
        piblocks._piblocks.compare(*[self.value() for _ in range(4)])


def allowed(error):
    """Whether this is what the documentation says."""
    if isinstance(error, DOCUMENTED):
        return True
    # Python's own: a slice with a step of 0, or int() as the callback of a rendering.
    return isinstance(error, ValueError) and str(error).startswith(("slice step", "int() base"))


def main(seconds=10.0, seed=None):
    seed = random.randrange(2**32) if seed is None else seed
    print(f"seed {seed}", flush=True)
    fuzzer = Fuzzer(seed)
    raised = {}
    slowest = 0
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        faulthandler.dump_traceback_later(60, exit=True)
        begin = time.monotonic()
        try:
            fuzzer.call()
        except Exception as error:
            raised[type(error).__name__] = raised.get(type(error).__name__, 0) + 1
            if not allowed(error):
                print(f"call {fuzzer.calls}, {fuzzer.scene!r}", flush=True)
                raise
        taken = time.monotonic() - begin
        slowest = max(slowest, taken)
        if taken > LONGEST_S:
            raise SystemExit(f"call {fuzzer.calls} took {taken:.1f} s: {fuzzer.scene!r}")
        fuzzer.calls += 1
    faulthandler.cancel_dump_traceback_later()
    print(f"{fuzzer.calls} calls, slowest {slowest:.2f} s, raised {raised}")


if __name__ == "__main__":
    faulthandler.enable()
    arguments = [float(sys.argv[1]) if len(sys.argv) > 1 else 10.0,
                 int(sys.argv[2]) if len(sys.argv) > 2 else None]
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        main(*arguments)
