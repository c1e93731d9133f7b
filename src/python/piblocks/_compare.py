"""Comparison of pictures, as 'piblocks compare' makes it."""

from __future__ import annotations

import os
from collections.abc import Iterable
from dataclasses import dataclass
from html import escape
from numbers import Integral
from typing import Any, Union

import numpy as np

from . import _piblocks
from ._errors import Error, UsageError
from ._golden import GoldenResult
from ._notebook import pictures_html
from ._picture import is_picture, mask_picture, picture
from ._values import bytes_of, flag, options, path, scalar, texts


@dataclass(frozen=True, repr=False, eq=False)
class Comparison(GoldenResult):
    """What a comparison has found. It is true if all is accepted, so that a test may say
    ``assert piblocks.compare("expected.png", picture)``; ``str()`` says in one line what differs,
    and a notebook shows the pictures.

    ``outcome`` is "equal", "accepted" (differs within the tolerance, or only inside a mask),
    "different", "not comparable" (of another size, or shown another way) or, of folders and
    videos, also "new", "missing" or "unreadable". Numbers are None where nothing was compared, and
    of several frames, whose numbers the ``rows`` have.
    """

    #: For people: the name of the file, or "the picture".
    name: str = ""
    #: Pixels in which any sample differs.
    different_pixels: int | None = None
    #: Of these, pixels that differ by more than the tolerance's ``max_delta`` or ``threshold``.
    off_pixels: int | None = None
    #: Pixels that differ inside a mask; the other numbers omit them.
    masked_pixels: int | None = None
    #: The largest difference of a sample, in levels of the samples.
    largest_delta: int | None = None
    #: The largest level of a sample, such as 255: ``max_delta=255`` is so many levels.
    max_level: int | None = None
    #: The first sample that differs, row by row: x, y in pixels, and the channel, from 0.
    first: tuple[int, int, int] | None = None
    #: Where a window of ``max_window``, or of 16 x 16 pixels, has the most pixels that are off:
    #: x, y, width, height in pixels.
    densest: tuple[int, int, int, int] | None = None
    #: Pixels that are off there.
    densest_off: int | None = None
    _rows: tuple[Comparison, ...] = ()
    _made: Any = None

    @property
    def rows(self) -> tuple[Comparison, ...]:
        """A comparison for each frame, without pictures; of two pictures, this one alone."""
        return self._rows or (self,)

    def _pair(self) -> _piblocks.Comparison:
        if self._made is None:
            raise UsageError(
                "compare: a row and a copy have no pictures; compare two pictures to see them")
        return self._made

    def __getstate__(self) -> dict[str, Any]:
        """For pickle and copy: all but the pictures."""
        return {**self.__dict__, "_made": None}

    def png(self, kind: str = "diff") -> bytes:
        """A picture of two that were compared, as a PNG file.

        :param kind: "expected", "actual" or "diff": the expected picture in pale grey, with red
            where pixels differ, stronger where they differ more.
        :raises UsageError: if several frames were compared, or two pictures could not be.
        """
        pictures = self._pair().pictures()
        if kind in pictures:
            return pictures[kind]
        if kind not in ("expected", "actual", "diff"):
            raise UsageError(f"kind: there is no picture {kind!r}; use expected, actual or diff")
        raise UsageError(f"compare: there is no picture {kind!r}: {self}")

    def deltas(self) -> np.ndarray[Any, Any]:
        """The largest delta of each pixel: a uint8 array of height x width. 255 is the full range
        of a sample at any depth; 0 means that the pixel is equal or inside a mask.

        :raises UsageError: as ``png()``.
        """
        width, deltas = self._pair().deltas()
        return np.frombuffer(deltas, np.uint8).reshape(-1, width)

    def save(self, file: Union[str, os.PathLike[str]]) -> None:
        """Writes the picture of the difference, ``png("diff")``, to a file.

        :raises UsageError: as ``png()``; or if the file cannot be made, or was compared.
        :raises IoError: if it cannot be written.
        """
        self._pair().save(path("file", file))

    def report(self, file: Union[str, os.PathLike[str]]) -> None:
        """Writes an HTML page that lays the pictures over each other. Folders and videos are
        compared again.

        :raises UsageError, IoError: as ``save()``.
        """
        self._pair().report(path("file", file))

    def _repr_html_(self) -> str:
        try:
            pictures = self._pair().pictures()
        except Error:  # of several frames; or a file is gone
            return f"<pre>{escape(str(self))}</pre>"
        kinds = {"expected": "expected", "diff": "difference", "actual": "actual"}
        return pictures_html(str(self), {
            caption: pictures[kind] for kind, caption in kinds.items() if kind in pictures})


def _masks(given: Any) -> list[Union[bytes, _piblocks.Picture]]:
    if given is None:
        return []
    has_items = isinstance(given, (tuple, list)) and len(given) > 0
    is_rectangle = has_items and all(isinstance(one, Integral) for one in given)
    if is_rectangle or is_picture(given):
        given = [given]
    if not isinstance(given, Iterable):
        raise TypeError(f"masks: must be a list of masks, not {type(given).__name__}")
    return [_mask(f"masks[{i}]", one) for i, one in enumerate(given)]


def _mask(name: str, given: Any) -> Union[bytes, _piblocks.Picture]:
    if isinstance(given, str):
        return bytes_of(given)
    if not isinstance(given, (tuple, list)):
        return mask_picture(name, given)
    if len(given) != 4:
        raise UsageError(f"{name}: {given!r} must be x, y, width, height")
    x, y, width, height = texts(name, given)
    return b"%sx%s+%s+%s" % (width, height, x, y)


def _window(given: Any) -> bytes | None:
    if isinstance(given, (tuple, list)):
        return b":".join(texts("max_window", given))
    return None if given is None else scalar("max_window", given)


#: The arguments of compare() that say what is accepted.
TOLERANCE = ("max_delta", "threshold", "count_antialiasing", "ignore_transparent", "max_pixels",
             "hard_delta", "max_window", "masks")
_FLAGS = ("count_antialiasing", "ignore_transparent")


def compare_pictures(
    reference: _piblocks.Picture, actual: _piblocks.Picture, **tolerance: Any
) -> Comparison:
    """compare() of pictures that the extension has."""
    for name in tolerance:
        if name not in TOLERANCE:
            raise TypeError(f"compare: there is no argument '{name}'; use {', '.join(TOLERANCE)}")
    masks = _masks(tolerance.pop("masks", None))
    window = _window(tolerance.pop("max_window", None))
    for name in _FLAGS:
        tolerance[name] = flag(name, tolerance.get(name, False))
    given = options({f"--{name.replace('_', '-')}": one for name, one in tolerance.items()})
    if window is not None:
        given[b"--max-window"] = window
    made = _piblocks.compare(reference, actual, given, masks)
    rows = made.rows
    if made.is_pair:
        return Comparison(**rows[0], _made=made)
    return Comparison(made.ok, made.outcome, tuple(made.lines), _made=made,
                      _rows=tuple(Comparison(**row) for row in rows))


def compare(
    reference: Any,
    actual: Any,
    *,
    max_delta: Any = None,
    threshold: Any = None,
    count_antialiasing: bool = False,
    ignore_transparent: bool = False,
    max_pixels: Any = None,
    hard_delta: Any = None,
    max_window: Any = None,
    masks: Any = None,
) -> Comparison:
    """Compares pictures. Every sample must be equal unless a tolerance is given; of several
    tolerances, all must hold.

    Each side is an array of uint8 or uint16 (height x width for greys, height x width x 3, or x 4
    with straight alpha), an image of Pillow, a figure of matplotlib, the bytes of a PNG file, or a
    path. If both are paths, they may also be folders, numbered patterns or videos, as for
    ``piblocks compare``.

    :param max_delta: accepts samples that differ by up to so much, 0 to 255; 255 is the full range
        of a sample at any depth.
    :param threshold: accepts instead what looks alike, 0 to 1, and pixels of smoothed edges, as
        pixelmatch does with 0.1.
    :param count_antialiasing: with ``threshold``, does not accept smoothed edges.
    :param ignore_transparent: accepts any colour of pixels that are fully transparent.
    :param max_pixels: accepts up to so many pixels that differ by more, or "0.1%" of all.
    :param hard_delta: accepts no sample that differs by more.
    :param max_window: (16, 40) or "16:40" accepts up to 40 such pixels in any square of 16 x 16.
    :param masks: parts that are not compared, a list: (x, y, width, height) in pixels, texts of the
        command line such as "640x80+100+20", or pictures of the same size, of which what is
        neither black nor transparent is left out (arrays also of bool).
    :returns: a false result also if the sizes differ.
    :raises UsageError: if a tolerance, a mask or an array makes no sense. :raises IoError: if a
        picture cannot be read. :raises TypeError: for any other value.
    """
    return compare_pictures(
        picture("reference", reference), picture("actual", actual), max_delta=max_delta,
        threshold=threshold, count_antialiasing=count_antialiasing,
        ignore_transparent=ignore_transparent, max_pixels=max_pixels, hard_delta=hard_delta,
        max_window=max_window, masks=masks)
