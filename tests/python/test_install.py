"""What is installed works without the build: the component for a package, and a wheel."""

import importlib.util
import os
import subprocess
import sys
import venv
from pathlib import Path

import pytest
from conftest import TREE

ASK = """
import piblocks, sys
print(piblocks.__file__)
scene = piblocks.Scene(1, view_size="64x36", view_fps=5)
assert scene.count == 3
scene.render("a.webm")  # by the module that needs libav
"""


def ask(python, **environment):
    clean = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    result = subprocess.run([python, "-c", ASK], capture_output=True, text=True,
                            env={**clean, **environment})
    assert result.returncode == 0, result.stderr
    return result.stdout.strip()


def in_place(library):
    """Whether the extension looks for its module beside itself."""
    result = subprocess.run(["readelf", "-d", library], capture_output=True, text=True)
    return "[$ORIGIN]" in result.stdout


def test_the_component():
    subprocess.run(["cmake", "--install", os.environ["PIBLOCKS_BUILD"], "--component", "python",
                    "--prefix", "usr"], check=True, capture_output=True)
    os.rename("usr", "moved")
    packages = Path("moved/lib/python3/dist-packages").resolve()
    names = {file.name for file in (packages / "piblocks").iterdir()}
    assert {"__init__.py", "py.typed", "_piblocks.pyi", "pytest_plugin.py",
            "libpiblocks_av.so"} <= names
    assert {file.name for file in (TREE / "src/python/piblocks").glob("*.py*")} <= names
    assert all(in_place(file) for file in (packages / "piblocks").glob("_piblocks*.so"))
    assert ask(sys.executable, PYTHONPATH=str(packages)).startswith(str(packages))
    others = [file for file in Path("moved").rglob("*") if file.is_file()
              and not file.resolve().is_relative_to(packages)]
    assert {file.parent for file in others} <= {Path("moved/share/doc/python3-piblocks")}


def test_a_wheel_of_the_build():
    """By pip, without a network, from what is built already."""
    for module in ("pip", "setuptools", "wheel"):
        if importlib.util.find_spec(module) is None:
            pytest.skip(f"there is no {module} (python3-{module})")
    pip = [sys.executable, "-m", "pip", "wheel", "--no-build-isolation", "--no-index", "--no-deps"]
    os.symlink(TREE / "CMakeLists.txt", "CMakeLists.txt")
    os.makedirs("src/python")  # pip builds in the source, where other tests are
    for name in ("piblocks", "pyproject.toml", "setup.py", "README.md"):
        os.symlink(TREE / "src/python" / name, f"src/python/{name}")
    result = subprocess.run([*pip, "src/python", "-w", "wheels"], capture_output=True, text=True)
    assert result.returncode == 0, result.stdout + result.stderr
    venv.create("venv", system_site_packages=True, symlinks=True)
    [wheel] = Path("wheels").iterdir()
    subprocess.run([sys.executable, "-m", "pip", "--python", "venv/bin/python", "install",
                    "--no-index", "--no-deps", str(wheel)], check=True, capture_output=True)
    assert ask("venv/bin/python").startswith(str(Path("venv").resolve()))
    entries = next(Path("venv").rglob("entry_points.txt")).read_text()
    assert "piblocks_golden = piblocks.pytest_plugin" in entries
