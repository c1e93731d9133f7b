"""Counts, logs and states: types, shapes, sizes."""

import math
import re
from dataclasses import astuple, fields
from decimal import Decimal
from fractions import Fraction

import numpy as np
import pytest
from conftest import in_threads

import piblocks
from piblocks import Scene, State

SCENE = Scene(3)
FIELDS = tuple(field.name for field in fields(State))


def test_counts_are_ints_of_any_size():
    assert [Scene(d).count for d in range(1, 8)] == [3, 31, 314, 3141, 31415, 314159, 3141592]
    assert Scene(20).count == 31415926535897932384
    assert Scene(digits=20, base=2).count == int("110010010000111111011", 2)


def test_a_log_fills_one_array():
    log = Scene(6).log()
    assert log.shape == (314159,) and log.dtype.itemsize == 80 and log.base is None
    assert (log["index"] == np.arange(1, 314160)).all()
    assert (np.diff(log["time"]) >= 0).all()
    assert set(log["kind"]) == {"wall", "blocks"} and log.dtype["kind"] == "U6"
    assert (log["kind"] == "wall").sum() == 157079 and (log[::2]["kind"] == "blocks").all()
    mass = 100**5
    energy = log["v_blue"] ** 2 + mass * log["v_red"] ** 2
    assert np.allclose(energy, mass, rtol=1e-12)


@pytest.mark.parametrize(
    "keys, first, last",
    [
        ({}, 1, 314), ({"first": 3, "last": 5}, 3, 5), ({"last": 5}, 1, 5),
        ({"first": 310, "limit": 100}, 310, 314), ({"first": 3, "last": 9, "limit": 2}, 3, 4),
        ({"first": 3, "last": 4, "limit": 9}, 3, 4), ({"from_": "#10", "to": "#12"}, 10, 12),
        ({"from_": 3.5, "last": 160}, 158, 160), ({"first": np.int64(3), "limit": 1}, 3, 3),
        ({"first": 9, "last": 3}, 9, 8), ({"from_": 100}, 1, 0),
    ],
)
def test_rows_of_a_log(keys, first, last):
    assert SCENE.log(**keys)["index"].tolist() == list(range(first, last + 1))


def test_rows_before_time_zero():
    scene = Scene(blue_velocity=-3)
    log = scene.log(first=0 if scene.count > 314 else 1, limit=1)
    assert len(log) == 1


@pytest.mark.parametrize("limit", [2**58, 2**62, 2**100])
def test_a_log_that_does_not_fit_into_memory_says_so(limit):
    with pytest.raises(piblocks.UsageError, match="log: [0-9]+ collisions do not fit into memory"):
        Scene(36).log(limit=limit)


def test_a_log_beyond_64_bits_has_ints():
    log = Scene(20).log(first=15707963267948966190, last=15707963267948966192)
    assert log["index"].tolist() == [15707963267948966190 + k for k in range(3)]
    assert log.dtype["index"] == object and log.dtype["time"] == float
    below = Scene(20).log(first=2**63 - 10, limit=5)
    assert below.dtype["index"] == np.int64 and below["index"][-1] == 2**63 - 6
    assert (below["time"] == Scene(20).log(first=2**63 - 10, limit=20)["time"][:5]).all()


@pytest.mark.parametrize("engine", ["unfolded", "events"])
def test_engines_agree(engine):
    log = SCENE.log(engine=engine)
    assert np.allclose(log["time"], SCENE.log()["time"], rtol=1e-9)
    assert SCENE.state("last", engine=engine).count == 314


@pytest.mark.parametrize(
    "t", [3.5, "3.5", Fraction(7, 2), Decimal("3.5"), np.float32(3.5), np.array(3.5), "7/2"]
)
def test_one_state(t):
    state = SCENE.state(t)
    assert isinstance(state, State) and type(state.count) is int and type(state.x_red) is float
    assert state == SCENE.state(3.5) and state.count == 157 and state.x_blue_bound is None


def test_a_float_is_the_decimal_that_is_printed():
    # A collision happens at exactly 2: at the double nearest to 2.3 + 0.3 the decimal decides.
    early = Scene(red_position="3.2", red_velocity=-0.1)  # they meet at t = 2
    assert early.state(2.0).count == 1 and early.state("2").count == 1
    assert early.state(np.nextafter(2, 0)).count == 0
    tenth = Scene(red_position="3.01", red_velocity=-0.1)  # at t = 1/10
    assert tenth.state(0.1).count == 1 == tenth.state(np.array([0.1]))["count"][0]
    assert tenth.state(np.float32(0.1)).count == 1
    assert tenth.state(np.array([0.1], np.float32))["count"][0] == 1


@pytest.mark.parametrize(
    "t, shape",
    [
        (np.linspace(0, 13, 101), (101,)), (np.ones((2, 3)), (2, 3)), ([], (0,)),
        (np.linspace(0, 13, 100)[::-2], (50,)), (np.arange(5), (5,)), ([0, "last", "#3"], (3,)),
        ((Fraction(1, 3), 2), (2,)), (np.array(["turn", "last"], object), (2,)),
        (np.array(["turn", "last"]), (2,)), (np.empty((0, 4)), (0, 4)),
        (np.arange(3, dtype=np.int64), (3,)), (np.asfortranarray(np.ones((2, 3))), (2, 3)),
        (np.ones(3, ">f8"), (3,)), (np.ones(3, np.float16), (3,)),
    ],
)
def test_states_have_the_shape_of_the_times(t, shape):
    states = SCENE.state(t)
    assert states.shape == shape and states.dtype.names == FIELDS[:6]
    each = t.ravel() if isinstance(t, np.ndarray) else t
    for state, one in zip(states.ravel(), each):
        expected = SCENE.state(one)
        assert tuple(state) == astuple(expected)[:6]


def test_counts_of_states_that_do_not_fit():
    scene = Scene(30)
    assert scene.state("last").count == scene.count > 2**63
    states = scene.state(["last", 0, "turn"])
    assert states.dtype["count"] == object
    assert states["count"].tolist()[:2] == [scene.count, 0]
    assert scene.state([0, 1]).dtype["count"] == np.int64


def test_restitution_is_a_keyword(program):
    for share in (0.999, Fraction(99, 100), "1"):
        scene = Scene(3, restitution=share)
        assert scene.count == int(program("count", "--digits", "3", "--restitution", str(share)))
        assert scene == Scene(3, blocks_restitution=share, wall_restitution=share)
        assert Scene.from_toml_text(scene.to_toml()) == scene
    with pytest.raises(piblocks.UsageError, match="restitution and wall_restitution both set"):
        Scene(restitution=0.5, wall_restitution=1)
    with pytest.raises(piblocks.SceneError, match="^restitution = 2: must be from 0"):
        Scene(restitution=2)


def test_infinitely_many_are_said_to_be(program):
    scene = Scene(2, restitution=0.5)
    with pytest.raises(piblocks.UsageError, match="infinitely many collisions until the blocks") as caught:
        scene.count
    advice = re.search(r"; (state\(\S+\)\.count) counts those until then$", str(caught.value))[1]
    assert eval("scene." + advice) > 5
    assert scene.state("last").count == math.inf == scene.state(9).count
    assert scene.state("#7").count == 7 and type(scene.state("#7").count) is int
    states = scene.state([0, "#7", 9])
    assert states["count"].tolist() == [0, 7, math.inf]
    assert scene.state([0, 3])["count"].dtype == np.int64
    listed = len(scene.log())
    (note,) = scene.notes
    assert "there are infinitely many collisions" in note and f"the first {listed}" in note
    assert note == program("log", "--digits", "2", "--restitution", "0.5", check=False).stderr \
        .decode().strip().removeprefix("piblocks: note: ")
    with pytest.raises(piblocks.UsageError, match="infinitely many collisions, of which the log lists 1 to"):
        scene.log(last=listed + 1)
    assert Scene(2).notes == Scene(1, restitution=0.5).notes == ()


def test_bounds():
    states = SCENE.state([1, 2], bounds=True)
    assert states.dtype.names == FIELDS and (states["x_red_bound"] < 1e-12).all()
    assert SCENE.state(1, bounds=True).x_blue_bound == states["x_blue_bound"][0]
    with pytest.raises(piblocks.UsageError, match="^bounds: only known of two blocks.* with engine unfolded"):
        SCENE.state(1, bounds=True, engine="events")


def test_threads_may_share_a_scene():
    scene = Scene(5)
    expected = scene.state(np.linspace(0, 12, 500))
    results = [None] * 8

    def ask(place):
        results[place] = Scene(5).state(np.linspace(0, 12, 500)), scene.log(limit=1000)

    in_threads(ask, range(8))
    for states, log in results:
        assert (states == expected).all() and len(log) == 1000
