"""Scenes with bodies: what the package does with them, and what it refuses in the program's words."""

import numpy as np
import pytest
from conftest import TREE

import piblocks
from piblocks import Scene

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


def test_counts_are_those_of_the_program(program):
    for to in (1, 4, 40):
        scene = scene_of(BLOCKS, time_to=to)
        assert scene.count == int(program("count", "scene.toml", "--to", str(to)))
    for name in ("three-blocks", "recoil", "billiard", "wedge", "touch", "superball"):
        text = program("scenes", name).decode()
        assert scene_of(text).count == int(program("count", name)), name


def test_a_count_without_an_end_is_refused(program):
    scene = scene_of(BLOCKS.replace("to = 4", ""))
    with pytest.raises(piblocks.UsageError) as raised:
        scene.count
    assert str(raised.value) == said_by(program, "count", "scene.toml")


def test_logs_and_states_are_refused():
    scene = scene_of(BLOCKS)
    for ask in (scene.log, lambda: scene.state(1), lambda: scene.state([1, 2])):
        with pytest.raises(piblocks.UsageError) as raised:
            ask()
        assert str(raised.value) == (
            "log: is for two blocks and a wall, and this scene has [[body]]"
        )


def test_what_is_not_certain_is_refused_in_the_same_words(program):
    scene = scene_of(UNCERTAIN)
    words = said_by(program, "count", "scene.toml")
    assert "is certain until time " in words and "--allow-uncertain" in words
    for ask in (lambda: scene.count, lambda: scene.frame(150), lambda: scene.render("a.mp4")):
        with pytest.raises(piblocks.UsageError) as raised:
            ask()
        assert str(raised.value) == words.replace(
            "--allow-uncertain", "time_allow_uncertain=True"
        )
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
    with open("program.png", "rb") as one, open("package.png", "rb") as other:
        assert one.read() == other.read()
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
    with open("program.mp4", "rb") as one, open("package.mp4", "rb") as other:
        assert one.read() == other.read()


def test_pages_say_what_moves():
    scene_of(BLOCKS).render("page.html")
    with open("page.html", encoding="utf-8") as page:
        assert "without friction" in page.read()


def test_scenes_differ_by_their_bodies():
    assert scene_of(BLOCKS) == scene_of(BLOCKS)
    assert scene_of(BLOCKS) != scene_of(BLOCKS.replace("mass = 2", "mass = 2.5"))
