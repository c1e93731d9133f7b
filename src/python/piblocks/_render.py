"""Files: films, stills, sheets."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from typing import Any, Union

from . import _piblocks
from ._notebook import Player, file_html, file_player
from ._values import flag, instant, options, path, require_str, texts

Progress = Callable[[int, int], object]


@dataclass(frozen=True)
class Rendered:
    """What a rendering wrote. In a notebook it shows the film, or the size of a large one."""

    path: str
    #: Frames that were rendered.
    frames: int
    #: What you should know of the file, a line each: players that may not show it, for example.
    notes: tuple[str, ...] = ()
    #: Seconds of processor time by step; empty unless a profile was asked for.
    profile: dict[str, float] = field(default_factory=dict)

    def _repr_html_(self) -> str | None:
        return file_html(self.path)

    def player(self) -> Player:
        """The film for a notebook, also if it is large.

        :raises UsageError: if a notebook cannot play the file. :raises OSError: if it is gone.
        """
        return file_player(self.path)


def _bar(name: str) -> Progress:
    """Progress on standard error, in one line that is written anew."""

    def show(done: int, total: int) -> None:
        end = "\n" if done == total else ""
        print(f"\r{name}: {done} of {total} frames", end=end, file=sys.stderr, flush=True)

    return show


def _progress(progress: Union[Progress, bool, None], name: str) -> Progress | None:
    if progress is None or progress is False:
        return None
    if progress is True:
        return _bar(name)
    if not callable(progress):
        raise TypeError(
            f"progress: must be callable, True or None, not {type(progress).__name__}"
        )
    return progress


def render(
    script: _piblocks.Script,
    output: Any,
    progress: Union[Progress, bool, None],
    bundle: Any,
    poster: Any,
    frames: Any,
    part: Any,
    given: dict[str, Any],
) -> Rendered:
    name = path("file", output)
    flags = {
        option: flag(option[2:], value)
        for option, value in given.items()
        if option in ("--smallest", "--profile", "--overwrite", "--resume")
    }
    texts_given = options({**given, **flags})
    if bundle is not None:
        texts_given[b"--bundle"] = path("bundle", bundle)
    if poster is not None:
        texts_given[b"--poster"] = instant("poster", poster)
    if frames is not None:
        texts_given[b"--frames"] = b"-".join(texts("frames", frames))
    if part is not None:
        texts_given[b"--part"] = b"/".join(texts("part", part))
    written, count, notes, profile = _piblocks.render(
        script, name, texts_given, _progress(progress, os.fsdecode(name))
    )
    return Rendered(os.fsdecode(written), count, tuple(notes), dict(profile))


def still(script: _piblocks.Script, output: Any, at: Any, format: Any) -> None:
    when = instant("at", at)
    if hasattr(output, "write"):
        form = "png" if format is None else format
        require_str("format", form)
        output.write(_piblocks.still_bytes(script, when, form))
        return
    if format is not None:
        raise TypeError("format: is for an open file; the ending of a name selects the format")
    _piblocks.still_file(script, when, path("file", output))


def sheet(script: _piblocks.Script, output: Any, frames: Any, by: Any, at: Any) -> None:
    given = options({"--frames": frames, "--by": by})
    if at is not None:
        instants = list(at) if isinstance(at, (list, tuple)) or hasattr(at, "__array__") else [at]
        given[b"--at"] = b",".join(instant("at", one) for one in instants)
    _piblocks.sheet_file(script, path("file", output), given)


def join(parts: Iterable[Union[str, os.PathLike[str]]], output: Union[str, os.PathLike[str]],
         *, overwrite: bool = False) -> int:
    """Joins the files of all parts of a rendering to the output that they were rendered for.

    :param parts: the files, in any order. :param overwrite: as ``Scene.render`` has it.
    :returns: the number of frames.
    :raises UsageError: if a part is missing, given twice, or of another rendering.
    """
    if isinstance(parts, (str, bytes, os.PathLike)) or not isinstance(parts, Iterable):
        raise TypeError(f"parts: must be a list of paths, not {type(parts).__name__}")
    return _piblocks.join([path("parts", part) for part in parts], path("output", output),
                          flag("overwrite", overwrite))
