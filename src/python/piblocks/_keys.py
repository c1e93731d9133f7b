"""Keywords and the keys of a scene file.

A keyword is a key of a scene file with its dots and hyphens as underscores; a dict stands for the
keys that begin with its name.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import Any, Optional, Union

from . import _piblocks
from ._errors import SceneError, UsageError
from ._values import bytes_of, shown, texts

#: Keyword, key, and the texts of the value; without them the key has its default.
KeyTexts = tuple[bytes, bytes, Optional[list[bytes]]]
#: The keywords of a part: the text of a value, those of a list, or the tables of ``compare``.
Table = dict[str, Union[bytes, list[bytes], list[Any]]]


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
        elif value is None and keyword not in KEYS:
            below = [key for key in KEYS if key.startswith(keyword + "_")]
            yield from ((key, None) for key in below or [keyword])
        else:
            yield keyword, value


def _require_each_once(keywords: list[str], before: str = "") -> None:
    for i, keyword in enumerate(keywords):
        if keyword in keywords[:i]:
            raise SceneError(f"{before}{keyword} is given more than once")


def key_texts(values: Mapping[str, Any]) -> list[KeyTexts]:
    """Keyword, key and texts of every value; None has no texts.

    Raises SceneError with all unknown keys, TypeError."""
    flat = list(_flat(values))
    given = {keyword for keyword, value in flat if value is not None}
    problems = [unknown(keyword) for keyword, _ in flat if keyword not in KEYS]
    if problems:
        raise SceneError(*problems)
    _require_each_once([keyword for keyword, value in flat if value is not None])
    result: list[KeyTexts] = [
        (keyword.encode(), KEYS[keyword].encode(), None if value is None else texts(keyword, value))
        for keyword, value in flat
        if value is not None or keyword not in given
    ]
    _piblocks.check_keys(result)
    return result


def fit_into_one_call(keys: list[KeyTexts]) -> bool:
    """Whether a call may have all of these keywords: not if two of them set one value."""
    try:
        _piblocks.check_keys(keys)
    except UsageError:
        return False
    return True


def _toml_string(text: bytes) -> bytes:
    return b'"%s"' % re.sub(rb'[\0-\x1f\x7f"\\]', lambda match: b"\\u%04X" % match[0][0], text)


def _value_of_part(name: str, value: Any) -> Union[bytes, list[bytes], list[Table]]:
    if isinstance(value, (list, tuple)) and any(isinstance(one, Mapping) for one in value):
        return [_table(f"{name}[{i}]", one) for i, one in enumerate(value)]
    values = texts(name, value)
    return values if isinstance(value, (list, tuple)) or len(values) != 1 else values[0]


def _table(name: str, values: Any) -> Table:
    if not isinstance(values, Mapping):
        raise TypeError(f"{name}: must be a dict of keys, not {type(values).__name__}")
    flat = [(keyword, value) for keyword, value in _flat(values) if value is not None]
    _require_each_once([keyword for keyword, _ in flat], f"{name}: ")
    return {keyword: _value_of_part(keyword, value) for keyword, value in flat}


def parts_of(parts: Any) -> list[Table]:
    """The parts of a storyboard with the texts of their values. Raises SceneError, TypeError."""
    if not isinstance(parts, (list, tuple)):
        raise TypeError(f"part: must be a list of dicts, not {type(parts).__name__}")
    if not parts:
        raise SceneError("part: is empty; a storyboard has at least one part")
    return [_table(f"part[{i}]", one) for i, one in enumerate(parts)]


def _toml(value: Any) -> bytes:
    if isinstance(value, bytes):
        return _toml_string(value)
    if isinstance(value, list):
        return b"[" + b", ".join(map(_toml, value)) + b"]"
    entries = []
    for keyword, one in value.items():
        parts = KEYS.get(keyword, keyword).split(".")
        quoted = b".".join(_toml_string(bytes_of(part)) for part in parts)
        entries.append(quoted + b" = " + _toml(one))
    return b"{ " + b", ".join(entries) + b" }"


def parts_text(parts: list[Table]) -> bytes:
    """The [[part]]s of a storyboard as text whose line N has part N."""
    return b"part = [ " + b",\n".join(map(_toml, parts)) + b" ]\n"


def parts_shown(parts: Any) -> Any:
    """The parts as repr() writes them."""
    if isinstance(parts, bytes):
        return shown(parts)
    if isinstance(parts, list):
        return [parts_shown(one) for one in parts]
    return {keyword: parts_shown(value) for keyword, value in parts.items()}
