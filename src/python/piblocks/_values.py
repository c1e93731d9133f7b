"""Python's values as the texts that a scene file would have.

In: numbers, strings, lists. Out: exact texts, as bytes. A float is the decimal that Python prints
for it: 0.1 is one tenth.
"""

from __future__ import annotations

import numbers
import os
import re
from collections.abc import Mapping
from decimal import Decimal
from typing import Any, Union

import numpy as np

from ._errors import UsageError


def bytes_of(text: str) -> bytes:
    """UTF-8. Surrogates stay bytes that are no UTF-8, which the library rejects where it matters."""
    try:
        return text.encode("utf-8", "surrogateescape")
    except UnicodeEncodeError:
        return text.encode("utf-8", "surrogatepass")


def text_of_integer(value: int) -> str:
    # str() refuses integers of more than 4300 digits.
    return str(value) if value.bit_length() < 10_000 else str(Decimal(value))


def text_of_number(value: Any) -> str | None:
    """The exact text of a number; None for anything else."""
    if isinstance(value, (int, np.integer)):
        return text_of_integer(int(value))
    if isinstance(value, float):
        return float.__repr__(value)
    if isinstance(value, np.floating):
        return str(value)
    if isinstance(value, Decimal):
        return str(value)
    if isinstance(value, numbers.Rational):
        return f"{text_of_integer(int(value.numerator))}/{text_of_integer(int(value.denominator))}"
    return None


def shown(text: bytes) -> Union[str, int, bool]:
    """The value as repr() writes it: a bool or a number that reads as this text, or the text."""
    if text in (b"true", b"false"):
        return text == b"true"
    is_plain = text == b"0" or re.fullmatch(rb"-?[1-9][0-9]{0,17}", text) is not None
    return int(text) if is_plain else text.decode("utf-8", "surrogateescape")


def scalar(name: str, value: Any) -> bytes:
    """The text of one value. Raises TypeError that names the key."""
    if isinstance(value, (bool, np.bool_)):
        return b"true" if value else b"false"
    if isinstance(value, str):
        return bytes_of(str(value))
    if isinstance(value, os.PathLike):
        return os.fsencode(value)
    if isinstance(value, np.ndarray) and value.ndim == 0:
        return scalar(name, value[()])
    number = text_of_number(value)
    if number is None:
        raise TypeError(
            f"{name}: must be a number, a string, True or False, or a list of these, "
            f"not {type(value).__name__}"
        )
    return number.encode()


def texts(name: str, value: Any) -> list[bytes]:
    """The texts of a value or of a list."""
    if isinstance(value, np.ndarray) and value.ndim > 0:
        value = list(value)
    if isinstance(value, (list, tuple, range)):
        return [scalar(name, one) for one in value]
    return [scalar(name, value)]


def instant(name: str, value: Any) -> bytes:
    """The text of an instant: a number, or "turn-0.3", "last", "#314"."""
    if isinstance(value, (bool, np.bool_, os.PathLike)):
        raise TypeError(f"{name}: must be a number or a string, not {type(value).__name__}")
    return scalar(name, value)


def path(name: str, value: Any) -> bytes:
    """The name of a file. Raises TypeError, or UsageError for what no file can be called."""
    if isinstance(value, (str, bytes, os.PathLike)):
        try:
            text = os.fsencode(value)
        except UnicodeEncodeError:
            raise UsageError(f"{name}: {ascii(value)} is not the name of a file") from None
        if b"\0" in text:
            raise UsageError(f"{name}: {ascii(value)} has a null character; leave it out")
        return text
    raise TypeError(f"{name}: must be a str or a path, not {type(value).__name__}")


def flag(name: str, value: Any) -> bool:
    if isinstance(value, (bool, np.bool_)):
        return bool(value)
    raise TypeError(f"{name}: must be True or False, not {type(value).__name__}")


def require_str(name: str, value: Any) -> None:
    if not isinstance(value, str):
        raise TypeError(f"{name}: must be a str, not {type(value).__name__}")


def options(given: Mapping[str, Any]) -> dict[bytes, bytes]:
    """Options of a command: {"--jobs": 2} becomes {b"--jobs": b"2"}. None is not given."""
    result = {}
    for option, value in given.items():
        name = option.removeprefix("--").replace("-", "_")
        if value is not None and value is not False:
            result[option.encode()] = b",".join(texts(name, value))
    return result
