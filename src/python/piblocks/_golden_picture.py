"""Holds the pictures of pytest's tests to reference PNG files.

It also knows where these are, and which test has them.
"""

from __future__ import annotations

import hashlib
import os
import re
from pathlib import Path
from typing import Any

import pytest

from . import _piblocks
from ._compare import Comparison, compare_pictures
from ._errors import Error, IoError
from ._picture import picture
from ._values import require_str

REMEDY = ("pytest --piblocks-golden-record keeps new references, --piblocks-golden-approve replaces "
          "them")
_LONGEST_NAME = 150  # characters; a file name has 255, also for an instant and an ending
_LONGEST_LABEL = 60  # characters
#: The paths of references, and the test that has them.
CLAIMS: pytest.StashKey[Any] = pytest.StashKey()


def _module_path(item: pytest.Function, folder: Path) -> str:
    """The test's file without its ending, from where the folder of the references is; else from
    pytest's root. It does not depend on where pytest was started."""
    file = Path(item.path)
    for root in (folder.parent, item.config.rootpath):
        if file.is_relative_to(root):
            return file.relative_to(root).with_suffix("").as_posix()
    return file.with_suffix("").as_posix()


def _folded(text: str, allowed: str) -> str:
    return re.sub(f"[^{allowed}]+", "_", text, flags=re.ASCII)


def _reference_name(item: pytest.Function, folder: Path) -> str:
    """A name that no other test has: MODULE-TEST or MODULE-TEST-PARAMETERS.

    MODULE and TEST have letters, digits, "_" and ".", which stands for "/" and "::"; PARAMETERS
    also have "-". What does not fit is folded, and a hash of the whole makes the name unique.
    """
    module = _module_path(item, folder)
    test, bracket, parameters = item.nodeid.split("::", 1)[-1].partition("[")
    parameters = parameters.removesuffix("]")
    name = "-".join(_folded(one, "A-Za-z0-9_.")
                    for one in (module.replace("/", "."), test.replace("::", ".")))
    if bracket:
        name += "-" + _folded(parameters, "A-Za-z0-9_.-")
    is_kept = (
        re.fullmatch(r"[A-Za-z0-9_]+(/[A-Za-z0-9_]+)*", module)
        and re.fullmatch(r"[A-Za-z0-9_]+(::[A-Za-z0-9_]+)*", test)
        and re.fullmatch(r"[A-Za-z0-9_.-]*", parameters)
        and len(name) <= _LONGEST_NAME
    )
    if is_kept:
        return name
    whole = f"{module}::{test}{bracket}{parameters}".encode("utf-8", "surrogatepass")
    return f"{name[:_LONGEST_NAME]}~{hashlib.sha256(whole).hexdigest()[:10]}"


def place(item: pytest.Function, given: Any) -> tuple[Path, str]:
    """The folder of a test's references, which is given from that of the test's file; and the
    name that they have unless the test gives another."""
    folder = Path(os.path.normpath(Path(item.path).parent / given))
    return folder, _reference_name(item, folder)


def claim(item: pytest.Item, path: str, what: str = "") -> None:
    """Fails if the references of another test, or of something else in this test, have this path."""
    owner = item.nodeid + what
    first = item.config.stash[CLAIMS].setdefault(path, owner)
    if first != owner:
        pytest.fail(
            f"the references '{path}' are those of {first} too; give {owner} a name or a folder of "
            "its own",
            pytrace=False,
        )


def labelled(name: str, label: str) -> str:
    """The name of another picture of a test: NAME+LABEL. Names of tests have no "+"."""
    folded = _folded(label, "A-Za-z0-9_.-")
    if folded == label and len(label) <= _LONGEST_LABEL:
        return f"{name}+{label}"
    code = hashlib.sha256(label.encode("utf-8", "surrogatepass")).hexdigest()[:10]
    return f"{name}+{folded[:_LONGEST_LABEL]}~{code}"


def shown(config: pytest.Config, path: Path) -> str:
    """The path for people: from where pytest was started."""
    start = config.invocation_params.dir
    return str(path.relative_to(start) if path.is_relative_to(start) else path)


def results_folder(config: pytest.Config) -> Path | None:
    """The folder of --piblocks-golden-results."""
    given = config.getoption("--piblocks-golden-results")
    return None if given is None else config.invocation_params.dir / given


def check_or_keep(
    item: pytest.Function, action: str | None, file: Path, given: Any, tolerance: dict[str, Any],
    what: str = "",
) -> None:
    """Compares a picture with its reference, or keeps it as such.

    :param action: "check", "record", "approve"; without one the picture is only read.
    :param what: which of the test's pictures it is, for messages.
    """
    made = picture("picture", given)
    if isinstance(given, (str, os.PathLike)):  # no folder, no video
        made = _piblocks.picture_of_png(made.png())
    if action is not None:
        claim(item, str(file), what)
    if action == "check" or action == "record" and file.exists():
        _check(item, file, made, tolerance)
        return
    compare_pictures(made, made, **tolerance)  # it can be read, and the tolerance makes sense
    if action is not None:
        _keep(item, file, made, tolerance)


def _say(item: pytest.Function, file: Path, *lines: str) -> str:
    """Adds lines to the report of the test; returns the first, which is about the reference."""
    first = f"{shown(item.config, file)}: {lines[0]}"
    item.add_report_section("call", "piblocks golden", "\n".join([first, *lines[1:]]))
    return first


def _text(result: Comparison) -> str:
    return str(result).removeprefix(f"{result.name}: ")


def _compared(file: Path, made: _piblocks.Picture, tolerance: dict[str, Any]) -> Comparison:
    return compare_pictures(_piblocks.picture_of_path(os.fsencode(file)), made, **tolerance)


def _keep(
    item: pytest.Function, file: Path, made: _piblocks.Picture, tolerance: dict[str, Any]
) -> None:
    text = "recorded"
    if file.exists():
        try:
            result = _compared(file, made, tolerance)
        except IoError as error:
            text = f"replaced ({error})"
        else:
            text = "equal" if result.outcome == "equal" else f"replaced ({_text(result)})"
    if text != "equal":
        made.write(os.fsencode(file))
    _say(item, file, text)


def _check(
    item: pytest.Function, file: Path, made: _piblocks.Picture, tolerance: dict[str, Any]
) -> None:
    if not file.exists():
        pytest.fail(f"{_say(item, file, 'there is no reference')}\n{REMEDY}", pytrace=False)
    try:
        result = _compared(file, made, tolerance)
    except IoError as error:
        pytest.fail(f"{_say(item, file, str(error))}\n{REMEDY}", pytrace=False)
    try:
        notes = _pictures(item.config, file.stem, result)
    except Error as error:  # the folder has other files, or the disk is full
        notes = [str(error)]
    line = _say(item, file, _text(result), *notes)
    if not result:
        pytest.fail(f"{line}\n{REMEDY}", pytrace=False)


def _pictures(config: pytest.Config, name: str, result: Comparison) -> list[str]:
    """Writes the pictures of a failure and a page, or removes those of an earlier one. Returns
    lines that name them."""
    results = results_folder(config)
    if results is None:
        return []
    folder, page = results / name, results / f"{name}.html"
    result._made.save_pictures(os.fsencode(folder))
    if result:
        page.unlink(missing_ok=True)
        return []
    result.report(page)
    pictures = {kind: folder / f"{name}-{kind}.png" for kind in ("expected", "actual", "diff")}
    files = {kind: file for kind, file in pictures.items() if file.exists()} | {"page": page}
    return [f"{kind}: {shown(config, file)}" for kind, file in files.items()]


class GoldenPictures:
    """The fixture ``piblocks_golden`` of one test."""

    def __init__(self, item: pytest.Function, action: str | None) -> None:
        self._item = item
        self._action = action
        self._labels: set[str] = set()

    def __call__(
        self, picture: Any, name: str | None = None, *, dir: Any = "golden", **tolerance: Any
    ) -> None:
        """Compares a picture with its reference, or keeps it as such: as the options of pytest say.

        :param picture: an array, an image of Pillow, a figure of matplotlib, the bytes of a PNG
            file or a path, as for ``piblocks.compare``.
        :param name: of the picture among those of the test; without it they have numbers.
        :param dir: the folder of the references, beside the test's file.
        :param tolerance: what is accepted, as for ``piblocks.compare``: ``max_delta`` and so on.
        :raises UsageError, IoError, TypeError: as ``piblocks.compare``.
        """
        __tracebackhide__ = True
        folder, test = place(self._item, dir)
        if name is not None:
            require_str("name", name)
        number = "" if not self._labels else str(len(self._labels) + 1)
        label = number if name is None else name
        if label in self._labels:
            pytest.fail(f"{self._item.nodeid} has two pictures '{label}'; give one another name",
                        pytrace=False)
        self._labels.add(label)
        file = folder / f"{labelled(test, label) if label else test}.png"
        check_or_keep(self._item, self._action, file, picture, tolerance)
