"""The exceptions of the package, in the words of Python: keywords, and subclasses of OSError."""

from __future__ import annotations

import errno
import os
import re
from typing import Any

from . import _piblocks

# Options of the command line that messages name: those that have the same name here, and others.
_OPTIONS = {
    name: name.replace("-", "_")
    for name in (
        "at base bounds bundle by captions count-antialiasing crf diff digits dir encoder engine first "
        "frames hard-delta ignore-transparent jobs last limit mass-ratio max-delta max-flashes "
        "max-pixels max-window part plays poster preset restitution smallest "
        "start-number threshold"
    ).split()
} | {
    "allow-uncertain": "time_allow_uncertain=True",
    "accent": "view_colors_accent",
    "background": "view_background",
    "blue-color": "blue_color",
    "caption": "show_caption",
    "duration": "time_duration",
    "ease": "time_ease",
    "for": "for_",
    "fps": "view_fps",
    "freeze": "time_freeze",
    "from": "time_from",
    "hold-end": "time_hold_end",
    "hold-start": "time_hold_start",
    "ink": "view_colors_ink",
    "logo": "show_logo",
    "loop": "time_loop=True",
    "loupe": "show_loupe",
    "mask": "masks",
    "no-hits": "show_hits=False",
    "no-sound": "sound_on=False",
    "opaque": "view_background='opaque'",
    "output": "file",
    "overwrite": "overwrite=True",
    "panels": "show_panels",
    "resume": "resume=True",
    "red-color": "red_color",
    "show": "show_overlays",
    "shutter": "view_shutter",
    "size": "view_size",
    "slow-motion": "time_slow_motion",
    "sound": "sound_on=True",
    "speed": "time_speed",
    "theme": "view_theme",
    "title": "show_title",
    "to": "time_to",
    "transparent": "view_background='transparent'",
    "width-by-mass": "red_width='by-mass'",
}
_OF_LOG = {"from": "from_", "to": "to"}
_OPTION = re.compile(r"(?<![\w'-])--([a-z]+(?:-[a-z]+)*)(?![\w-])")
#: Keywords of the keys that are no keywords themselves: "view.size", "mass-ratio".
_KEYWORDS = {
    key: re.sub("[.-]", "_", key) for key in _piblocks.key_names() if re.search("[.-]", key)
}
_KEY = re.compile(r"(?<![\w'.-])(" + "|".join(map(re.escape, _KEYWORDS)) + r")(?![\w'.-])")
#: A line of a scene file. Lines of "part" are the dicts that Python was given.
_IN_FILE = re.compile(r"(?!part:)[^:]*:\d+: ")


def _as_keywords(message: str) -> str:
    """The message with keywords instead of options and of keys, unless it is about a file."""
    message = re.sub(r"count those until (?:an earlier|a) time, as --to ([\d.e+-]+)",
                     r"state(\1).count counts those until then", message)
    is_of_log = message.startswith(("log:", "--from", "--to", "--first"))
    options = {**_OPTIONS, **_OF_LOG} if is_of_log else _OPTIONS
    message = _OPTION.sub(lambda match: options.get(match[1], match[0]), message)
    if _IN_FILE.match(message):
        return message
    message = _KEY.sub(lambda match: _KEYWORDS[match[1]], message)
    # "view_fps: view_fps = 0": who set it, and what was set.
    return re.sub(r"^(\w+): (?=\1\b)", "", message)


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

    def __reduce__(self) -> tuple[Any, ...]:
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


#: A message of the library about one file, of which the operating system is the cause.
_CAUSE = re.compile(r"[^']*'(?P<name>[^']*)': (?P<reason>[^:']+)")
_NUMBERS = {os.strerror(number): number for number in errno.errorcode}


_CLASSES: dict[tuple[type[Error], type[OSError]], type[Error]] = {}


def _both(kind: type[Error], system: type[OSError]) -> type[Error]:
    """The class that is both of these."""
    if (kind, system) in _CLASSES:
        return _CLASSES[kind, system]

    class OfSystem(kind, system):  # type: ignore
        def __str__(self) -> str:
            return str(self.args[0])

        def __reduce__(self) -> tuple[Any, ...]:
            return of_system, (kind, str(self), self.errno, self.filename)

    OfSystem.__name__ = OfSystem.__qualname__ = kind.__name__
    OfSystem.__module__ = kind.__module__
    OfSystem.__doc__ = kind.__doc__
    _CLASSES[kind, system] = OfSystem
    return OfSystem


def of_system(kind: type[Error], problem: str, number: int, filename: Any) -> Error:
    """An exception of this class that is also FileNotFoundError or the like."""
    error: Any = _both(kind, type(OSError(number, "")))(problem)
    error.errno, error.strerror, error.filename = number, os.strerror(number), filename
    return error


def made(kind: type[Error], *problems: str) -> Error:
    """An exception of this class; that of of_system() if its one problem comes from the system."""
    found = _CAUSE.fullmatch(problems[0]) if len(problems) == 1 else None
    number = _NUMBERS.get(found["reason"]) if found else None
    if found is None or number is None:
        return kind(*problems)
    return of_system(kind, problems[0], number, found["name"])
