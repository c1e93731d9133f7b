"""Golden references of a scene."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from . import _piblocks
from ._errors import UsageError
from ._values import bytes_of, instant, path, require_str


@dataclass(frozen=True)
class GoldenResult:
    """What a golden command has found or done. It is true on success, so that a test may say
    ``assert scene.golden_check(...)``; ``str()`` says what was found."""

    ok: bool
    #: Of a check: "equal", "different", "incomplete" if some references are missing, "unreadable",
    #: "no references". Of record: "recorded", "kept" if all were there, "not recorded". Of
    #: approve: "recorded", "replaced", "equal".
    outcome: str
    #: What the command line prints.
    lines: tuple[str, ...]

    def __bool__(self) -> bool:
        return self.ok

    def __str__(self) -> str:
        return "\n".join(self.lines)

    def __repr__(self) -> str:
        return f"<{type(self).__name__} {self.outcome}: {'; '.join(self.lines)}>"


def _name(name: Any) -> bytes:
    require_str("name", name)
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
) -> GoldenResult:
    ok, outcome, lines = _piblocks.golden(
        script, action, _name(name), path("dir", folder), _frames(frames),
        None if diff is None else path("diff", diff))
    return GoldenResult(ok, outcome, tuple(lines))


def files(script: _piblocks.Script, name: Any, folder: Any, frames: Any) -> list[str]:
    """The paths of the references."""
    return _piblocks.golden_files(script, _name(name), path("dir", folder), _frames(frames))


def report(script: _piblocks.Script, name: Any, folder: Any, frames: Any, page: Any) -> bool:
    """Writes a page that lays expected and actual pictures over each other."""
    return _piblocks.golden_report(
        script, _name(name), path("dir", folder), _frames(frames), path("page", page)
    )
