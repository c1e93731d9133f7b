"""The exceptions of the package, in the words of the command line."""

from __future__ import annotations

import re

# Options of the command line that are keywords here. A message names them as the user wrote them.
_KEYWORDS = {
    "at": "at",
    "bounds": "bounds",
    "bundle": "bundle",
    "by": "by",
    "crf": "crf",
    "diff": "diff",
    "dir": "dir",
    "encoder": "encoder",
    "engine": "engine",
    "first": "first",
    "for": "for_",
    "frames": "frames",
    "from": "from_",
    "jobs": "jobs",
    "limit": "limit",
    "max-flashes": "max_flashes",
    "part": "part",
    "poster": "poster",
    "preset": "preset",
    "smallest": "smallest",
    "to": "to",
    "opaque": "view_background='opaque'",
    "transparent": "view_background='transparent'",
    "no-sound": "sound_on=False",
}
_OPTION = re.compile(r"(?<![\w'-])--([a-z]+(?:-[a-z]+)*)(?![\w-])")


def _as_keywords(message: str) -> str:
    return _OPTION.sub(lambda match: _KEYWORDS.get(match[1], match[0]), message)


class Error(Exception):
    """Base of every exception that the package raises on purpose."""


class UsageError(Error, ValueError):
    """What was asked for cannot be done as asked. Nothing has been written.

    ``problems`` has everything that is wrong, a line each.
    """

    problems: tuple[str, ...]

    def __init__(self, *problems: str) -> None:
        self.problems = tuple(_as_keywords(problem) for problem in problems)
        super().__init__("\n".join(self.problems))

    def __reduce__(self) -> tuple[type, tuple[str, ...]]:
        return type(self), self.problems


class SceneError(UsageError):
    """A scene is invalid: a key, a value, or several that contradict each other."""


class SimulationError(Error):
    """The physics has no answer: a number left the range of a double, for example."""


class DrawError(Error):
    """Painting failed."""


class MediaError(Error):
    """Encoding or reading a video failed."""


class IoError(Error, OSError):
    """Reading or writing a file failed after it had been opened."""
