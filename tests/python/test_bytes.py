"""The package writes the bytes of the command line."""

import io
import json
from fractions import Fraction

import numpy as np
import pytest
from command_line import call
from conftest import bytes_of

import piblocks
from piblocks import Scene

SMALL = ["--size", "128x72"]
FILM = [*SMALL, "--fps", "10", "--to", "4"]


@pytest.mark.parametrize(
    "name, options",
    [
        ("a.mp4", []),
        ("a.mp4", ["--sound"]),
        ("a.mp4", ["--encoder", "libx264", "--crf", "30", "--preset", "veryfast"]),
        ("a.gif", ["--plays", "3"]),
        ("%03d.png", ["--start-number", "700"]),
        ("%03d.png", ["--frames", "3-5"]),
        ("a.mp4", ["--sound", "--frames", "3-35"]),
        ("a.mp4", ["--part", "2/2", "--jobs", "1"]),
        ("a.mov", []),
        ("a.webm", []),
        ("a.gif", []),
        ("a.apng", ["--transparent"]),
        ("a.webp", ["--transparent"]),
        ("%02d.svg", []),
        ("a.pdf", ["--transparent"]),
        ("a.y4m", []),
        ("a.wav", []),
        ("a.html", []),
        ("a.framehash", []),
        ("%02d.png", ["--theme", "lecture", "--panels", "velocity", "--size", "640x360"]),
        ("b.mp4", ["--bundle", "talk", "--poster", "turn"]),
        ("a.mp4", ["--for", "beamer", "--to", "0.2"]),
    ],
)
def test_render(program, tmp_path, monkeypatch, name, options):
    arguments = ["render", "--digits", "2", "-o", name, *FILM]
    for option in options:  # one that is given replaces that of FILM
        if option in arguments:
            at = arguments.index(option)
            del arguments[at : at + 2]
    arguments += options
    files = []
    for run in (program, lambda *given: call(list(given))):
        folder = tmp_path / f"folder{len(files)}"
        folder.mkdir()
        monkeypatch.chdir(folder)
        run(*arguments)
        files.append({p.relative_to(folder): p.read_bytes() for p in folder.rglob("*.*") if
                      p.is_file()})
    assert files[0] and files[0] == files[1]


@pytest.mark.parametrize("ending", ["png", "svg", "pdf"])
@pytest.mark.parametrize("more", [[], ["--transparent"], ["--theme", "dark", "--show", "energy"]])
def test_still(program, ending, more):
    arguments = ["--at", "turn", "--size", "320x180", *more]
    program("still", "-o", f"cli.{ending}", *arguments)
    call(["still", "-o", f"python.{ending}", *arguments])
    expected = bytes_of(f"cli.{ending}")
    assert bytes_of(f"python.{ending}") == expected
    keys = {"view_size": "320x180"}
    if "--transparent" in more:
        keys["view_background"] = "transparent"
    if "--theme" in more:
        keys.update(view_theme="dark", show_overlays="energy")
    memory = io.BytesIO()
    Scene(**keys).still(memory, "turn", format=ending)
    assert memory.getvalue() == expected


def _decoded(data):
    """A PNG file of 8 bits without interlacing as an array."""
    import struct
    import zlib

    width, height, _, colour = struct.unpack(">IIBB", data[16:26])
    channels = {2: 3, 6: 4}[colour]
    rows, at = b"", 8
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at : at + 8])
        if kind == b"IDAT":
            rows += data[at + 8 : at + 8 + length]
        at += 12 + length
    lines = np.frombuffer(zlib.decompress(rows), np.uint8).reshape(height, 1 + width * channels)
    assert set(lines[:, 0]) <= {0, 2}, "filters None and Up"
    picture = np.zeros((height, width * channels), np.uint8)
    for y, line in enumerate(lines):
        picture[y] = line[1:] + (picture[y - 1] if y > 0 and line[0] == 2 else 0)
    return picture.reshape(height, width, channels)


@pytest.mark.parametrize("background", ["opaque", "transparent"])
def test_frame_is_the_picture_of_still(program, background):
    program("still", "--at", "3.5", "--size", "320x180", f"--{background}", "-o", "a.png")
    frame = Scene(view_size="320x180", view_background=background).frame(3.5)
    assert np.array_equal(frame, _decoded(bytes_of("a.png")))


def test_frames_are_those_of_the_film(program):
    program("render", "--digits", "2", *FILM, "-o", "%06d.png")
    frames = Scene(2, view_size="128x72", view_fps=10, time_to=4).frames()
    assert len(frames) == 40
    for number, frame in enumerate(frames, 1):
        assert np.array_equal(frame, _decoded(bytes_of(f"{number:06}.png")))
    assert np.array_equal(_decoded(frames.png(-1)), _decoded(bytes_of("000040.png")))


@pytest.mark.parametrize("more", [[], ["--digits", "20", "--base", "7"], ["--mass-ratio", "1/3"]])
def test_count(program, more):
    count = call(["count", *more])
    base = 7 if "--base" in more else 10
    assert int(program("count", *more), base) == count


def test_count_of_any_size(program):
    text = program("count", "--digits", "5000").decode().strip()
    digits = Scene(digits=5000).count
    assert digits // 10**4990 == int(text[:10]) and digits % 10**10 == int(text[-10:])


@pytest.mark.parametrize(
    "more",
    [
        [],
        ["--digits", "5", "--first", "100", "--limit", "1000"],
        ["--from", "3.4", "--to", "turn"],
        ["--from", "#10", "--engine", "events"],
        ["--digits", "2", "--from", "last", "--engine", "events"],
        ["--mass-ratio", "1", "--from", "100"],
    ],
)
def test_log(program, more):
    program("log", *more, "--format", "npy", "-o", "a.npy")
    expected = np.load("a.npy")
    rows = call(["log", *more])
    # A str compares with Python's strings, and the file has bytes.
    expected = expected.astype(
        [(name, "U6" if name == "kind" else expected.dtype[name]) for name in expected.dtype.names])
    assert rows.dtype == expected.dtype
    assert np.array_equal(rows, expected)


def test_log_beyond_64_bits(program):
    arguments = ["--digits", "20", "--first", "15707963267948966190", "--limit", "5"]
    text = program("log", *arguments).decode().splitlines()[1:]
    rows = call(["log", *arguments])
    assert [str(row["index"]) for row in rows] == [line.split(",")[0] for line in text]
    assert [float(row["time"]) for row in rows] == [float(line.split(",")[1]) for line in text]


@pytest.mark.parametrize("bounds", [False, True])
def test_state(program, bounds):
    times = "0,0.1,3.5,turn-0.3,last,#157,last+1/3"
    more = ["--bounds"] if bounds else []
    lines = program("state", "--digits", "4", "--at", times, *more)
    for line, t in zip(lines.splitlines(), times.split(",")):
        expected = json.loads(line)
        state = Scene(4).state(t, bounds=bounds)
        assert state.time == expected["time"] and state.count == int(expected["collisions"])
        for block in ("blue", "red"):
            assert getattr(state, f"x_{block}") == expected[block]["position"]
            assert getattr(state, f"v_{block}") == expected[block]["velocity"]
            bound = getattr(state, f"x_{block}_bound")
            assert bound == expected[block].get("position_bound")


def test_references_of_one_are_the_others(program):
    with open("turn.toml", "w") as file:
        file.write('view.size = "128x72"\ntime.to = 4\nview.fps = 5\nred.mass = 16\n')
    scene = Scene(view_size="128x72", time_to=4, view_fps=5, red_mass=16)
    program("golden", "record", "turn.toml", "--dir", "cli", "--frames", "0,turn,#3")
    assert scene.golden_check("turn", "cli", frames=[0, "turn", "#3"])
    assert scene.golden_record("turn", "python", frames="0,turn,#3")
    said = program("golden", "check", "turn.toml", "--dir", "python", "--frames", "0,turn,#3")
    assert said == b"turn: equal\n"
    other = scene.replace(red_mass=Fraction(17))
    result = other.golden_check("turn", "cli", frames="0,turn,#3", diff="diff")
    with open("turn.toml", "w") as file:
        file.write('view.size = "128x72"\ntime.to = 4\nview.fps = 5\nred.mass = 17\n')
    said = program("golden", "check", "turn.toml", "--dir", "cli", "--frames", "0,turn,#3",
                   "--diff", "diff", check=False)
    assert said.returncode == 1 and said.stdout.decode().splitlines() == list(result.lines)
    assert other.golden_approve("turn", "cli", frames="0,turn,#3")


def test_join(program):
    scene = Scene(2, view_size="128x72", view_fps=10)
    parts = [scene.render("a.mp4", part=(n, 3)) for n in (1, 2, 3)]
    assert piblocks.join([part.path for part in parts], "a.mp4") == len(scene.frames())
    scene.render("whole.mp4")
    assert bytes_of("a.mp4") == bytes_of("whole.mp4")


def test_sheet(program):
    program("sheet", "--digits", "1", "-o", "cli.pdf", "--at", "0,#1,last", *SMALL)
    Scene(1, view_size="128x72").sheet("python.pdf", at=[0, "#1", "last"])
    assert bytes_of("cli.pdf") == bytes_of("python.pdf")
