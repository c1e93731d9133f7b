"""Frames as arrays: who owns the pixels, and how long they stay."""

import collections.abc
import gc
import weakref

import numpy as np
import pytest
from conftest import in_threads, resident_bytes

import piblocks
from piblocks import Scene

SCENE = Scene(2, view_size="128x72", view_fps=10)


def address(frame):
    return frame.__array_interface__["data"][0]


def test_a_frame_is_rgb_without_a_copy():
    frame = SCENE.frame(1)
    assert frame.shape == (72, 128, 3) and frame.dtype == np.uint8
    assert not frame.flags.writeable and frame.strides[1:] == (4, -1)
    assert tuple(frame[0, 0]) == (251, 250, 247)  # of the theme lecture-light
    picture = SCENE.frame(0)
    red, blue = picture[..., 0].astype(int), picture[..., 2].astype(int)
    assert np.argwhere(red > blue + 90)[:, 1].mean() > np.argwhere(blue > red + 90)[:, 1].mean()
    with pytest.raises(ValueError):
        frame[0, 0] = 0
    with pytest.raises(ValueError):
        frame.flags.writeable = True


@pytest.mark.parametrize("background", ["opaque", "transparent"])
def test_rgba_is_a_contiguous_copy(background):
    scene = SCENE.replace(view_background=background)
    for frame in (scene.frame(1, rgba=True), scene.frames(rgba=True)[10], [*scene.frames(rgba=True)][10],
                  scene.frames(rgba=True)[5:][5]):
        assert frame.shape == (72, 128, 4) and frame.dtype == np.uint8
        assert frame.flags.c_contiguous and frame.flags.writeable and frame.flags.owndata
        assert (frame[..., :3] == scene.frame(1)[..., :3]).all()
        assert set(np.unique(frame[..., 3])) >= ({255} if background == "opaque" else {0, 255})
    with pytest.raises(TypeError, match="^rgba: must be True or False"):
        scene.frame(1, rgba=1)


def test_a_transparent_frame_has_straight_alpha():
    frame = SCENE.replace(view_background="transparent").frame(1)
    assert frame.shape == (72, 128, 4) and frame.flags.writeable
    assert set(np.unique(frame[..., 3])) >= {0, 255}
    assert frame[frame[..., 3] == 0].sum() == 0


def test_frames_are_a_sequence():
    frames = SCENE.frames()
    count = len(frames)
    everything = [frame.copy() for frame in frames]
    assert len(everything) == count > 50
    assert (frames[-1] == everything[-1]).all() and (frames[-count] == everything[0]).all()
    assert (frames[np.int64(3)] == everything[3]).all()
    part = frames[10:20:3]
    assert len(part) == 4 and (part[-1] == everything[19]).all() and len(part[5:]) == 0
    assert all((a == b).all() for a, b in zip(reversed(frames), everything[::-1]))
    assert np.array(frames[:3]).shape == (3, 72, 128, 3)
    for wrong in (count, -count - 1, 10**30):
        with pytest.raises(IndexError, match=f"use 0 to {count - 1}"):
            frames[wrong]
    with pytest.raises(IndexError):
        part.png(4)
    with pytest.raises(IndexError, match="there are no frames"):
        frames[:0][0]
    assert isinstance(frames, collections.abc.Sequence)
    assert everything[5] in frames and everything[5][:5] not in frames and "x" not in frames
    assert frames.index(everything[5]) == 5 and frames.count(everything[5]) == 1
    with pytest.raises(ValueError):
        frames.index(everything[5], 6)
    assert frames.fps == 10 and frames.time(30) == 3.0 and "10 frames/s" in repr(frames)


def test_a_frame_that_is_held_keeps_its_pixels():
    frames = SCENE.frames()
    copies = [frame.copy() for frame in frames]
    held = list(frames)
    random = np.random.default_rng(1)
    for number in random.integers(0, len(frames), 300):
        assert (frames[number] == copies[number]).all()
    assert all((a == b).all() for a, b in zip(held, copies))
    assert len({address(frame) for frame in held}) == len(held)


def test_memory_is_painted_again_when_nobody_holds_it():
    frames = SCENE.frames()
    addresses = {address(frame) for frame in frames}
    assert len(addresses) <= 2
    view = frames[0][10:20]  # any view keeps the memory
    before = view.copy()
    for _ in frames:
        pass
    assert (view == before).all()


def test_a_frame_outlives_its_scene():
    scene = Scene(2, view_size="128x72")
    frames = scene.frames()
    frame, expected = frames[5], frames[5].copy()
    iterator = iter(frames)
    gone = weakref.ref(scene)
    del scene, frames
    gc.collect()
    assert gone() is None and (frame == expected).all()
    assert (next(iterator) != frame).any() or True
    del iterator
    gc.collect()
    assert (frame == expected).all()


def test_memory_does_not_grow_with_frames():
    scene = Scene(3, view_size="1280x720")
    frames = scene.frames()
    for frame in frames[:50]:
        pass
    before = resident_bytes()
    for number in range(1000):
        frame = frames[number % len(frames)]
        if number % 10 == 0:
            still = scene.frame(number / 100)
    del frame, still
    assert resident_bytes() - before < 24e6, "a frame takes 3.7 MB"


def test_threads_may_share_frames():
    frames = SCENE.frames()
    expected = [frame.copy() for frame in frames]
    wrong = []

    def look(seed):
        for number in np.random.default_rng(seed).integers(0, len(frames), 200):
            if not (frames[number] == expected[number]).all():
                wrong.append(number)

    in_threads(look, range(4))
    assert wrong == []


def test_frames_of_a_storyboard():
    story = Scene.shipped("storyboard", view_size="320x180")
    frames = story.frames()
    assert frames[0].shape == (180, 320, 3)
    assert (story.frame("last") == frames[-1]).all() and (story.frame(0) == frames[0]).all()
    with pytest.raises(piblocks.UsageError, match="is a storyboard"):
        frames.time(0)


def test_what_cannot_be_drawn_says_why():
    with pytest.raises(piblocks.UsageError, match="too small|too narrow|needs|fit"):
        Scene(view_size="40x20", show_panels="velocity,unfolded,time").frame(1)
    with pytest.raises(piblocks.UsageError):
        Scene(time_from="#999").frames()
