"""Numbers of a run: its log and its states, as NumPy arrays."""

from __future__ import annotations

import ast
import math
from dataclasses import dataclass
from typing import Any, Optional, Union

import numpy as np

from . import _piblocks
from ._errors import UsageError
from ._values import instant, options, scalar

#: A row of a log, as ``piblocks log --format npy`` writes it.
_ROW = np.dtype(ast.literal_eval(_piblocks.ROW_TYPE))
#: The same with the kind of the collision as a str, which compares with Python's strings.
ROW = np.dtype([(n, "U6" if n == "kind" else _ROW[n]) for n in _ROW.names or ()])
_CHUNK = 65_536  # rows whose kind becomes a str at a time
_STATE = ast.literal_eval(_piblocks.STATE_TYPE)
_BOUNDS = ast.literal_eval(_piblocks.BOUND_TYPE)


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


def run_of(script: _piblocks.Script, engine: Any) -> _piblocks.Run:
    return _piblocks.Run(script, {b"--engine": scalar("engine", engine)})


def _with_objects(dtype: np.dtype, name: str) -> np.dtype:
    return np.dtype([(n, object if n == name else dtype[n]) for n in dtype.names or ()])


def _replace_column(rows: np.ndarray, name: str, values: list[Any]) -> np.ndarray:
    """The rows with a column of Python's integers."""
    result = np.empty(rows.shape, _with_objects(rows.dtype, name))
    for other in rows.dtype.names or ():
        if other != name:
            result[other] = rows[other]
    result[name] = values
    return result


def _index(name: str, value: Any) -> int:
    if isinstance(value, (bool, np.bool_)) or not isinstance(value, (int, np.integer)):
        raise TypeError(f"{name}: must be an int, not {type(value).__name__}")
    return int(value)


AnyRun = Union[_piblocks.Run, _piblocks.BodyRun]


def _limit_until(run: AnyRun, given: dict[bytes, bytes], last: int) -> int:
    """How many rows there are up to this index."""
    if not run.has(format(last, "x")):
        first_index, size = int(run.first_index, 16), int(run.size, 16)
        are = "collisions"
        if run.is_endless:
            are = "infinitely many collisions, of which the log lists"
        has = f"{are} {first_index:,} to {size:,}" if size >= first_index else "no collisions"
        raise UsageError(f"last {last:,}: the scene has {has}")
    first, _ = run.select({**given, b"--limit": b"1"})
    return last - int(first, 16) + 1


def options_of_log(from_: Any, to: Any, first: Any, limit: Any) -> dict[bytes, bytes]:
    given = options({"--first": first, "--limit": limit})
    for name, value in (("from", from_), ("to", to)):
        if value is not None:
            given[b"--" + name.encode()] = instant(name, value)
    return given


def selected(
    run: AnyRun, given: dict[bytes, bytes], last: Any, limit: Any
) -> tuple[int, int]:
    """The index of the first row, and how many there are."""
    if last is not None:
        rows_until = _limit_until(run, given, _index("last", last))
        if rows_until <= 0:
            return 1, 0
        if limit is None or _index("limit", limit) > rows_until:
            given = {**given, b"--limit": b"%d" % rows_until}
    begin, count = run.select(given)
    return int(begin, 16), int(count, 16)


def _fit(begin: int, count: int) -> bool:
    return -(2**63) < begin and begin + count < 2**63


def with_index(rows: np.ndarray, begin: int) -> np.ndarray:
    """The rows, with their indices as ints if these do not fit into int64."""
    if _fit(begin, len(rows)):
        return rows
    return _replace_column(rows, "index", [begin + i for i in range(len(rows))])


def log(
    run: _piblocks.Run, from_: Any, to: Any, first: Any, last: Any, limit: Any
) -> np.ndarray:
    begin, count = selected(run, options_of_log(from_, to, first, limit), last, limit)
    rows = np.empty(count, ROW)
    fits = _fit(begin, count)
    for start in range(0, count, _CHUNK):
        part = np.empty(min(_CHUNK, count - start), _ROW)
        run.fill_log(format(begin + start, "x"), part.view(np.uint8), len(part), fits)
        rows[start : start + len(part)] = part
    return with_index(rows, begin)


def _whole(text: str) -> Union[int, float]:
    return math.inf if text == "infinite" else int(text, 16)


def _fill(run: _piblocks.Run, times: Any, bounds: bool, shape: tuple[int, ...]) -> np.ndarray:
    rows = np.empty(len(times), np.dtype(_STATE + (_BOUNDS if bounds else [])))
    if isinstance(times, np.ndarray):
        counts = run.states_of_numbers(times, bounds, rows.view(np.uint8))
    else:
        counts = run.states_of_texts(times, bounds, rows.view(np.uint8))
    if counts:
        whole = [_whole(text) if text else int(row) for text, row in zip(counts, rows["count"])]
        rows = _replace_column(rows, "count", whole)
    return rows.reshape(shape)


def state(run: _piblocks.Run, t: Any, bounds: bool) -> Any:
    if isinstance(t, np.ndarray) and t.ndim == 0:
        t = t[()]
    if isinstance(t, (list, tuple)):
        array = np.empty(len(t), object)
        array[:] = t
        t = array
    if not isinstance(t, np.ndarray):
        row = _fill(run, [instant("t", t)], bounds, (1,))[0]
        return State(*(value.item() if hasattr(value, "item") else value for value in row))
    if t.dtype == np.float64 or np.issubdtype(t.dtype, np.integer) and t.dtype.itemsize <= 4:
        return _fill(run, np.ascontiguousarray(t, np.float64).ravel(), bounds, t.shape)
    return _fill(run, [instant("t", one) for one in t.ravel()], bounds, t.shape)
