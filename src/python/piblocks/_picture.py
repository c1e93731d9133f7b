"""Pictures of any library as one side of a comparison.

In: arrays, images of Pillow, figures of matplotlib, PNG files. Out: what the extension compares.
No library is imported for this: objects are known by what they can do.
"""

from __future__ import annotations

import io
import os
from typing import Any

import numpy as np

from . import _piblocks
from ._errors import UsageError
from ._values import path

_MUST_BE = (
    "must be an array, an image of Pillow, a figure of matplotlib, the bytes of a PNG file, or a "
    "path"
)


def _remedy(dtype: np.dtype[Any]) -> str:
    if dtype.kind == "f":
        return "of values from 0 to 1, give (255 * picture).round().astype('uint8')"
    if dtype.kind == "b":
        return "give 255 * picture.astype('uint8')"
    return "give picture.astype('uint8') or 'uint16', whose range is the whole of the type"


def _of_array(name: str, array: np.ndarray[Any, Any]) -> _piblocks.Picture:
    if array.dtype.kind != "u" or array.dtype.itemsize > 2:
        raise UsageError(f"{name}: samples are {array.dtype}; {_remedy(array.dtype)}")
    if array.ndim == 3 and array.shape[2] == 1:
        array = array[..., 0]
    if not (array.ndim == 2 or array.ndim == 3 and array.shape[2] in (3, 4)):
        shape = " x ".join(map(str, array.shape)) or "a number"
        raise UsageError(
            f"{name}: the array is {shape}; it must be height x width, for greys, or height x "
            "width x 3 or 4, for red, green, blue and alpha"
        )
    native = array.astype(array.dtype.newbyteorder("="), copy=False)
    return _piblocks.picture_of_samples(np.ascontiguousarray(native))


def _of_pillow(name: str, image: Any) -> _piblocks.Picture:
    # Palettes may have alpha.
    if image.mode in ("P", "PA", "LA", "La", "RGBa") or "transparency" in image.info:
        image = image.convert("RGBA")
    elif image.mode not in ("L", "RGB", "RGBA", "I", "F") and not image.mode.startswith("I;16"):
        image = image.convert("RGB")
    return _of_array(name, np.asarray(image))


def _is_pillow(given: Any) -> bool:
    return hasattr(given, "mode") and hasattr(given, "convert") and hasattr(given, "getbands")


def is_picture(given: Any) -> bool:
    """Whether picture() takes objects of this kind."""
    if isinstance(given, (str, os.PathLike, bytes, bytearray, memoryview)) or _is_pillow(given):
        return True
    known = ("savefig", "buffer_rgba", "__array__", "__array_interface__")
    return any(hasattr(given, name) for name in known)


def picture(name: str, given: Any) -> _piblocks.Picture:
    """One side of a comparison. :param name: of the argument, for messages.

    :raises UsageError: if an array has other samples or another shape. :raises TypeError: for
        anything else.
    """
    if isinstance(given, (str, os.PathLike)):
        return _piblocks.picture_of_path(path(name, given))
    if isinstance(given, (bytes, bytearray)) or isinstance(given, memoryview) and given.ndim == 1:
        if not bytes(given[:8]) == b"\x89PNG\r\n\x1a\n":
            raise UsageError(f"{name}: the bytes are no PNG file; give those of one, or an array")
        return _piblocks.picture_of_png(bytes(given))
    if hasattr(given, "savefig"):
        file = io.BytesIO()
        given.savefig(file, format="png")
        return _piblocks.picture_of_png(file.getvalue())
    if hasattr(given, "buffer_rgba"):  # a canvas of matplotlib that paints pixels
        given.draw()
        return _of_array(name, np.asarray(given.buffer_rgba()))
    if _is_pillow(given):
        return _of_pillow(name, given)
    if is_picture(given):
        return _of_array(name, np.asarray(given))
    raise TypeError(f"{name}: {_MUST_BE}, not {type(given).__name__}")


def mask_picture(name: str, given: Any) -> _piblocks.Picture:
    """The same of a picture that hides what is not black; an array may also be of bool."""
    array = None if _is_pillow(given) or not hasattr(given, "__array__") else np.asarray(given)
    if array is not None and array.dtype.kind == "b":
        return _of_array(name, 255 * array.astype(np.uint8))
    return picture(name, given)
