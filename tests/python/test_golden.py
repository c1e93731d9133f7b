"""The pytest plugin for golden references."""

import os
import subprocess
import sys

import pytest

TEST = '''
import pytest
from piblocks import Scene

@pytest.fixture
def ratio():
    return RATIO

@pytest.mark.piblocks_golden(dir="golden", frames=[0, "turn"])
@pytest.mark.parametrize("size", ["64x36", "128x72"])
def test_turn(ratio, size):
    return Scene(mass_ratio=ratio, view_size=size, view_fps=5)

class TestNamed:
    @pytest.mark.piblocks_golden(name="named")
    def test_it(self):
        return Scene(1, view_size="64x36", view_fps=5)

def test_plain():
    pass
'''


def pytest_run(*options, ratio=16, text=TEST):
    with open("test_scenes.py", "w") as file:
        file.write(text.replace("RATIO", str(ratio)))
    return subprocess.run(
        [sys.executable, "-m", "pytest", "-p", "piblocks.pytest_plugin", "-p", "no:cacheprovider",
         "-W", "error", "test_scenes.py", *options],
        capture_output=True, text=True)


def test_a_life_of_references(program):
    result = pytest_run()
    assert "4 passed" in result.stdout and not os.path.exists("golden")
    result = pytest_run("--piblocks-golden")
    assert "3 failed, 1 passed" in result.stdout and "there is no reference" in result.stdout
    assert "4 passed" in pytest_run("--piblocks-golden-record").stdout
    assert sorted(os.listdir("golden")) == [
        "named-0.png", "named-last.png", "named.framehash",
        "test_turn-128x72-0.png", "test_turn-128x72-turn.png", "test_turn-128x72.framehash",
        "test_turn-64x36-0.png", "test_turn-64x36-turn.png", "test_turn-64x36.framehash"]
    assert "has references; replace them" in pytest_run("--piblocks-golden-record").stdout
    assert "4 passed" in pytest_run("--piblocks-golden").stdout

    result = pytest_run("--piblocks-golden", "--piblocks-golden-results", "results", ratio=100)
    assert "2 failed, 2 passed" in result.stdout
    assert "test_turn-64x36: different" in result.stdout and "pixels differ" in result.stdout
    assert "Traceback" not in result.stdout
    assert os.path.exists("results/test_turn-64x36.html")
    assert os.listdir("results/test_turn-64x36/test_turn-64x36-turn")
    assert not os.listdir("results/test_turn-64x36/test_turn-64x36-0"), "nothing differs there"

    assert "4 passed" in pytest_run("--piblocks-golden-approve", ratio=100).stdout
    assert "4 passed" in pytest_run("--piblocks-golden", ratio=100).stdout
    # The references are those of the command line.
    with open("named.toml", "w") as file:
        file.write('digits = 1\nview.size = "64x36"\nview.fps = 5\n')
    assert program("golden", "check", "named.toml", "--dir", "golden") == b"named: equal\n"


@pytest.mark.parametrize(
    "text, message",
    [
        ("@pytest.mark.piblocks_golden\ndef test_it():\n    return 3",
         "test_it returned int; a test marked piblocks_golden returns a Scene"),
        ("@pytest.mark.piblocks_golden(folder='x')\ndef test_it():\n    return piblocks.Scene(1)",
         "piblocks_golden has no argument 'folder'"),
        ("@pytest.mark.piblocks_golden\ndef test_it():\n    assert 1 == 2", "assert 1 == 2"),
    ],
)
def test_wrong_tests(text, message):
    result = pytest_run("--piblocks-golden", text="import piblocks, pytest\n" + text + "\n")
    assert "1 failed" in result.stdout and message in result.stdout


def test_actions_exclude_each_other():
    result = pytest_run("--piblocks-golden", "--piblocks-golden-record")
    assert result.returncode == 4 and "exclude each other" in result.stderr
