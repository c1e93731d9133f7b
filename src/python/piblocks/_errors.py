"""The exceptions of the package, in the words of the command line."""

from __future__ import annotations

import re

# Options of the command line that messages name, and what they are called here.
_KEYWORDS = {
    "allow-uncertain": "time_allow_uncertain=True",
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
    "fps": "view_fps",
    "frames": "frames",
    "freeze": "time_freeze",
    "from": "time_from",
    "hold-end": "time_hold_end",
    "hold-start": "time_hold_start",
    "jobs": "jobs",
    "limit": "limit",
    "max-flashes": "max_flashes",
    "no-sound": "sound_on=False",
    "opaque": "view_background='opaque'",
    "overwrite": "overwrite=True",
    "panels": "show_panels",
    "part": "part",
    "poster": "poster",
    "preset": "preset",
    "show": "show_overlays",
    "shutter": "view_shutter",
    "size": "view_size",
    "slow-motion": "time_slow_motion",
    "smallest": "smallest",
    "sound": "sound_on=True",
    "speed": "time_speed",
    "to": "time_to",
}
_OF_LOG = {"from": "from_", "to": "to"}
_OPTION = re.compile(r"(?<![\w'-])--([a-z]+(?:-[a-z]+)*)(?![\w-])")


def _as_keywords(message: str) -> str:
    is_of_log = message.startswith(("log:", "--from", "--to", "--first"))
    keywords = {**_KEYWORDS, **_OF_LOG} if is_of_log else _KEYWORDS
    return _OPTION.sub(lambda match: keywords.get(match[1], match[0]), message)


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
