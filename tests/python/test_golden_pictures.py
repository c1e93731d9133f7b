"""The pytest plugin for pictures of any library: the fixture, and what marked tests return."""

import importlib.util
import os
import re
import xml.etree.ElementTree as xml
from pathlib import Path

import numpy as np
import pytest
from test_compare import png_of_piblocks
from test_golden import pytest_with_plugin

import piblocks

TEST = '''
import os
import numpy as np
import pytest

class Figure:
    def savefig(self, file, format):
        with open("given.png", "rb") as png:
            file.write(png.read())

def picture(level=LEVEL):
    made = np.full((20, 30, 3), 200, np.uint8)
    made[3:5, 4] = level
    return made

@pytest.mark.parametrize("size", [1, 2])
def test_array(piblocks_golden, size):
    piblocks_golden(np.repeat(picture(), size, axis=1), max_delta=2)

def test_several(piblocks_golden, tmp_path, monkeypatch):
    piblocks_golden(Figure())
    piblocks_golden("given.png", "file")
    monkeypatch.chdir(tmp_path)
    piblocks_golden(picture(0))
    piblocks_golden(picture(1), name="a/b c", dir="other")

class TestIn:
    @pytest.mark.piblocks_golden(max_delta=9)
    def test_marked(self):
        return picture()

    @pytest.mark.piblocks_golden(name="named")
    def test_named(self):
        return Figure()
'''


def run(*options, level=100, text=TEST, plugins=()):
    Path("test_plots.py").write_text(text.replace("LEVEL", str(level)))
    return pytest_with_plugin("-W", "error", *plugins, "test_plots.py", *options)


@pytest.fixture(autouse=True)
def given():
    Path("given.png").write_bytes(png_of_piblocks(np.full((4, 5), 9, np.uint8)))


def files(folder="golden"):
    return sorted(os.listdir(folder)) if os.path.exists(folder) else []


NAMES = ["named.png", "test_plots-TestIn.test_marked.png", "test_plots-test_array-1.png",
         "test_plots-test_array-2.png", "test_plots-test_several+3.png",
         "test_plots-test_several+file.png", "test_plots-test_several.png"]


def test_a_life_of_references():
    assert "5 passed" in run().stdout and not files(), "without an option pictures are only read"
    result = run("--piblocks-golden")
    assert "5 failed" in result.stdout and not files()
    assert "golden/test_plots-test_array-1.png: there is no reference\n" in result.stdout
    assert "--piblocks-golden-record keeps new references" in result.stdout
    assert "5 passed" in run("--piblocks-golden-record").stdout
    assert files() == NAMES
    [other] = files("other")
    assert other.startswith("test_plots-test_several+a_b_c~")
    assert Path("golden/test_plots-test_several+file.png").read_bytes() == Path(
        "given.png").read_bytes(), "files are kept as they are"
    assert "5 passed" in run("--piblocks-golden").stdout
    assert "5 passed" in run("--piblocks-golden", level=102).stdout, "within the tolerance"

    # Where there is a reference, recording compares.
    os.remove("golden/named.png")
    before = Path("golden/test_plots-test_array-1.png").read_bytes()
    result = run("--piblocks-golden-record", level=110)
    assert "3 failed, 2 passed" in result.stdout and files() == NAMES
    assert Path("golden/test_plots-test_array-1.png").read_bytes() == before

    result = run("--piblocks-golden-approve", "-rA", level=110)
    assert "5 passed" in result.stdout
    line = "golden/test_plots-test_array-1.png: replaced (2 pixels differ, largest delta 10 of 255"
    assert line in result.stdout and "golden/named.png: equal" in result.stdout
    assert "5 passed" in run("--piblocks-golden", level=110).stdout


def test_a_failure_says_what_and_shows_it():
    run("--piblocks-golden-record")
    result = run("--piblocks-golden", "--piblocks-golden-results", "results",
                 "--junitxml", "junit.xml", level=110)
    assert "3 failed, 2 passed" in result.stdout and "Traceback" not in result.stdout
    name = "test_plots-test_array-2"
    line = (f"golden/{name}.png: 4 pixels differ, largest delta 10 of 255, first at x=8 y=3 (red), "
            "densest 16x16 window at x=0 y=0: 4")
    assert line in result.stdout
    for kind in ("expected", "actual", "diff"):
        assert f"\n{kind}: results/{name}/{name}-{kind}.png\n" in result.stdout
    assert f"\npage: results/{name}.html\n" in result.stdout
    assert files("results") == sorted(
        one + end for one in ("test_plots-TestIn.test_marked", name, "test_plots-test_array-1")
        for end in ("", ".html"))
    shown = f"results/{name}/{name}"
    assert piblocks.compare(f"golden/{name}.png", f"{shown}-expected.png")
    failed = piblocks.compare(f"{shown}-expected.png", f"{shown}-actual.png")
    assert failed.different_pixels == 4 and failed.png() != b""
    assert "4 pixels differ" in Path(f"results/{name}.html").read_text()
    failures = {case.get("name"): case.find("failure") for case in xml.parse("junit.xml").iter("testcase")}
    assert line in failures["test_array[2]"].get("message")
    assert failures["test_several"] is None

    # What no longer differs leaves no pictures.
    assert "5 passed" in run("--piblocks-golden", "--piblocks-golden-results", "results").stdout
    assert not files("results")


def test_other_sizes_and_damage_are_failures():
    run("--piblocks-golden-record")
    name = "golden/test_plots-test_array-1.png"
    Path(name).write_bytes(png_of_piblocks(np.zeros((20, 31, 3), np.uint8)))
    Path("golden/test_plots-test_array-2.png").write_bytes(b"damaged")
    result = run("--piblocks-golden", "--piblocks-golden-results", "results")
    assert "2 failed, 3 passed" in result.stdout
    assert f"{name}: another size: 30x20 instead of 31x20\n" in result.stdout
    assert "test_array-2.png: png: cannot read" in result.stdout
    assert files("results/test_plots-test_array-1") == [
        "test_plots-test_array-1-actual.png", "test_plots-test_array-1-expected.png"]
    assert "5 passed" in run("--piblocks-golden-approve").stdout
    assert "5 passed" in run("--piblocks-golden").stdout


@pytest.mark.parametrize("action", ["", "-record", "-approve"])
def test_pictures_of_one_test_have_names_of_their_own(action):
    text = '''
import numpy as np

def test_it(piblocks_golden):
    piblocks_golden(np.zeros((2, 2), np.uint8), "a")
    piblocks_golden(np.ones((2, 2), np.uint8), "a")

def test_number(piblocks_golden):
    piblocks_golden(np.zeros((2, 2), np.uint8), "2")
    piblocks_golden(np.zeros((2, 2), np.uint8))
'''
    run("--piblocks-golden-record", text=text.replace("ones", "zeros").replace('"a")\n\n', '"b")\n\n'))
    result = run("--piblocks-golden" + action, text=text)
    assert "2 failed" in result.stdout
    assert "test_it has two pictures 'a'; give one another name" in result.stdout
    assert "test_number has two pictures '2'" in result.stdout


@pytest.mark.parametrize(
    "call, message",
    [
        ("picture / 255", r"UsageError: picture: samples are float64; of values from 0 to 1, give"),
        ("'no.png'", "FileNotFoundError|IoError: png: cannot read 'no.png'"),
        ("3", "TypeError: picture: must be an array"),
        ("picture, max_delta=300", "UsageError: max_delta 300: must be a number from 0 to 255"),
        ("picture, maxdelta=3", "TypeError: compare: there is no argument 'maxdelta'; use max_delta"),
        ("picture, masks=[(9, 9, 1, 1)]", "UsageError: compare: the mask 1x1.9.9 lies outside"),
        ("picture, name=3", "TypeError: name: must be a str, not int"),
    ],
)
@pytest.mark.parametrize("action", [(), ("--piblocks-golden-record",)])
def test_wrong_calls(call, message, action):
    result = run(*action, text=f'''
import numpy as np

def test_it(piblocks_golden):
    picture = np.zeros((2, 2), np.uint8)
    piblocks_golden({call})
''')
    assert "1 failed" in result.stdout and not files()
    assert re.search(message, result.stdout), result.stdout


@pytest.mark.parametrize(
    "mark, body, message",
    [
        ("frames=[0]", "return np.zeros((2, 2), np.uint8)", "has no argument 'frames' for a ndarray"),
        ("max_delta=3", "return piblocks.Scene(1)", "has no argument 'max_delta' for a Scene"),
        ("", "return None", "test_it returned NoneType; a test marked piblocks_golden returns a Scene "
                            "or a picture"),
        ("max_delta=300", "return np.zeros((2, 2), np.uint8)", "max_delta 300: must be a number"),
    ],
)
def test_wrong_marks(mark, body, message):
    result = run("--piblocks-golden-record", text=f'''
import numpy as np, piblocks, pytest

@pytest.mark.piblocks_golden({mark})
def test_it():
    {body}
''')
    assert "1 failed" in result.stdout and message in result.stdout, result.stdout


def test_marked_tests_do_not_share_references():
    result = run("--piblocks-golden-record", text='''
import numpy as np, pytest

@pytest.mark.piblocks_golden(name="same")
@pytest.mark.parametrize("level", [0, 1])
def test_it(level):
    return np.full((2, 2), level, np.uint8)
''')
    assert "1 failed, 1 passed" in result.stdout
    assert "golden/same' are those of test_plots.py::test_it[0] too" in result.stdout


def test_a_marked_test_and_its_fixture_do_not_share_a_reference():
    text = """
import numpy as np, pytest

@pytest.mark.piblocks_golden
def test_it(piblocks_golden):
    piblocks_golden(np.zeros((4, 5), np.uint8))
    return np.ones((4, 5), np.uint8)
"""
    failed = run("--piblocks-golden-approve", text=text)
    assert "are those of test_plots.py::test_it too" in failed.stdout
    assert "give test_plots.py::test_it, what it returns a name" in failed.stdout


@pytest.mark.parametrize("made", ["'nothing.png'", "b'no picture'", "bytearray(b'no picture')"])
def test_what_a_marked_test_returns_is_read_without_options(made):
    text = f"""
import pytest

@pytest.mark.piblocks_golden
def test_it():
    return {made}
"""
    assert "1 failed" in run(text=text).stdout


def test_a_reference_may_be_a_link_and_keeps_its_permissions():
    run("--piblocks-golden-record")
    name = "golden/test_plots-test_array-1.png"
    os.rename(name, "kept.png")
    os.chmod("kept.png", 0o640)
    os.symlink("../kept.png", name)
    assert "5 passed" in run("--piblocks-golden-approve", level=110).stdout
    assert os.path.islink(name) and os.stat("kept.png").st_mode & 0o777 == 0o640
    assert "5 passed" in run("--piblocks-golden", level=110).stdout


def test_several_processes():
    if importlib.util.find_spec("xdist") is None:  # imported, it could not be a plugin of the runs below
        pytest.skip("there is no pytest-xdist (python3-pytest-xdist)")
    text = TEST.replace("[1, 2]", "range(1, 30)")
    plugins = ("-p", "xdist", "-n", "2", "-W", "ignore::DeprecationWarning")
    assert "32 passed" in run("--piblocks-golden-record", text=text, plugins=plugins).stdout
    one = files()
    assert len(one) == 5 + 29
    results = ("--piblocks-golden-results", "results")
    assert "32 passed" in run("--piblocks-golden", *results, text=text).stdout
    assert "32 passed" in run("--piblocks-golden", *results, text=text, plugins=plugins).stdout
    result = run("--piblocks-golden", *results, level=110, text=text, plugins=plugins)
    assert "30 failed, 2 passed" in result.stdout and len(files("results")) == 60
    assert "page: results/test_plots-test_array-7.html" in result.stdout
    assert files() == one
    # Tests that share a name are found in every process, though each runs only some tests.
    shared = '''
import numpy as np, pytest

@pytest.mark.piblocks_golden(name="same")
@pytest.mark.parametrize("level", range(4))
def test_it(level):
    return np.full((2, 2), level, np.uint8)
'''
    result = run("--piblocks-golden-record", text=shared, plugins=plugins)
    assert "3 failed, 1 passed" in result.stdout, result.stdout


def test_figures_of_matplotlib():
    pytest.importorskip("matplotlib", reason="there is no matplotlib (python3-matplotlib)")
    text = '''
import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import pytest

def figure(top):
    made, axes = plt.subplots(figsize=(2, 1))
    axes.plot([1, 2, top])
    return made

@pytest.mark.piblocks_golden
def test_marked():
    return figure(LEVEL)

def test_closed():
    assert not plt.get_fignums()

def test_fixture(piblocks_golden):
    piblocks_golden(figure(3), max_pixels="0.1%")
'''
    ignored = ("-W", "ignore::DeprecationWarning")
    assert "3 passed" in run("--piblocks-golden-record", text=text, plugins=ignored).stdout
    assert "3 passed" in run("--piblocks-golden", text=text, plugins=ignored).stdout
    result = run("--piblocks-golden", text=text, level=4, plugins=ignored)
    assert "1 failed, 2 passed" in result.stdout and "pixels differ" in result.stdout
