"""Holds scenes that tests return to golden references, as pytest-mpl does for figures.

    @pytest.mark.piblocks_golden(dir="golden")
    def test_turn():
        return Scene(digits=2, view_size="640x360")

``pytest`` alone runs the function. ``pytest --piblocks-golden`` compares its scene with the
references beside the test's file; ``--piblocks-golden-record`` keeps new ones, and compares where
there are some; ``--piblocks-golden-approve`` replaces them. The files are those of ``piblocks
golden``. Their names are those of the module, the test and its parameters: of ``test_turn`` in
``test_scenes.py`` they begin with ``test_scenes-test_turn``.
"""

from __future__ import annotations

import hashlib
import os
import re
from pathlib import Path
from typing import Any

import pytest

from . import _golden
from ._scene import Scene

_MARK = "piblocks_golden"
_REMEDY = ("pytest --piblocks-golden-record keeps new references, --piblocks-golden-approve replaces "
           "them")
_LONGEST_NAME = 150  # characters; a file name has 255, also for an instant and an ending
#: The paths of references, and the test that has them.
_CLAIMS: pytest.StashKey[Any] = pytest.StashKey()
_ACTIONS = {"check": "--piblocks-golden", "record": "--piblocks-golden-record",
            "approve": "--piblocks-golden-approve"}


def pytest_addoption(parser: pytest.Parser) -> None:
    group = parser.getgroup("piblocks", "golden references of piblocks scenes")
    group.addoption("--piblocks-golden", action="store_true",
                    help="compare the scenes of marked tests with their references")
    group.addoption("--piblocks-golden-record", action="store_true",
                    help="keep new references; compare where there are some")
    group.addoption("--piblocks-golden-approve", action="store_true",
                    help="replace the references, and tell what changes")
    group.addoption("--piblocks-golden-results", metavar="DIR", default=None,
                    help="a folder for expected, difference, actual and a page of what differs")


def pytest_configure(config: pytest.Config) -> None:
    config.addinivalue_line(
        "markers",
        f"{_MARK}(dir='golden', name=None, frames=None): the test returns a piblocks Scene, which "
        "is held to its references; dir is beside the test's file",
    )
    config.stash[_CLAIMS] = {}
    given = [option for option in _ACTIONS.values() if config.getoption(option)]
    if len(given) > 1:
        raise pytest.UsageError(f"{' and '.join(given)} exclude each other; give one of them")


def _action(config: pytest.Config) -> str | None:
    return next((name for name, option in _ACTIONS.items() if config.getoption(option)), None)


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


def _place(item: pytest.Function, mark: pytest.Mark) -> tuple[Path, str]:
    """Folder and name of a test's references."""
    given = mark.kwargs.get("dir", mark.args[0] if mark.args else "golden")
    folder = Path(os.path.normpath(Path(item.path).parent / given))
    return folder, mark.kwargs.get("name") or _reference_name(item, folder)


def _claim(item: pytest.Item, path: str) -> None:
    """Fails if the references of another test have this path."""
    first = item.config.stash[_CLAIMS].setdefault(path, item.nodeid)
    if first != item.nodeid:
        pytest.fail(
            f"the references '{path}' are those of {first} too; give {item.nodeid} a name or a "
            "folder of its own",
            pytrace=False,
        )


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Finds names that several tests have, also those that do not run."""
    if _action(config) is None:
        return
    first: dict[Path, str] = {}
    for item in items:
        mark = item.get_closest_marker(_MARK)
        if mark is not None and isinstance(item, pytest.Function):
            try:
                folder, name = _place(item, mark)
            except TypeError:  # reported when the test runs
                continue
            owner = first.setdefault(folder / str(name), item.nodeid)
            if owner != item.nodeid:
                config.stash[_CLAIMS][str(folder / str(name))] = owner


def _pages(script: Any, name: str, folder: Path, frames: Any, results: Path) -> list[str]:
    page = results / f"{name}.html"
    has_pictures = _golden.report(script, name, folder, frames, page)
    return [f"page: {page}"] if has_pictures else []


def _hold(item: pytest.Function, scene: Any, action: str, mark: pytest.Mark) -> None:
    if not isinstance(scene, Scene):
        pytest.fail(
            f"{item.name} returned {type(scene).__name__}; a test marked {_MARK} returns a Scene",
            pytrace=False,
        )
    unknown = set(mark.kwargs) - {"dir", "name", "frames"}
    if unknown:
        pytest.fail(f"{_MARK} has no argument '{sorted(unknown)[0]}'", pytrace=False)
    folder, name = _place(item, mark)
    frames = mark.kwargs.get("frames")
    _claim(item, str(folder / str(name)))
    for file in _golden.files(scene._script, name, folder, frames):
        _claim(item, file)
    results = item.config.getoption("--piblocks-golden-results")
    diff = None if results is None or action == "approve" else Path(results)
    result = _golden.act(scene._script, action, name, folder, frames, diff)
    if result.outcome == "kept":
        result = _golden.act(scene._script, "check", name, folder, frames, diff)
    item.add_report_section("call", "piblocks golden", str(result))
    if result:
        if diff is not None:
            (diff / f"{name}.html").unlink(missing_ok=True)  # of an earlier failure
        return
    lines = list(result.lines)
    if diff is not None and result.outcome == "different":
        lines += _pages(scene._script, name, folder, frames, diff)
    pytest.fail("\n".join([*lines, _REMEDY]), pytrace=False)


@pytest.hookimpl(tryfirst=True)
def pytest_pyfunc_call(pyfuncitem: pytest.Function) -> bool | None:
    mark = pyfuncitem.get_closest_marker(_MARK)
    if mark is None:
        return None
    names = pyfuncitem._fixtureinfo.argnames
    scene = pyfuncitem.obj(**{name: pyfuncitem.funcargs[name] for name in names})
    action = _action(pyfuncitem.config)
    if action is not None:
        _hold(pyfuncitem, scene, action, mark)
    return True
