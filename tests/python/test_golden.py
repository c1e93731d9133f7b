"""The pytest plugin for golden references."""

import os
import sys
from types import SimpleNamespace

import pytest

from piblocks import Scene

TEST = '''
import pytest
from piblocks import Scene

@pytest.fixture
def ratio():
    return RATIO

@pytest.mark.piblocks_golden(dir="golden", frames=[0, "turn"])
@pytest.mark.parametrize("size", ["64x36", "128x72"])
def test_turn(ratio, size):
    return Scene(mass_ratio=ratio, view_size=size, view_fps=5, view_theme="article")

class TestNamed:
    @pytest.mark.piblocks_golden(name="named")
    def test_it(self):
        return Scene(1, view_size="64x36", view_fps=5)

def test_plain():
    pass
'''


def pytest_with_plugin(*arguments, folder="."):
    """Runs pytest in a copy of this process, since it takes most of its time to import NumPy and itself.
    Returns its result, and what it says."""
    with open("said.txt", "w+") as said:
        child = os.fork()
        if child == 0:
            result = 1
            try:
                sys.stdout = sys.stderr = said
                os.dup2(said.fileno(), 1)
                os.dup2(said.fileno(), 2)
                os.chdir(folder)
                sys.path.insert(0, os.getcwd())  # as python -m pytest
                result = pytest.main(["-p", "piblocks.pytest_plugin", "-p", "no:cacheprovider", *arguments])
                said.flush()
            finally:
                os._exit(result)
        _, status = os.waitpid(child, 0)
        said.seek(0)
        return SimpleNamespace(returncode=os.waitstatus_to_exitcode(status), stdout=said.read())


def pytest_run(*options, ratio=16, text=TEST):
    with open("test_scenes.py", "w") as file:
        file.write(text.replace("RATIO", str(ratio)))
    return pytest_with_plugin("-W", "error", "test_scenes.py", *options)


def test_a_life_of_references(program):
    result = pytest_run()
    assert "4 passed" in result.stdout and not os.path.exists("golden")
    result = pytest_run("--piblocks-golden")
    assert "3 failed, 1 passed" in result.stdout and "no references in" in result.stdout
    assert "--piblocks-golden-record keeps new references" in result.stdout
    assert "4 passed" in pytest_run("--piblocks-golden-record").stdout
    turn = "test_scenes-test_turn-"
    assert sorted(os.listdir("golden")) == [
        "named-0.png", "named-last.png", "named.framehash",
        turn + "128x72-0.png", turn + "128x72-turn.png", turn + "128x72.framehash",
        turn + "64x36-0.png", turn + "64x36-turn.png", turn + "64x36.framehash"]
    assert "4 passed" in pytest_run("--piblocks-golden").stdout
    # Where there are references, recording compares; what is missing is added.
    os.remove(f"golden/{turn}64x36-0.png")
    assert "4 passed" in pytest_run("--piblocks-golden-record").stdout
    assert os.path.exists(f"golden/{turn}64x36-0.png")
    assert "2 failed, 2 passed" in pytest_run("--piblocks-golden-record", ratio=100).stdout

    result = pytest_run("--piblocks-golden", "--piblocks-golden-results", "results", ratio=100)
    assert "2 failed, 2 passed" in result.stdout
    assert f"{turn}64x36: different" in result.stdout and "pixels differ" in result.stdout
    assert "Traceback" not in result.stdout
    assert os.path.exists(f"results/{turn}64x36.html")
    pictures = os.listdir(f"results/{turn}64x36")
    for name in (f"{turn}64x36-turn-expected.png", f"{turn}64x36-turn-diff.png", "frame-000020-actual.png"):
        assert name in pictures
    assert f"{turn}64x36-0-diff.png" not in pictures, "nothing differs there"

    assert "4 passed" in pytest_run("--piblocks-golden-approve", ratio=100).stdout
    results = ("--piblocks-golden-results", "results")
    assert "4 passed" in pytest_run("--piblocks-golden", *results, ratio=100).stdout
    assert not os.path.exists(f"results/{turn}64x36.html"), "the page of an earlier failure"
    # The references are those of the command line.
    with open("named.toml", "w") as file:
        file.write('digits = 1\nview.size = "64x36"\nview.fps = 5\n')
    assert program("golden", "check", "named.toml", "--dir", "golden") == b"named: equal\n"


def test_a_result_is_true_or_false_and_says_why():
    scene = Scene(2, view_size="64x36", view_fps=5, golden_frames=[0, "last"])
    other = scene.replace(red_mass=101, time_to=5)
    missing = scene.golden_check("a", "golden")
    assert not missing and missing.outcome == "no references" and "no references" in str(missing)
    recorded = scene.golden_record("a", "golden")
    assert recorded and recorded.outcome == "recorded" and str(recorded) == "a: recorded"
    kept = scene.golden_record("a", "golden")
    assert kept and kept.outcome == "kept" and kept.lines[0].startswith("a: has references")
    equal = scene.golden_check("a", "golden")
    assert equal and equal.ok and equal.outcome == "equal" and equal.lines == ("a: equal",)
    with pytest.raises(AssertionError, match="GoldenResult different: a.framehash: frames"):
        assert other.golden_check("a", "golden"), repr(other.golden_check("a", "golden"))
    os.remove("golden/a-0.png")
    incomplete = scene.golden_check("a", "golden")
    assert not incomplete and incomplete.outcome == "incomplete"
    refused = other.golden_record("a", "golden")
    assert not refused and refused.outcome == "not recorded" and not os.path.exists("golden/a-0.png")
    assert other.golden_approve("a", "golden").outcome == "replaced"
    assert other.golden_check("a", "golden")
    with open("golden/a-0.png", "w") as file:
        file.write("damaged")
    assert other.golden_check("a", "golden").outcome == "unreadable"


NAMES = """
import pytest
from piblocks import Scene

def scene(k):
    return Scene(mass_ratio=k, view_size="64x36", view_fps=5, time_to=1)

@pytest.mark.piblocks_golden
@pytest.mark.parametrize("k, text", enumerate(
    ["1/2", "1-2", "1_2", "1:2", "", " ", "a b", "a  b", "\\u00e9", "\\u00e8", "-", "[", "x" * 300, "x" * 301]),
    ids=lambda value: value if isinstance(value, str) else "n")
def test_turn(k, text):
    return scene(k + 1)

@pytest.mark.piblocks_golden
def test_turn_n():
    return scene(50)

class Test_turn:
    @pytest.mark.piblocks_golden
    def test_turn(self):
        return scene(51)
"""


def test_every_test_has_references_of_its_own():
    """Also in modules and folders of the same names, and wherever pytest is started."""
    os.makedirs("a/b")
    for file in ("a/test_x.py", "a/test_y.py", "a/b/test_x.py", "a/test-x.py"):
        with open(file, "w") as out:
            out.write(NAMES.replace("piblocks_golden", "piblocks_golden(dir='ROOT/golden')").replace(
                "ROOT", os.getcwd()))

    def run(folder, *arguments):
        result = pytest_with_plugin("--import-mode=importlib", *arguments, folder=folder)
        assert result.returncode == 0, result.stdout
        return len([file for file in os.listdir("golden") if file.endswith(".framehash")])

    files = ["test_x.py", "test_y.py", "b/test_x.py", "test-x.py"]
    assert run("a", "--piblocks-golden-record", *files) == 4 * 16
    assert run(".", "--piblocks-golden", *[f"a/{file}" for file in files]) == 4 * 16
    assert run("a/b", "--piblocks-golden", "test_x.py") == 4 * 16
    plain = [name for name in os.listdir("golden") if "~" not in name]
    assert "a.b.test_x-Test_turn.test_turn.framehash" in plain
    assert "a.test_y-test_turn_n.framehash" in plain


@pytest.mark.parametrize(
    "first, second, path",
    [
        ("name='same'", "name='same'", "same"),
        ("name='a', frames=['turn-1']", "name='a-turn', frames=['1']", "a-turn-1.png"),
    ],
)
@pytest.mark.parametrize("action", ["", "-record", "-approve"])
def test_two_tests_do_not_share_references(first, second, path, action):
    text = f"""
import pytest
from piblocks import Scene

@pytest.mark.piblocks_golden({first})
def test_one():
    return Scene(1, view_size="64x36", view_fps=5)

@pytest.mark.piblocks_golden({second})
def test_two():
    return Scene(2, view_size="64x36", view_fps=5)
"""
    result = pytest_run("--piblocks-golden" + action, text=text)
    assert f"golden/{path}' are those of test_scenes.py::test_one too" in result.stdout
    assert result.returncode == 1 and "give test_scenes.py::test_two a name" in result.stdout


@pytest.mark.parametrize(
    "text, message",
    [
        ("@pytest.mark.piblocks_golden\ndef test_it():\n    return 3",
         "test_it returned int; a test marked piblocks_golden returns a Scene or a picture"),
        ("@pytest.mark.piblocks_golden(folder='x')\ndef test_it():\n    return piblocks.Scene(1)",
         "piblocks_golden has no argument 'folder' for a Scene"),
        ("@pytest.mark.piblocks_golden\ndef test_it():\n    assert 1 == 2", "assert 1 == 2"),
    ],
)
def test_wrong_tests(text, message):
    result = pytest_run("--piblocks-golden", text="import piblocks, pytest\n" + text + "\n")
    assert "1 failed" in result.stdout and message in result.stdout


def test_actions_exclude_each_other():
    result = pytest_run("--piblocks-golden", "--piblocks-golden-record")
    assert result.returncode == 4 and "exclude each other" in result.stdout
