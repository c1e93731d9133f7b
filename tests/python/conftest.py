"""What the tests of the Python package share: the program, and a small scene."""

import os
import subprocess
import sys
import threading
from pathlib import Path

import pytest

TREE = Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(Path(__file__).resolve().parent))


def in_threads(work, places):
    """Calls work(place) for all places, each in a thread of its own, until all have ended."""
    threads = [threading.Thread(target=work, args=(place,)) for place in places]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()


def resident_bytes():
    return int(Path("/proc/self/statm").read_text().split()[1]) * 4096


def bytes_of(file):
    return Path(file).read_bytes()


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
