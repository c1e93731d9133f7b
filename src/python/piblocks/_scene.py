"""A scene: what is simulated and shown, and all that can be asked of it."""

from __future__ import annotations

import os
from fractions import Fraction
from typing import Any, Union

import numpy as np

from . import _golden, _notebook, _piblocks, _render, _run
from ._errors import SceneError, UsageError, of_system
from ._film import Frames, pixels
from ._golden import GoldenResult
from ._keys import (
    KeyTexts,
    Table,
    fit_into_one_call,
    key_texts,
    parts_of,
    parts_shown,
    parts_text,
)
from ._render import Progress, Rendered
from ._run import BodiesState, State
from ._values import bytes_of, flag, instant, path, require_str, scalar, shown

Path = Union[str, "os.PathLike[str]"]


def scenes() -> dict[str, str]:
    """The names of the shipped scenes, and what each shows."""
    return dict(_piblocks.scenes())


#: What a scene is made of beside its keywords: the text of a file, or parts.
Source = Union[bytes, list[Table], None]


def _merged(before: tuple[KeyTexts, ...], more: list[KeyTexts]) -> tuple[KeyTexts, ...]:
    new = {key for _, key, _ in more}
    return (*(one for one in before if one[1] not in new), *more)


def _given(keys: list[KeyTexts]) -> tuple[KeyTexts, ...]:
    """The keys without those that are None, which keep what they have."""
    return tuple(one for one in keys if one[2] is not None)


class Scene:
    """Two blocks and a wall, what a film shows of them, and how. Immutable.

    Every keyword is a key of a scene file with its dots and hyphens as underscores, and a dict
    stands for the keys that begin with its name: ``view_size="1280x720"`` and
    ``view={"size": (1280, 720)}`` are the key ``view.size``. ``keys()`` lists them all. The
    keyword ``part`` takes a list of dicts and makes a storyboard.

    Values are numbers, strings as in a scene file, bools, or lists of these. Numbers are exact: an
    int, a ``Fraction`` and a ``Decimal`` stand for themselves, and a float for the decimal that
    Python prints, so that 0.1 is one tenth. None leaves a key as it is; in ``replace`` it stands
    for the default.

    :param digits: how many digits of pi the collisions count; red is 100**(digits - 1) times as
        heavy as blue. Without keywords it is the article's scene: three digits.
    :raises SceneError: with everything that is wrong.
    :raises TypeError: for a value that is of none of these types; it names the keyword.

    >>> Scene(digits=3).count
    314
    """

    __slots__ = ("_script", "_recipe", "_runs", "_pictures", "__weakref__")

    def __init__(self, digits: Any = None, **keys: Any) -> None:
        if digits is not None:
            keys = {"digits": digits, **keys}
        parts = keys.pop("part", None)
        source = None if parts is None else parts_of(parts)
        self._make(b"part", source, False, _given(key_texts(keys)))

    def _make(
        self, origin: bytes, source: Source, is_file: bool, keys: tuple[KeyTexts, ...]
    ) -> None:
        text = parts_text(source) if isinstance(source, list) else source
        self._script = _piblocks.Script(origin, text, is_file, list(keys))
        self._recipe = (origin, source, is_file, keys)
        self._runs: dict[str, _piblocks.Run] = {}
        self._pictures: _piblocks.Pictures | None = None

    @classmethod
    def _restore(
        cls, origin: bytes, source: Source, is_file: bool, keys: tuple[KeyTexts, ...]
    ) -> Scene:
        scene = cls.__new__(cls)
        scene._make(origin, source, is_file, keys)
        return scene

    @classmethod
    def from_toml(cls, file: Path, **keys: Any) -> Scene:
        """Reads a scene file or a storyboard. Keywords win over the file, as options do.

        :raises SceneError: if it is wrong, with the number of each line; or if it cannot be read:
            then the error is a FileNotFoundError, PermissionError, ... too.
        """
        name = path("file", file)
        try:
            with open(name, "rb") as opened:
                text = opened.read((1 << 20) + 1)
        except OSError as error:
            number = error.errno or 0
            problem = f"scene: cannot read '{os.fsdecode(name)}': {os.strerror(number)}"
            raise of_system(SceneError, problem, number, file) from error
        if len(text) > 1 << 20:
            raise SceneError(
                f"scene: '{os.fsdecode(name)}' is longer than {1 << 20} bytes, the most that a scene "
                "file may have; leave out bodies, parts or comments"
            )
        return cls._restore(name, text, True, _given(key_texts(keys)))

    @classmethod
    def from_toml_text(cls, text: str, origin: str = "scene", **keys: Any) -> Scene:
        """The same with the text of a scene file.

        :param origin: stands for the file's name in messages.
        """
        require_str("text", text)
        return cls._restore(
            scalar("origin", origin), bytes_of(text), False, _given(key_texts(keys))
        )

    @classmethod
    def shipped(cls, name: str, **keys: Any) -> Scene:
        """A scene that comes with the package; ``scenes()`` lists them.

        :raises UsageError: if there is none of this name; it names the nearest one.
        """
        require_str("name", name)
        text = _piblocks.scene_text(bytes_of(name)).encode()
        return cls._restore(f"{name} (shipped)".encode(), text, False, _given(key_texts(keys)))

    def replace(self, **keys: Any) -> Scene:
        """The same scene with other values for these keys; None stands for the default, also where
        a scene file says something else."""
        origin, source, is_file, before = self._recipe
        if "part" in keys:
            if isinstance(source, bytes):
                raise SceneError(
                    "part: these parts are those of a scene file; make a Scene(part=...)"
                )
            parts = keys.pop("part")
            source = None if parts is None else parts_of(parts)
        merged = _merged(before, key_texts(keys))
        has_file = isinstance(source, bytes)
        return self._restore(origin, source, is_file, merged if has_file else _given(list(merged)))

    # What it is

    @property
    def size(self) -> tuple[int, int]:
        """Width and height of a frame, in pixels."""
        return self._script.size

    @property
    def fps(self) -> Fraction:
        """Frames per second of video."""
        return Fraction(*self._script.rate)

    @property
    def is_storyboard(self) -> bool:
        """Whether it has parts: then it has frames, but no count, log or states."""
        return self._script.is_storyboard

    @property
    def is_transparent(self) -> bool:
        return self._script.is_transparent

    @property
    def notes(self) -> tuple[str, ...]:
        """What you should know of the scene, in rare cases: that the count follows a convention, that
        bodies meet at once, that collisions are infinitely many, or that a color is hard to see.

        For a scene of bodies, this computes the run until its end, and raises as ``count`` does.
        """
        return tuple(self._script.notes)

    def to_toml(self) -> str:
        """The text of a scene file that reads back as an equal scene.

        Keys at their defaults are left out. The path of a logo becomes absolute.
        """
        return self._script.to_toml().decode("utf-8", "surrogateescape")

    def _description(self) -> tuple[tuple[bytes, bytes], ...]:
        return tuple(self._script.describe())

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Scene):
            return NotImplemented
        return self._description() == other._description()

    def __hash__(self) -> int:
        return hash(self._description())

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self)._restore, self._recipe

    def __copy__(self) -> Scene:
        return self

    def __deepcopy__(self, memo: Any) -> Scene:
        return self

    def __repr__(self) -> str:
        first, *more = _links(self._recipe[3])
        name, arguments = self._origin()
        calls = [f"Scene{name}({', '.join([*arguments, *map(_argument, first)])})"]
        calls += [f"replace({', '.join(map(_argument, link))})" for link in more]
        return ".".join(calls)

    def _origin(self) -> tuple[str, list[str]]:
        """The constructor, and its arguments before the keywords."""
        origin, source, is_file, _ = self._recipe
        name = os.fsdecode(origin)
        shipped = name.removesuffix(" (shipped)")
        if source is None:
            return "", []
        if isinstance(source, list):
            return "", [f"part={parts_shown(source)!r}"]
        if is_file:
            return ".from_toml", [repr(name)]
        if shipped != name and _is_shipped(shipped, source):
            return ".shipped", [repr(shipped)]
        return ".from_toml_text", [repr(source.decode("utf-8", "surrogateescape")), repr(name)]

    # Numbers

    @property
    def count(self) -> int:
        """How often the blocks and the wall collide, from the beginning of time to its end.

        :raises UsageError: for a storyboard; if they are infinitely many, or may never end.
        """
        return int(self._script.count(), 16)

    def _run(self, operation: str, engine: str) -> _piblocks.Run:
        require_str("engine", engine)
        if engine not in self._runs:
            self._runs[engine] = _run.run_of(self._script, operation, engine)
        return self._runs[engine]

    def log(
        self,
        *,
        from_: Any = None,
        to: Any = None,
        first: int | None = None,
        last: int | None = None,
        limit: int | None = None,
        engine: str = "unfolded",
    ) -> np.ndarray:
        """Every collision as a row of a structured array.

        The columns are those of ``piblocks log --format npy``: index, time, time_low (what a
        double leaves out of the time), kind (b"wall" or b"blocks"), x_blue, x_red, v_blue, v_red
        just after the collision. ``index`` is int64; if one does not fit, it is an object column of
        Python's ints.

        Of a scene with bodies: index, time, time_low, first, second (bodies from 1 on in the order
        of the scene; walls are -1, -2, ...), x_first, x_second, v_first, v_second, which have two
        coordinates in a plane.

        :param from_: leave out collisions before this instant. :param to: and after this one.
        :param first: start with this collision (default 1). :param last: end with this one.
        :param limit: at most so many rows; more than 100,000,000 need it.
        :param engine: "unfolded", the closed form; "events", the event loop in doubles.
        :raises UsageError: if there are no such collisions, or too many; for a storyboard.
        """
        run = self._run("log", engine)
        if to is not None and run.never_ends:  # it may have to go further than the film
            run = _run.run_of(self._script, "log", engine, to)
        return _run.log(run, from_, to, first, last, limit)

    def state(
        self, t: Any, *, bounds: bool = False, engine: str = "unfolded"
    ) -> Union[State, BodiesState, np.ndarray]:
        """Positions, velocities and the count at an instant, or at each of an array of them.

        Of a scene with bodies it is a ``BodiesState``: positions and velocities of all bodies.

        :param t: a number, or "turn-0.3", "last+1", "#314": a ``State``, whose count has any size.
            An array or a list of these: a structured array of its shape with the same fields. Its
            ``count`` is int64; if one does not fit, it is an object column of Python's ints. Where
            infinitely many collisions have happened, the count is ``math.inf``.
        :param bounds: also how far each position may be from the truth. Known of two blocks beside
            something immovable.
        :raises UsageError: if the scene has no such instant; for a storyboard.
        """
        return _run.state(self._run("state", engine), t, flag("bounds", bounds))

    # Pictures

    def _all_pictures(self) -> _piblocks.Pictures:
        if self._pictures is None:
            self._pictures = _piblocks.Pictures(self._script)
        return self._pictures

    def frame(self, t: Any = "last", *, rgba: bool = False) -> np.ndarray:
        """The picture at an instant: uint8, height x width x 3, red, green, blue.

        It is a read-only view of the renderer's memory, not contiguous, and keeps its pixels. With
        a transparent background it is as with ``rgba``.

        :param t: an instant, as for ``state``; of a storyboard, a second of its video.
        :param rgba: height x width x 4, with straight alpha: a contiguous copy of your own.
        """
        picture = self._all_pictures().still(instant("t", t))
        return pixels(picture, flag("rgba", rgba))

    def frames(self, *, rgba: bool = False) -> Frames:
        """The frames of the film, as a sequence of arrays like those of ``frame``."""
        return Frames(self._all_pictures(), self.fps, flag("rgba", rgba))

    def still(self, file: Any, at: Any = "last", *, format: str | None = None) -> None:
        """Writes the picture at an instant.

        :param file: a name that ends with .png, .svg or .pdf; or a file that is open for bytes.
        :param format: for an open file: "png" (default), "svg" or "pdf".
        """
        _render.still(self._script, file, at, format)

    def sheet(self, file: Path, *, frames: int | None = None, by: str | None = None,
              at: Any = None) -> None:
        """Writes several instants on one page, for paper: .pdf, .png or .svg.

        :param frames: so many instants, spread over the run (default 12).
        :param by: spread them evenly by "count" or by "time". :param at: or these instants.
        """
        _render.sheet(self._script, file, frames, by, at)

    # Films

    def render(
        self,
        file: Path,
        *,
        progress: Union[Progress, bool, None] = None,
        jobs: int | None = None,
        for_: str | None = None,
        crf: Any = None,
        preset: str | None = None,
        encoder: str | None = None,
        start_number: int | None = None,
        plays: int | None = None,
        smallest: bool = False,
        captions: str | None = None,
        frames: Any = None,
        part: Any = None,
        bundle: Path | None = None,
        poster: Any = None,
        max_flashes: int | None = None,
        profile: bool = False,
        overwrite: bool = False,
        resume: bool = False,
    ) -> Rendered:
        """Renders the film. The file appears when it is complete, or not at all.

        The bytes are those of ``piblocks render`` with the same options. Other threads run
        meanwhile, and Ctrl-C stops it.

        :param file: its ending selects the format: .mp4, .mov, .webm, .gif, .apng, .webp, .y4m,
            .wav, .html (a page to step through), .pdf (a page for each frame), .framehash, or
            pictures as "frames/%06d.png" or .svg.
        :param progress: True for a line on standard error; or called with the frames done and the
            frames in all. An exception in it stops the rendering, and is raised.
        :param jobs: threads (default: one a processor); changes no byte.
        :param start_number: of the first numbered picture (default: 1).
        :param plays: how often a GIF, APNG or WebP plays (default: for ever).
        :param captions: "inside" gives an MP4 a track of captions.
        :param for_: size, rate and background that suit "powerpoint", "web", ...
        :param frames: (120, 180) renders these frames alone, the first being 0. Numbered pictures
            get the numbers that they have in the whole film, and the others stay.
        :param part: (2, 3) renders the second of three shares, for ``join``.
        :param bundle: a folder for the video, a poster, captions, and slides; of a storyboard
            also a video for each part.
        :param overwrite: lets pictures of a sequence, and files of a bundle or part, replace files
            that no earlier run has made.
        :param resume: keeps the numbered pictures that an interrupted run of the same scene and
            options has left, and leaves those of this one if it is interrupted;
            with ``part``, keeps the part if it has been made already.
        :raises UsageError: DrawError, MediaError, IoError, SimulationError, KeyboardInterrupt
        """
        given = {
            "--jobs": jobs,
            "--for": for_,
            "--crf": crf,
            "--preset": preset,
            "--encoder": encoder,
            "--start-number": start_number,
            "--plays": plays,
            "--smallest": smallest,
            "--captions": captions,
            "--max-flashes": max_flashes,
            "--profile": profile,
            "--overwrite": overwrite,
            "--resume": resume,
        }
        return _render.render(self._script, file, progress, bundle, poster, frames, part, given)

    def animate(self) -> Any:
        """A slider over the exact frames in a notebook: a widget of ipywidgets 7 or later.

        Without it, a ``Player`` that says what is missing.
        """
        return _notebook.slider(self)

    def player(self) -> _notebook.Player:
        """The film in a player, for a notebook, also if it is large.

        :raises UsageError: if it has more than 64 MB.
        """
        return _notebook.player(self)

    def _repr_html_(self) -> str:
        return _notebook.scene_html(self)

    # Golden references

    def golden_record(self, name: str, dir: Path, *, frames: Any = None) -> GoldenResult:
        """Writes the references that are missing: a hash of every frame, and some pictures.

        It replaces none. If existing references differ from what is drawn now, it writes nothing,
        and the result is false.

        :param name: the beginning of the files' names. :param frames: instants kept as pictures.
        """
        return _golden.act(self._script, "record", name, dir, frames, None)

    def golden_approve(self, name: str, dir: Path, *, frames: Any = None) -> GoldenResult:
        """Replaces references; the result tells what changes."""
        return _golden.act(self._script, "approve", name, dir, frames, None)

    def golden_check(
        self, name: str, dir: Path, *, frames: Any = None, diff: Path | None = None
    ) -> GoldenResult:
        """Compares with references. The result is true if all is equal: ``assert
        scene.golden_check("turn", "golden")``.

        :param diff: a folder; pictures of what differs go to its subfolder ``name``.
        """
        return _golden.act(self._script, "check", name, dir, frames, diff)



def _links(keys: tuple[KeyTexts, ...]) -> list[list[KeyTexts]]:
    """The keywords of a constructor, and those of each replace() after it."""
    links: list[list[KeyTexts]] = [[]]
    for one in keys:
        is_reset = one[2] is None
        if (is_reset and len(links) == 1) or not fit_into_one_call([*links[-1], one]):
            links.append([])
        links[-1].append(one)
    return links


def _argument(one: KeyTexts) -> str:
    keyword, _, texts = one
    if texts is None:
        return f"{keyword.decode()}=None"
    values = [shown(text) for text in texts]
    return f"{keyword.decode()}={values[0] if len(values) == 1 else values!r}"


def _is_shipped(name: str, text: bytes) -> bool:
    try:
        return _piblocks.scene_text(bytes_of(name)).encode() == text
    except UsageError:
        return False
