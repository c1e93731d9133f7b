"""pip builds the wheel from the source alone."""

import os
import subprocess
import sys
from pathlib import Path

from conftest import TREE
from test_install import ask


def test_a_wheel_of_the_source(monkeypatch):
    monkeypatch.delenv("PIBLOCKS_BUILD")
    # Without what other builds have left.
    tracked = subprocess.run(["git", "ls-files", "-z"], cwd=TREE, capture_output=True)
    if tracked.returncode == 0:
        files = [name for name in tracked.stdout.decode().split("\0") if name]
    else:
        files = [str(p.relative_to(TREE)) for p in TREE.rglob("*") if p.is_file()
                 and "build" not in p.parts]
    for name in files:
        if name.split("/")[0] in ("src", "include", "assets", "CMakeLists.txt", "README.md",
                                  "CHANGELOG.md", "LICENSE"):
            target = Path("tree") / name
            target.parent.mkdir(parents=True, exist_ok=True)
            os.link(TREE / name, target) if os.stat(TREE).st_dev == os.stat(".").st_dev else (
                target.write_bytes((TREE / name).read_bytes()))
    result = subprocess.run(
        [sys.executable, "-m", "pip", "install", "--no-build-isolation", "--no-index", "--no-deps",
         "--target", "packages", "tree/src/python"], capture_output=True, text=True)
    assert result.returncode == 0, result.stdout[-3000:] + result.stderr[-3000:]
    assert ask(sys.executable, PYTHONPATH=str(Path("packages").resolve()))
