"""Scenes with bodies: what the package does with them, and what it refuses in the program's words."""

import json
from fractions import Fraction

import numpy as np
import pytest
from conftest import TREE, bytes_of

import piblocks
from piblocks import Scene
from piblocks._errors import _as_keywords

BLOCKS = """
[box]
x = [0, 10]
[[body]]
position = 1
velocity = 1
[[body]]
mass = 2
position = 3
[[body]]
mass = 3
position = 5
[time]
to = 4
[view]
size = [128, 72]
fps = 5
"""
PAIR = """
[[body]]
mass = "inf"
position = -1
[[body]]
position = 2
[[body]]
mass = 100
position = 5
velocity = -1
"""
LONGER = BLOCKS.replace("to = 4", "to = 40")
# Double precision knows for a while only which of them collide next.
UNCERTAIN = (TREE / "tests/support/uncertain_discs.toml").read_text()


def scene_of(text, **keys):
    with open("scene.toml", "w") as file:
        file.write(text)
    return Scene.from_toml("scene.toml", **keys)


def said_by(program, *arguments):
    """What the program says in its refusal."""
    result = program(*arguments, check=False)
    assert result.returncode == 2
    return result.stderr.decode().strip().removeprefix("piblocks: ")


def assert_refused(ask, words):
    with pytest.raises(piblocks.UsageError) as raised:
        ask()
    assert str(raised.value) == _as_keywords(words)


def test_counts_are_those_of_the_program(program):
    for to in (1, 4, 40):
        scene = scene_of(BLOCKS, time_to=to)
        assert scene.count == int(program("count", "scene.toml", "--to", str(to)))
    for name in ("three-blocks", "billiard", "wedge", "touch", "superball"):
        text = program("scenes", name).decode()
        assert scene_of(text).count == int(program("count", name)), name


def test_counts_and_indices_of_any_size():
    scene = scene_of(
        "[[body]]\nmass = 'inf'\nposition = -1\n[[body]]\nposition = 2\n"
        "[[body]]\nmass = '1e58'\nposition = 5\nvelocity = -1\n"
    )
    assert scene.count == 314159265358979323846264338327
    assert scene.state(10).count == scene.count
    assert scene.state([0, 10]).count.tolist() == [0, scene.count]
    assert scene.state(np.array([[0, 10]])).count.tolist() == [[0, scene.count]]
    rows = scene.log(first=10**28, limit=2)
    assert rows["index"].tolist() == [10**28, 10**28 + 1]
    assert scene.log(limit=1)["index"].dtype == np.int64


def test_a_count_without_an_end_is_refused(program):
    scene = scene_of(BLOCKS.replace("to = 4", ""))
    assert_refused(lambda: scene.count, said_by(program, "count", "scene.toml"))


def npy_of(program, *arguments):
    program("log", *arguments, "--format", "npy", "-o", "log.npy")
    return np.load("log.npy")


#: On a line, in a plane, in closed form, without an end.
SCENES = ["three-blocks", "row", "superball", "touch", "wedge", "billiard", "two-walls"]


@pytest.mark.parametrize("name", SCENES)
def test_a_log_has_the_bytes_of_the_program(program, name):
    rows = Scene.shipped(name).log()
    expected = npy_of(program, name)
    assert rows.dtype == expected.dtype and rows.tobytes() == expected.tobytes()
    assert len(rows) == Scene.shipped(name).count > 0
    csv = [line.split(",") for line in program("log", name).decode().splitlines()]
    flat = [rows[column].reshape(len(rows), -1) for column in rows.dtype.names
            if column not in ("index", "time_low", "first", "second", "time")]
    numbers = np.hstack([rows["time"][:, None], *flat])
    assert numbers.tolist() == [[float(x) for x in [line[1], *line[4:]]] for line in csv[1:]]


@pytest.mark.parametrize(
    "keys",
    [
        {"from_": 1}, {"to": 3}, {"from_": "#3", "to": "#5"}, {"first": 3}, {"limit": 2},
        {"first": 2, "limit": 3, "to": 10}, {"to": 40}, {"from_": 3.9, "to": "last"},
    ],
)
def test_rows_of_a_log_are_those_of_the_program(program, keys):
    options = [x for key, value in keys.items() for x in (f"--{key.rstrip('_')}", str(value))]
    rows = scene_of(LONGER).log(**keys)
    assert rows.tobytes() == npy_of(program, "scene.toml", *options).tobytes()


def test_a_log_ends_where_it_is_asked_to():
    scene = scene_of(LONGER)
    whole = scene.log()
    assert scene.log(last=3).tobytes() == whole[:3].tobytes()
    assert scene.log(first=2, last=3, limit=9).tobytes() == whole[1:3].tobytes()
    assert len(scene.log(first=3, last=2)) == 0 and scene.log(limit=1).dtype == whole.dtype
    with pytest.raises(piblocks.UsageError, match="^last 99: the scene has collisions 1 to "):
        scene.log(last=99)
    assert len(scene.log(to=400)) > len(whole)  # the scene's own end is 40


@pytest.mark.parametrize("name", SCENES)
def test_states_have_the_numbers_of_the_program(program, name):
    times = ["0", "0.5", "#1", "last", "last-1/7", "2"]
    lines = program("state", name, "--at", ",".join(times)).decode().splitlines()
    told = [json.loads(line) for line in lines]
    scene = Scene.shipped(name)
    states = scene.state(times)
    bodies = len(told[0]["bodies"])
    dimensions = np.size(told[0]["bodies"][0]["position"])
    assert states.positions.shape == states.velocities.shape == (6, bodies, dimensions)
    assert states.time.tolist() == [one["time"] for one in told]
    assert states.count.tolist() == [int(one["collisions"]) for one in told]
    for vectors, what in ((states.positions, "position"), (states.velocities, "velocity")):
        expected = [[body[what] for body in one["bodies"]] for one in told]
        assert np.array_equal(vectors, np.reshape(expected, vectors.shape))
    one = scene.state("last")
    assert type(one.time) is float and type(one.count) is int
    assert np.array_equal(one.positions, states.positions[3])
    assert np.array_equal(one.velocities, states.velocities[3])


@pytest.mark.parametrize(
    "t, shape",
    [
        (np.linspace(0, 3, 7), (7,)), (np.ones((2, 3), np.float32), (2, 3)), ([], (0,)),
        (np.empty((0, 4)), (0, 4)), ([0, "last"], (2,)), (np.arange(3), (3,)), (2, ()),
        (np.array(1.5), ()), (np.float64(0.1), ()), (Fraction(1, 3), ()), ("turn-1", None),
    ],
)
def test_states_have_the_shape_of_the_times(t, shape):
    scene = scene_of(BLOCKS)
    if shape is None:
        with pytest.raises(piblocks.UsageError, match="there is no turn"):
            scene.state(t)
        return
    states = scene.state(t)
    assert np.shape(states.time) == np.shape(states.count) == shape
    assert states.positions.shape == states.velocities.shape == (*shape, 3, 1)
    if shape and np.size(states.time):
        alone = scene.state(np.asarray(t, object).ravel()[-1])
        assert np.array_equal(states.positions.reshape(-1, 3, 1)[-1], alone.positions)


def test_two_bodies_beside_a_third_have_bounds():
    scene = scene_of(PAIR)
    times = np.array([1.3, 3.7])
    states = scene.state(times, bounds=True)
    assert states.position_bounds.shape == (2, 3)
    assert (states.position_bounds[:, 1:] > 0).all() and (states.position_bounds < 1e-14).all()
    assert not states.position_bounds[:, 0].any()  # it does not move
    assert np.array_equal(scene.state(3.7, bounds=True).position_bounds, states.position_bounds[1])
    assert scene.state(times).position_bounds is None


def test_energy_is_kept():
    states = scene_of(BLOCKS).state(np.linspace(0, 4, 101))
    energy = (np.array([1, 2, 3]) * states.velocities[..., 0] ** 2).sum(axis=1)
    assert np.allclose(energy, 1, rtol=1e-14)
    assert (np.diff(states.positions[..., 0], axis=1) > 1 - 1e-14).all()


def test_refusals_of_logs_and_states(program):
    scene = scene_of(BLOCKS)
    with pytest.raises(piblocks.UsageError, match="^bounds: only known of two blocks"):
        scene.state(1, bounds=True)
    assert scene.state(1).count == 1  # as if nothing had been asked
    with pytest.raises(piblocks.UsageError):
        scene.state(-1)
    endless = scene_of(BLOCKS.replace("to = 4", ""))
    assert_refused(endless.log, said_by(program, "log", "scene.toml"))
    assert len(endless.log(to=4)) == scene.count
    uncertain = scene_of(UNCERTAIN)
    for ask in (uncertain.log, lambda: uncertain.state([1, 150])):
        with pytest.raises(piblocks.UsageError, match="is certain only until time .*time_allow_unc"):
            ask()
    assert uncertain.state([1, 2]).positions.shape == (2, 3, 2)
    assert len(uncertain.log(to=10)) > 5
    allowed = uncertain.replace(time_allow_uncertain=True)
    assert allowed.state(150).positions.shape == (3, 2) and len(allowed.log()) == allowed.count


def test_what_is_not_certain_is_refused_in_the_same_words(program):
    scene = scene_of(UNCERTAIN)
    words = said_by(program, "count", "scene.toml")
    assert "is certain only until time " in words and "--allow-uncertain" in words
    for ask in (lambda: scene.count, lambda: scene.frame(150), lambda: scene.render("a.mp4")):
        assert_refused(ask, words)
    assert "time_allow_uncertain=True" in _as_keywords(words)
    allowed = scene.replace(time_allow_uncertain=True)
    assert allowed.count == int(program("count", "scene.toml", "--allow-uncertain"))


def test_problems_are_those_of_the_program(program):
    text = BLOCKS + "\n[[body]]\nposition = 5.5\nmas = 3\n"
    with pytest.raises(piblocks.SceneError) as raised:
        scene_of(text)
    words = said_by(program, "count", "scene.toml").replace("\npiblocks: ", "\n")
    assert list(raised.value.problems) == words.split("\n") and len(raised.value.problems) == 2


def test_frames_are_those_of_the_program(program):
    scene = scene_of(BLOCKS)
    frames = scene.frames()
    assert len(frames) == 20
    first, last = frames[0].copy(), frames[-1].copy()
    assert first.shape == (72, 128, 3) and (first != last).any()
    program("still", "scene.toml", "--at", "2", "-o", "program.png")
    scene.still("package.png", 2)
    assert bytes_of("program.png") == bytes_of("package.png")
    assert (scene.frame(2) == frames[10]).all()  # at 5 frames a second
    assert (frames[0] == first).all()


def test_a_block_is_where_it_is():
    text = (
        '[[body]]\nposition = 2\nvelocity = 1\ncolor = "#ff0000"\n'
        '[view]\nx = [0, 16]\nsize = [160, 90]\ntheme = "lecture"\n[time]\nto = 10\n'
    )
    scene = scene_of(text)
    for time in (0, 3, 7.5):
        frame = scene.frame(time).astype(int)
        red = (frame[..., 0] > 240) & (frame[..., 1] < 20)
        assert abs(np.argwhere(red)[:, 1].mean() + 0.5 - 10 * (2 + time)) < 1


def test_videos_have_the_bytes_of_the_program(program):
    scene = scene_of(BLOCKS, sound_on=True)
    scene.render("package.mp4")
    program("render", "scene.toml", "--sound", "--quiet", "-o", "program.mp4")
    assert bytes_of("program.mp4") == bytes_of("package.mp4")


def test_pages_say_what_moves():
    scene_of(BLOCKS).render("page.html")
    assert b"without friction" in bytes_of("page.html")


def test_scenes_differ_by_their_bodies():
    assert scene_of(BLOCKS) == scene_of(BLOCKS)
    assert scene_of(BLOCKS) != scene_of(BLOCKS.replace("mass = 2", "mass = 2.5"))
