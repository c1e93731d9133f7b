"""The frames of a film as NumPy arrays."""

from __future__ import annotations

import operator
from collections.abc import Iterator, Sequence
from fractions import Fraction
from typing import Any, Union, overload

import numpy as np

from . import _piblocks


def pixels(frame: _piblocks.Frame, rgba: bool) -> np.ndarray:
    """A view of R, G, B; or, if it is asked for or needed, a copy with straight alpha."""
    bgra = np.asarray(frame)
    if not rgba and not frame.has_alpha:
        return bgra[..., 2::-1]
    copy = np.empty(bgra.shape, np.uint8)
    frame.copy_rgba(copy)
    return copy


class Frames(Sequence):
    """The frames of a film, a sequence of arrays (``collections.abc.Sequence``).

    A frame is a read-only uint8 array of height x width x 3: red, green, blue. It shows the
    renderer's own memory, and is therefore not contiguous: its strides are (4 * width or more, 4,
    -1). As long as you hold a frame its pixels stay; once nobody holds it, its memory is painted
    again. With a transparent background, and with ``rgba=True``, it is a copy of your own:
    contiguous, writable, height x width x 4, with straight alpha. A slice is a sequence of the same
    kind, and paints nothing.
    """

    def __init__(
        self,
        pictures: _piblocks.Pictures,
        fps: Fraction,
        rgba: bool,
        numbers: range | None = None,
    ) -> None:
        self._pictures = pictures
        self._numbers = range(pictures.frame_count) if numbers is None else numbers
        self._rgba = rgba
        #: Frames per second of the whole film.
        self.fps = fps

    def __len__(self) -> int:
        return len(self._numbers)

    @overload
    def __getitem__(self, index: int) -> np.ndarray: ...

    @overload
    def __getitem__(self, index: slice) -> Frames: ...

    def __getitem__(self, index: Union[int, slice]) -> Union[np.ndarray, Frames]:
        if isinstance(index, slice):
            return Frames(self._pictures, self.fps, self._rgba, self._numbers[index])
        return pixels(self._frame(index), self._rgba)

    def __iter__(self) -> Iterator[np.ndarray]:
        for number in self._numbers:
            yield pixels(self._pictures.frame(number), self._rgba)

    def __reversed__(self) -> Iterator[np.ndarray]:
        return iter(self[::-1])

    def __contains__(self, picture: Any) -> bool:
        """Whether a frame has exactly these pixels."""
        return any(np.array_equal(frame, picture) for frame in self)

    def index(self, picture: Any, start: int = 0, stop: int | None = None) -> int:
        """The first frame from ``start`` on that has exactly these pixels. Raises ValueError."""
        for number in range(*slice(start, stop).indices(len(self))):
            if np.array_equal(self[number], picture):
                return number
        raise ValueError("frames: no frame has these pixels")

    def count(self, picture: Any) -> int:
        """How many frames have exactly these pixels."""
        return sum(np.array_equal(frame, picture) for frame in self)

    def __repr__(self) -> str:
        return f"<{len(self)} frames at {self.fps} frames/s>"

    def png(self, index: int) -> bytes:
        """A frame as a PNG file. Raises IndexError."""
        return self._frame(index).png()

    def time(self, index: int) -> float:
        """The simulation time that a frame of a single scene shows.

        Raises IndexError; UsageError for a storyboard.
        """
        return self._pictures.time(self._number(index))

    def _number(self, index: int) -> int:
        number = operator.index(index)
        try:
            return self._numbers[number]
        except IndexError:
            there_are = f"use 0 to {len(self) - 1}" if self._numbers else "there are no frames"
            raise IndexError(f"frame: there is no number {number}; {there_are}") from None

    def _frame(self, index: int) -> _piblocks.Frame:
        return self._pictures.frame(self._number(index))
