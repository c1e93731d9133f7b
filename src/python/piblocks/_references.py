"""Where the references of pytest's tests are, and which test has them."""

from __future__ import annotations

import hashlib
import os
import re
from pathlib import Path
from typing import Any

import pytest

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
