"""Holds scenes that tests return to golden references, as pytest-mpl does for figures.

    @pytest.mark.piblocks_golden(dir="golden")
    def test_turn():
        return Scene(digits=2, view_size="640x360")

``pytest`` alone runs the function. ``pytest --piblocks-golden`` compares its scene with the
references beside the test's file; ``--piblocks-golden-record`` keeps new ones, and fails where
there are some; ``--piblocks-golden-approve`` replaces them. The files are those of ``piblocks golden``.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest

from . import _golden
from ._scene import Scene

_MARK = "piblocks_golden"
_ACTIONS = {"check": "--piblocks-golden", "record": "--piblocks-golden-record",
            "approve": "--piblocks-golden-approve"}


def pytest_addoption(parser: pytest.Parser) -> None:
    group = parser.getgroup("piblocks", "golden references of piblocks scenes")
    group.addoption("--piblocks-golden", action="store_true",
                    help="compare the scenes of marked tests with their references")
    group.addoption("--piblocks-golden-record", action="store_true",
                    help="keep new references; fail where there are some")
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
    given = [option for option in _ACTIONS.values() if config.getoption(option)]
    if len(given) > 1:
        raise pytest.UsageError(f"{' and '.join(given)} exclude each other; give one of them")


def _action(config: pytest.Config) -> str | None:
    return next((name for name, option in _ACTIONS.items() if config.getoption(option)), None)


def _file_name(item: pytest.Function) -> str:
    """The test's name with its class and parameters, as the beginning of a file's name."""
    inside = item.nodeid.split("::", 1)[-1]
    return re.sub(r"[^A-Za-z0-9_.-]+", "-", inside).strip("-")


def _pages(script: Any, name: str, folder: Path, frames: Any, results: Path) -> list[str]:
    page = results / f"{name}.html"
    has_pictures = _golden.report(script, name, folder, frames, page)
    return [f"pictures: {results}", f"page: {page}"] if has_pictures else []


def _hold(item: pytest.Function, scene: Any, action: str, mark: pytest.Mark) -> None:
    if not isinstance(scene, Scene):
        pytest.fail(
            f"{item.name} returned {type(scene).__name__}; a test marked {_MARK} returns a Scene",
            pytrace=False,
        )
    options = dict(mark.kwargs)
    folder = Path(item.path).parent / options.pop("dir", mark.args[0] if mark.args else "golden")
    name = options.pop("name", None) or _file_name(item)
    frames = options.pop("frames", None)
    if options:
        pytest.fail(f"{_MARK} has no argument '{next(iter(options))}'", pytrace=False)
    results = item.config.getoption("--piblocks-golden-results")
    diff = None if results is None or action != "check" else Path(results) / name
    equal, lines = _golden.act(scene._script, action, name, folder, frames, diff)
    item.add_report_section("call", "piblocks golden", "\n".join(lines))
    if equal:
        return
    if diff is not None:
        lines += _pages(scene._script, name, folder, frames, Path(results))
    pytest.fail("\n".join(lines), pytrace=False)


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
