"""Holds scenes and pictures of tests to golden references, as pytest-mpl does for figures.

    @pytest.mark.piblocks_golden(dir="golden")
    def test_turn():
        return Scene(digits=2, view_size="640x360")

    def test_plot(piblocks_golden):
        piblocks_golden(figure, max_delta=2)  # or an array, an image of Pillow, a PNG file

``pytest`` alone runs the function and reads its pictures. ``pytest --piblocks-golden`` compares them
with the references beside the test's file; ``--piblocks-golden-record`` keeps new ones, and compares
where there are some; ``--piblocks-golden-approve`` replaces them. The files of a scene are those of
``piblocks golden``, a picture is a PNG file. Their names are those of the module, the test and its
parameters: of ``test_turn`` in ``test_scenes.py`` they begin with ``test_scenes-test_turn``.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import pytest

from . import _golden
from ._compare import TOLERANCE
from ._golden_picture import (
    CLAIMS, REMEDY, GoldenPictures, check_or_keep, claim, place, results_folder)
from ._picture import is_picture
from ._scene import Scene

_MARK = "piblocks_golden"
_ACTIONS = {"check": "--piblocks-golden", "record": "--piblocks-golden-record",
            "approve": "--piblocks-golden-approve"}


def pytest_addoption(parser: pytest.Parser) -> None:
    group = parser.getgroup("piblocks", "golden references of piblocks")
    group.addoption("--piblocks-golden", action="store_true",
                    help="compare scenes and pictures of tests with their references")
    group.addoption("--piblocks-golden-record", action="store_true",
                    help="keep new references; compare where there are some")
    group.addoption("--piblocks-golden-approve", action="store_true",
                    help="replace the references, and tell what changes")
    group.addoption("--piblocks-golden-results", metavar="DIR", default=None,
                    help="a folder for expected, difference, actual and a page of what differs")


def pytest_configure(config: pytest.Config) -> None:
    config.addinivalue_line(
        "markers",
        f"{_MARK}(dir='golden', name=None, frames=None, **tolerance): the test returns a piblocks "
        "Scene or a picture, which is held to its references; dir is beside the test's file; "
        "tolerances are those of piblocks.compare, for pictures",
    )
    config.stash[CLAIMS] = {}
    given = [option for option in _ACTIONS.values() if config.getoption(option)]
    if len(given) > 1:
        raise pytest.UsageError(f"{' and '.join(given)} exclude each other; give one of them")


def _action(config: pytest.Config) -> str | None:
    return next((name for name, option in _ACTIONS.items() if config.getoption(option)), None)


@pytest.fixture
def piblocks_golden(request: pytest.FixtureRequest) -> GoldenPictures:
    """Holds pictures to references: piblocks_golden(picture, name=None, dir="golden", max_delta=…).
    """
    return GoldenPictures(request.node, _action(request.config))


def _marked_place(item: pytest.Function, mark: pytest.Mark) -> tuple[Path, str]:
    """Folder and name of the references of a marked test."""
    folder, name = place(item, mark.kwargs.get("dir", mark.args[0] if mark.args else "golden"))
    return folder, mark.kwargs.get("name") or name


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
                folder, name = _marked_place(item, mark)
            except TypeError:  # reported when the test runs
                continue
            owner = first.setdefault(folder / str(name), item.nodeid)
            if owner != item.nodeid:
                config.stash[CLAIMS][str(folder / str(name))] = owner


def _pages(script: Any, name: str, folder: Path, frames: Any, results: Path) -> list[str]:
    page = results / f"{name}.html"
    has_pictures = _golden.report(script, name, folder, frames, page)
    return [f"page: {page}"] if has_pictures else []


def _hold_scene(item: pytest.Function, scene: Scene, action: str, mark: pytest.Mark) -> None:
    folder, name = _marked_place(item, mark)
    frames = mark.kwargs.get("frames")
    claim(item, str(folder / str(name)))
    for file in _golden.files(scene._script, name, folder, frames):
        claim(item, file)
    diff = None if action == "approve" else results_folder(item.config)
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
    pytest.fail("\n".join([*lines, REMEDY]), pytrace=False)


def _hold_picture(item: pytest.Function, given: Any, action: str | None, mark: pytest.Mark) -> None:
    folder, name = _marked_place(item, mark)
    tolerance = {key: mark.kwargs[key] for key in TOLERANCE if key in mark.kwargs}
    claim(item, str(folder / name))
    check_or_keep(item, action, folder / f"{name}.png", given, tolerance, ", what it returns")


def _close(figure: Any) -> None:
    """Frees a figure that pyplot holds; it is of no use after the test that has returned it."""
    pyplot = sys.modules.get("matplotlib.pyplot")
    if pyplot is not None and hasattr(figure, "savefig"):
        pyplot.close(figure)


def _hold(item: pytest.Function, given: Any, action: str | None, mark: pytest.Mark) -> None:
    of_what = ("frames",) if isinstance(given, Scene) else TOLERANCE
    unknown = sorted(set(mark.kwargs) - {"dir", "name", *of_what})
    if unknown:
        pytest.fail(f"{_MARK} has no argument '{unknown[0]}' for a {type(given).__name__}",
                    pytrace=False)
    if isinstance(given, Scene):
        if action is not None:
            _hold_scene(item, given, action, mark)
    elif is_picture(given):
        try:
            _hold_picture(item, given, action, mark)
        finally:
            _close(given)
    else:
        pytest.fail(
            f"{item.name} returned {type(given).__name__}; a test marked {_MARK} returns a Scene "
            "or a picture",
            pytrace=False,
        )


@pytest.hookimpl(tryfirst=True)
def pytest_pyfunc_call(pyfuncitem: pytest.Function) -> bool | None:
    mark = pyfuncitem.get_closest_marker(_MARK)
    if mark is None:
        return None
    names = pyfuncitem._fixtureinfo.argnames
    given = pyfuncitem.obj(**{name: pyfuncitem.funcargs[name] for name in names})
    action = _action(pyfuncitem.config)
    if action is not None or is_picture(given):
        _hold(pyfuncitem, given, action, mark)
    return True
