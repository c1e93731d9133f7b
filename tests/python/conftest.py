"""What the tests of the Python package share: the program, and a small scene."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

TREE = Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(Path(__file__).resolve().parent))


@pytest.fixture(autouse=True)
def in_empty_folder(tmp_path, monkeypatch):
    """Each test has an empty folder, in which it and the program run."""
    monkeypatch.chdir(tmp_path)


@pytest.fixture
def program():
    """Runs the program; returns what it says on standard output, as bytes."""

    def run(*arguments, check=True):
        result = subprocess.run(
            [os.environ["PIBLOCKS_PROGRAM"], *arguments], capture_output=True, timeout=120
        )
        assert not check or result.returncode == 0, result.stderr.decode()
        return result if not check else result.stdout

    return run
