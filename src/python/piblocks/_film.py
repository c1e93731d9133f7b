"""The frames of a film as NumPy arrays."""

from __future__ import annotations

import operator
from collections.abc import Iterator
from fractions import Fraction
from typing import Union, overload

import numpy as np

from . import _piblocks


def pixels(frame: _piblocks.Frame) -> np.ndarray:
    """Height x width x 3, read-only and without a copy; with alpha x 4, straight, a copy."""
    bgra = np.asarray(frame)
    if not frame.has_alpha:
        return bgra[..., 2::-1]
    rgba = np.empty(bgra.shape, np.uint8)
    frame.copy_rgba(rgba)
    return rgba


class Frames:
    """The frames of a film, a sequence of arrays.

    A frame is a read-only uint8 array of height x width x 3: red, green, blue. It shows the
    renderer's own memory. As long as you hold a frame its pixels stay; once nobody holds it, its
    memory is painted again. With a transparent background it is height x width x 4, with straight
    alpha, and a copy. A slice is a sequence of the same kind, and paints nothing.
    """

    def __init__(
        self, pictures: _piblocks.Pictures, fps: Fraction, numbers: range | None = None
    ) -> None:
        self._pictures = pictures
        self._numbers = range(pictures.frame_count) if numbers is None else numbers
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
            return Frames(self._pictures, self.fps, self._numbers[index])
        return pixels(self._frame(index))

    def __iter__(self) -> Iterator[np.ndarray]:
        for number in self._numbers:
            yield pixels(self._pictures.frame(number))

    def __reversed__(self) -> Iterator[np.ndarray]:
        return iter(self[::-1])

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
        try:
            return self._numbers[operator.index(index)]
        except IndexError:
            raise IndexError(
                f"frame: there is no number {index}; use 0 to {len(self) - 1}"
            ) from None

    def _frame(self, index: int) -> _piblocks.Frame:
        return self._pictures.frame(self._number(index))
