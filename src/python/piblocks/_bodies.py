"""Numbers of a run of bodies: its log and its states, as NumPy arrays."""

from __future__ import annotations

import ast
from dataclasses import dataclass
from typing import Any

import numpy as np

from . import _piblocks
from ._run import options_of_log, selected, with_index
from ._values import instant, scalar


@dataclass(frozen=True, eq=False)
class BodiesState:
    """All bodies at one instant, or at each of an array of them.

    Bodies are in the order of the scene. The last axis of positions and velocities has one
    coordinate on a line, and two, x and y, in a plane.
    """

    #: A float; an array of the shape of the times if these were one.
    time: Any
    #: Index of the last collision until then: an int, or an array like ``time``, of int64, or of
    #: ints if these do not fit.
    count: Any
    #: Of the centres, in the scene's units: (bodies, dimensions), after the shape of the times.
    positions: np.ndarray
    #: As ``positions``; just after a collision that happens at that time.
    velocities: np.ndarray


def run_of(
    script: _piblocks.Script, engine: str, given: dict[bytes, bytes], for_states: bool
) -> _piblocks.BodyRun:
    if engine != "unfolded":
        given = {**given, b"--engine": scalar("engine", engine)}
    return _piblocks.BodyRun(script, given, for_states)


def log(
    script: _piblocks.Script, engine: str, from_: Any, to: Any, first: Any, last: Any, limit: Any
) -> np.ndarray:
    given = options_of_log(from_, to, first, limit)
    run = run_of(script, engine, given, False)
    begin, count = selected(run, given, last, limit)
    rows = np.empty(count, np.dtype(ast.literal_eval(run.row_type)))
    if count > 0:
        memory = rows.view(np.uint8)
        run.fill_log(format(begin, "x"), memory, count, rows.dtype.itemsize)
    return with_index(rows, begin)


def state(run: _piblocks.BodyRun, t: Any) -> BodiesState:
    if isinstance(t, (list, tuple)):
        times = np.empty(len(t), object)
        times[:] = t
    else:
        times = np.asarray(t)
    texts = [instant("t", one) for one in times.ravel()] if times.ndim else [instant("t", t)]
    time = np.empty(times.shape)
    count = np.empty(times.shape, np.int64)
    positions = np.empty((*times.shape, *run.shape))
    velocities = np.empty_like(positions)
    long_counts = run.fill_states(texts, time, count, positions, velocities)
    if long_counts:
        pairs = zip(long_counts, count.ravel().tolist())
        whole = [int(text, 16) if text else fitting for text, fitting in pairs]
        count = np.array(whole, object).reshape(times.shape)
    if times.ndim:
        return BodiesState(time, count, positions, velocities)
    return BodiesState(time.item(), count.item(), positions, velocities)
