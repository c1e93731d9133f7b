"""Keywords and the keys of a scene file.

A keyword is a key of a scene file with its dots and hyphens as underscores; a dict stands for the
keys that begin with its name.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from . import _piblocks
from ._errors import SceneError
from ._values import bytes_of, texts

KeyTexts = tuple[bytes, bytes, list[bytes]]


def _keyword(key: str) -> str:
    return key.replace(".", "_").replace("-", "_")


KEYS: dict[str, str] = {_keyword(key): key for key in _piblocks.key_names()}


def keys() -> list[str]:
    """The keywords of ``Scene``, such as ``view_size`` for the key ``view.size``."""
    return list(KEYS)


def _advice(word: str) -> str:
    near = _piblocks.nearest_name(bytes_of(word), list(KEYS))
    if near:
        return f"; did you mean '{near}'?"
    same_end = [name for name in KEYS if name.endswith("_" + word)]
    if same_end:
        return "; did you mean '" + "' or '".join(same_end) + "'?"
    return ";"


def unknown(word: str) -> str:
    return f"scene: unknown key '{word}'{_advice(word)} piblocks.keys() lists them"


def _flat(values: Mapping[Any, Any], before: str = "") -> Iterator[tuple[str, Any]]:
    for name, value in values.items():
        if not isinstance(name, str):
            raise TypeError(f"{before or 'scene'}: keys must be str, not {type(name).__name__}")
        keyword = _keyword(f"{before}_{name}" if before else name)
        if isinstance(value, Mapping):
            yield from _flat(value, keyword)
        elif value is not None:
            yield keyword, value


def key_texts(values: Mapping[str, Any]) -> list[KeyTexts]:
    """Keyword, key and texts of every value. Raises SceneError with all unknown keys, TypeError."""
    flat = list(_flat(values))
    problems = [unknown(keyword) for keyword, _ in flat if keyword not in KEYS]
    if problems:
        raise SceneError(*problems)
    seen: set[str] = set()
    for keyword, _ in flat:
        if keyword in seen:
            raise SceneError(f"{keyword} is given more than once")
        seen.add(keyword)
    result = [
        (keyword.encode(), KEYS[keyword].encode(), texts(keyword, value)) for keyword, value in flat
    ]
    _piblocks.check_keys(result)
    return result


def _toml_string(text: bytes) -> bytes:
    parts = []
    for byte in text:
        if byte < 0x20 or byte == 0x7F or byte in b'"\\':
            parts.append(b"\\u%04X" % byte)
        else:
            parts.append(bytes([byte]))
    return b'"' + b"".join(parts) + b'"'


def _toml_value(name: str, value: Any) -> bytes:
    if isinstance(value, (list, tuple)) and any(isinstance(one, Mapping) for one in value):
        tables = [_toml_table(f"{name}[{i}]", one) for i, one in enumerate(value)]
        return b"[" + b", ".join(tables) + b"]"
    values = [_toml_string(text) for text in texts(name, value)]
    is_list = isinstance(value, (list, tuple)) or len(values) != 1
    return b"[" + b", ".join(values) + b"]" if is_list else values[0]


def _toml_table(name: str, table: Any) -> bytes:
    if not isinstance(table, Mapping):
        raise TypeError(f"{name}: must be a dict of keys, not {type(table).__name__}")
    entries = []
    for keyword, value in _flat(table):
        key = KEYS.get(keyword, keyword)
        quoted = b".".join(_toml_string(bytes_of(part)) for part in key.split("."))
        entries.append(quoted + b" = " + _toml_value(keyword, value))
    return b"{ " + b", ".join(entries) + b" }"


def parts_text(parts: Any) -> bytes:
    """The [[part]]s of a storyboard as text whose line N has part N."""
    if not isinstance(parts, (list, tuple)):
        raise TypeError(f"part: must be a list of dicts, not {type(parts).__name__}")
    if not parts:
        raise SceneError("part: is empty; a storyboard has at least one part")
    tables = [_toml_table(f"part[{i}]", one) for i, one in enumerate(parts)]
    return b"part = [ " + b",\n".join(tables) + b" ]\n"
