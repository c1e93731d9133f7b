"""Golden references of a scene."""

from __future__ import annotations

from typing import Any

from . import _piblocks
from ._errors import UsageError
from ._values import bytes_of, instant, path


def _name(name: Any) -> bytes:
    if not isinstance(name, str):
        raise TypeError(f"name: must be a str, not {type(name).__name__}")
    if "/" in name:
        raise UsageError(f"name: {name!r} has a slash; the folder is dir")
    return path("name", name)


def _frames(frames: Any) -> bytes | None:
    if frames is None:
        return None
    if isinstance(frames, str):
        return bytes_of(frames)
    return b",".join(instant("frames", one) for one in frames)


def act(
    script: _piblocks.Script, action: str, name: Any, folder: Any, frames: Any, diff: Any
) -> tuple[bool, list[str]]:
    return _piblocks.golden(
        script,
        action,
        _name(name),
        path("dir", folder),
        _frames(frames),
        None if diff is None else path("diff", diff),
    )


def report(script: _piblocks.Script, name: Any, folder: Any, frames: Any, page: Any) -> bool:
    """Writes a page that lays expected and actual pictures over each other."""
    return _piblocks.golden_report(
        script, _name(name), path("dir", folder), _frames(frames), path("page", page)
    )
