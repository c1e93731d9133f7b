"""The stub of the extension says what the extension has, and the package fits it."""

import ast
import inspect
import re
import subprocess
import sys

import pytest
from conftest import TREE

import piblocks
import piblocks._piblocks as extension

PACKAGE = TREE / "src/python/piblocks"


def _stub_signatures(tree, before=""):
    for node in tree.body:
        if isinstance(node, ast.ClassDef):
            yield from _stub_signatures(node, node.name + ".")
        elif isinstance(node, ast.FunctionDef):
            is_property = any(getattr(d, "id", "") == "property" for d in node.decorator_list)
            names = [a.arg for a in node.args.args if a.arg != "self"]
            yield before + node.name, None if is_property else names
        elif isinstance(node, ast.AnnAssign):
            yield before + node.target.id, None


def _parameters(function):
    """The names that pybind11 writes into the first line of the docstring."""
    text = re.search(r"\((.*)\) ->", function.__doc__.splitlines()[0])[1]
    names = re.findall(r"(?:^|, )([a-z_]+): ", re.sub(r"\[[^\]]*(?:\[[^\]]*\][^\]]*)*\]", "", text))
    return [name for name in names if name != "self"]


def _module_signatures():
    for name, value in vars(extension).items():
        if name.startswith("__"):
            continue
        if not isinstance(value, type):
            yield name, _parameters(value) if callable(value) else None
            continue
        for member, inner in vars(value).items():
            is_own = not member.startswith("_") or (
                member == "__init__" and "(self: " in (inner.__doc__ or ""))
            if is_own:
                is_property = isinstance(inner, property)
                yield f"{name}.{member}", None if is_property else _parameters(inner)


def test_stub_and_extension_have_the_same_signatures():
    stub = dict(_stub_signatures(ast.parse((PACKAGE / "_piblocks.pyi").read_text())))
    assert stub == dict(_module_signatures())


def test_stubtest():
    pytest.importorskip("mypy", reason="there is no mypy (mypy)")
    # Classes of pybind11 have a metaclass of their own.
    with open("allowed", "w") as file:
        file.write("piblocks._piblocks.(Script|Run|BodyRun|Frame|Pictures|Picture|Comparison)\n"
                   "piblocks._piblocks.(Frame|Picture|Comparison).__init__\n")
    result = subprocess.run(
        [sys.executable, "-m", "mypy.stubtest", "piblocks._piblocks", "--ignore-missing-stub",
         "--allowlist", "allowed", "--ignore-unused-allowlist"],
        capture_output=True, text=True, env=_environment())
    assert result.returncode == 0, result.stdout + result.stderr


def test_the_package_fits_its_types():
    pytest.importorskip("mypy", reason="there is no mypy (mypy)")
    result = subprocess.run(
        [sys.executable, "-m", "mypy", "--python-version", "3.11", "--ignore-missing-imports",
         "--disallow-untyped-defs", "--warn-unused-ignores", "--cache-dir", "cache",
         str(PACKAGE)],
        capture_output=True, text=True)
    assert result.returncode == 0, result.stdout + result.stderr


def _environment():
    import os
    from pathlib import Path

    return {**os.environ, "MYPYPATH": str(Path(piblocks.__file__).parent.parent)}


def _public():
    for name in piblocks.__all__:
        value = getattr(piblocks, name)
        yield name, value
        if inspect.isclass(value) and value.__module__.startswith("piblocks"):
            for member, inner in vars(value).items():
                if not member.startswith("_") and (callable(inner) or isinstance(inner, property)):
                    yield f"{name}.{member}", inner


@pytest.mark.parametrize("name, value", list(_public()), ids=lambda one: one if
                         isinstance(one, str) else "")
def test_everything_public_has_a_docstring(name, value):
    trivial = name in ("Scene.is_transparent", "Player.html")
    assert trivial or (value.__doc__ or "").strip()


def test_the_version_is_that_of_the_project():
    text = (TREE / "CMakeLists.txt").read_text()
    assert f"project(piblocks VERSION {piblocks.__version__} " in text
