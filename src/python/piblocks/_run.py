"""Numbers of a run: its log and its states, as NumPy arrays."""

from __future__ import annotations

import ast
import functools
import math
from dataclasses import dataclass
from typing import Any, Optional, Union

import numpy as np

from . import _piblocks
from ._errors import UsageError
from ._values import instant, options, scalar

_CHUNK = 65_536  # rows whose words become str at a time


@dataclass(frozen=True)
class State:
    """The blocks at one instant. Positions are those of centres, in the scene's units."""

    time: float
    #: Index of the last collision until then; collisions from time 0 on are 1, 2, 3, ...
    #: ``math.inf`` where infinitely many have happened.
    count: Union[int, float]
    x_blue: float
    x_red: float
    v_blue: float
    v_red: float
    #: How far the position may be from the truth; None unless bounds were asked for.
    x_blue_bound: Optional[float] = None
    x_red_bound: Optional[float] = None


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
    #: How far each position may be from the truth, of each body; None unless bounds were asked for.
    position_bounds: Optional[np.ndarray] = None


def run_of(
    script: _piblocks.Script, operation: str, engine: str, to: Any = None
) -> _piblocks.Run:
    given = {} if engine == "unfolded" else {b"--engine": scalar("engine", engine)}
    if to is not None:
        given[b"--to"] = instant("to", to)
    return _piblocks.Run(script, operation, given)


@functools.lru_cache
def _dtype(row_type: str) -> np.dtype:
    return np.dtype(ast.literal_eval(row_type))


def _replace_column(rows: np.ndarray, name: str, values: list[Any]) -> np.ndarray:
    """The rows with a column of Python's integers."""
    names = rows.dtype.names or ()
    result = np.empty(rows.shape, [(n, object if n == name else rows.dtype[n]) for n in names])
    for other in names:
        if other != name:
            result[other] = rows[other]
    result[name] = values
    return result


def log(
    run: _piblocks.Run, from_: Any, to: Any, first: Any, last: Any, limit: Any
) -> np.ndarray:
    if last is not None and (isinstance(last, bool) or not isinstance(last, (int, np.integer))):
        raise TypeError(f"last: must be an int, not {type(last).__name__}")
    given = options({"--first": first, "--last": last, "--limit": limit})
    for name, value in (("from", from_), ("to", to)):
        if value is not None:
            given[b"--" + name.encode()] = instant(name, value)
    begin, count = (int(number, 16) for number in run.select(given))
    row = _dtype(run.row_type)
    # Words become str, which compare with Python's strings.
    shown = [(n, f"U{row[n].itemsize}" if row[n].kind == "S" else row[n]) for n in row.names or ()]
    try:
        rows = np.empty(count, shown)
    except (MemoryError, ValueError):  # numpy has a limit of its own
        raise UsageError(
            f"log: {count} collisions do not fit into memory; ask for fewer by limit, first or last"
        ) from None
    for start in range(0, count, _CHUNK):
        part = np.empty(min(_CHUNK, count - start), row)
        run.fill_log(format(begin + start, "x"), part.view(np.uint8), len(part))
        rows[start : start + len(part)] = part
    if -(2**63) < begin and begin + count < 2**63:
        return rows
    return _replace_column(rows, "index", [begin + i for i in range(count)])


def _whole(text: str) -> Union[int, float]:
    return math.inf if text == "infinite" else int(text, 16)


def _fill(run: _piblocks.Run, times: Any, bounds: bool, shape: tuple[int, ...]) -> np.ndarray:
    rows = np.empty(len(times), _dtype(run.state_type(bounds)))
    counts = run.fill_states(times, bounds, rows.view(np.uint8))
    if counts:
        whole = [_whole(text) if text else int(row) for text, row in zip(counts, rows["count"])]
        rows = _replace_column(rows, "count", whole)
    return rows.reshape(shape)


def _own(value: Any) -> Any:
    """An array of its own, or a number of Python."""
    if isinstance(value, np.ndarray):
        return value.copy()
    return value.item() if isinstance(value, np.generic) else value


def _states(run: _piblocks.Run, times: Any, bounds: bool, shape: tuple[int, ...]) -> Any:
    """The states of an array of times, or the one of the shape ()."""
    rows = _fill(run, times, bounds, shape)
    names = rows.dtype.names or ()
    is_pair = "x_blue" in names
    if is_pair and shape:
        return rows
    values = [_own(rows[name][()]) for name in names]
    return State(*values) if is_pair else BodiesState(*values)


def state(run: _piblocks.Run, t: Any, bounds: bool) -> Any:
    if isinstance(t, np.ndarray) and t.ndim == 0:
        t = t[()]
    if isinstance(t, (list, tuple)):
        array = np.empty(len(t), object)
        array[:] = t
        t = array
    if not isinstance(t, np.ndarray):
        return _states(run, [instant("t", t)], bounds, ())
    if t.dtype == np.float64 or np.issubdtype(t.dtype, np.integer) and t.dtype.itemsize <= 4:
        return _states(run, np.ascontiguousarray(t, np.float64).ravel(), bounds, t.shape)
    return _states(run, [instant("t", one) for one in t.ravel()], bounds, t.shape)
