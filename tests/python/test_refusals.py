"""What the command line refuses, the package refuses, in the same words.

The inputs are those of tests/cli/bad_input_test.cpp.
"""

import ast
import errno
import os
import pickle
import re
import subprocess

import pytest
from command_line import FLAG_OF, KEY_OF, NotTranslatable, call, keyword
from conftest import TREE

import piblocks
from piblocks._errors import _as_keywords

_STRING = r'"(?:[^"\\]|\\.)*"'
_BEFORE = {"render": ["render", "-o", "a.mp4"], "still": ["still", "-o", "a.png"]}


def _texts(source):
    """The string literals of C++, adjacent ones joined."""
    joined = re.findall(rf"{_STRING}(?:\s+{_STRING})*", source)
    return ["".join(ast.literal_eval(f"b{one}").decode("utf-8", "surrogateescape")
                    for one in re.findall(_STRING, text)) for text in joined]


def _inputs():
    """Arguments and scene file of every row of the table whose scene is a plain text."""
    source = (TREE / "tests/cli/bad_input_test.cpp").read_text()
    row = re.compile(
        rf"BadInput\{{(?:(render|still)\(\{{|\{{)((?:\s*{_STRING}\s*,?)*)\s*\}}\)?,"
        rf"((?:\s*{_STRING})+\s*)(?:,((?:\s*{_STRING})+\s*))?\}}"
    )
    for helper, arguments, _, scene in row.findall(source):
        scene_text = _texts(scene)[0] if scene else None
        yield _BEFORE.get(helper, []) + _texts(arguments), scene_text


def _name(one):
    return " ".join(one[0])[:60].encode("ascii", "backslashreplace").decode()


def _expected(line):
    """A line of the command line in the package's words: options are keywords."""
    line = line.removeprefix("piblocks: ")
    for option in re.findall(r"--[a-z]+(?:-[a-z]+)*", line):
        key = KEY_OF.get(option) or FLAG_OF.get(option, (None,))[0]
        is_origin = line.startswith(option + ":") or " both set " in line
        if key is not None and is_origin:
            line = line.replace(option, keyword(key), 1)
    return _as_keywords(line)


#: What differs because the package has no place for it, and why.
_ELSEWHERE = {
    "unknown option": "a keyword that there is not is a TypeError of Python",
    "unexpected argument": "Python checks how many arguments there are",
    "would write over": "standard output is the command line's",
    "does not fit in 64 bits": "the package has Python's ints there",
}


@pytest.mark.parametrize("arguments, scene", list(_inputs()), ids=map(_name, _inputs()))
def test_refused_in_the_same_words(arguments, scene):
    if scene is not None:
        with open("scene.toml", "w", encoding="utf-8", errors="surrogateescape") as file:
            file.write(scene)
    result = subprocess.run([os.environ["PIBLOCKS_PROGRAM"], *arguments], capture_output=True)
    assert result.returncode == 2
    said = result.stderr.decode("utf-8", "backslashreplace").splitlines()
    before = sorted(os.listdir())
    for words, reason in _ELSEWHERE.items():
        if words in said[0]:
            pytest.skip(reason)
    try:
        with pytest.raises(piblocks.UsageError) as raised:
            call(arguments)
    except NotTranslatable as reason:
        pytest.skip(f"of the command line alone: {reason}")
    except ValueError as error:
        if "invalid literal for int" in str(error):
            pytest.skip("Python has an int there")
        raise
    assert list(raised.value.problems) == [_expected(line) for line in said]
    assert sorted(os.listdir()) == before


def test_the_table_was_read():
    assert len(list(_inputs())) > 200


@pytest.mark.parametrize(
    "keys, message",
    [
        ({"view_siez": 3}, "scene: unknown key 'view_siez'; did you mean 'view_size'? "
                           "piblocks.keys() lists them"),
        ({"size": "640x360"}, "scene: unknown key 'size'; did you mean 'view_size' or "
                              "'golden_size'? piblocks.keys() lists them"),
        ({"view": {"siez": 3}}, "scene: unknown key 'view_siez'; did you mean 'view_size'? "
                                "piblocks.keys() lists them"),
        ({"quux": 1}, "scene: unknown key 'quux'; piblocks.keys() lists them"),
        ({"view_size": "1x1", "view": {"size": "2x2"}}, "view_size is given more than once"),
        ({"part": []}, "part: is empty; a storyboard has at least one part"),
        ({"part": [{"digits": 1}, {"digits": 0}]},
         "part:2: digits = 0: must be a whole number from 1 to 100000"),
        ({"part": [{"time": {"to": 0}}]}, "part:1: time_to = 0: must be after time_from = 0"),
        ({"part": [{"time_to": 1, "time": {"to": 2}}]}, "part[0]: time_to is given more than once"),
        ({"view_siez": None}, "scene: unknown key 'view_siez'; did you mean 'view_size'? "
                              "piblocks.keys() lists them"),
        ({"mass_ratio": -1}, "mass_ratio: red_mass = -1: must be greater than 0"),
        ({"mass_ratio": "x"}, "mass_ratio = x: not a number such as 16, 2.5, 1/3 or 1e6"),
        ({"time_hold_end": -1}, "time_hold_end = -1: must be at least 0"),
        ({"view": {"fps": 0.25, "shutter": 2}},
         "view_shutter = 2: must be from 0 (the instant alone) to 1 (all of the time to the next "
         "frame)"),
        ({"wall_face": 100},
         "scene: blue_position = 2: blue is left of the wall's face at 100; must be at least 201/2"),
        ({"time_from": 5, "time_to": 3}, "time_to = 3: must be after time_from = 5"),
    ],
)
def test_keys(keys, message):
    with pytest.raises(piblocks.SceneError) as raised:
        piblocks.Scene(**keys)
    assert str(raised.value) == message


@pytest.mark.parametrize(
    "value", [{1}, b"1", 1j, object(), [[1]], iter([1]), int], ids=lambda v: type(v).__name__
)
def test_a_wrong_type_is_named_with_its_key(value):
    with pytest.raises(TypeError, match="^view_fps: must be a number, a string"):
        piblocks.Scene(view_fps=value)


@pytest.mark.parametrize(
    "ask, error, message",
    [
        (lambda s: s.still(3), TypeError, "^file: must be a str or a path, not int"),
        (lambda s: s.still("a\0b.png"), ValueError, "has a null character"),
        (lambda s: s.still(""), ValueError, "still: '' has no known ending"),
        (lambda s: s.still("\ud800.png"), ValueError, "is not the name of a file"),
        (lambda s: s.still("-"), ValueError, "only for the command line"),
        (lambda s: s.render("-"), ValueError, "only for the command line"),
        (lambda s: s.render("a.mp4", progress=3), TypeError, "progress: must be callable"),
        (lambda s: s.render("a.mp4", smallest=1), TypeError, "smallest: must be True or False"),
        (lambda s: s.render("a.mp4", jobs={}), TypeError, "^jobs: must be"),
        (lambda s: s.state(None), TypeError, "^t: must be"),
        (lambda s: s.state(True), TypeError, "^t: must be"),
        (lambda s: s.state(float("inf")), ValueError, "^t inf: not a number"),
        (lambda s: s.state([0, float("nan")]), ValueError, "^t nan: not a number"),
        (lambda s: s.frame("x"), ValueError, "^t x: not a number"),
        (lambda s: s.log(last=1.5), TypeError, "^last: must be an int"),
        (lambda s: s.log(last=999), ValueError, "last 999: the scene has collisions 1 to 314"),
        (lambda s: s.log(engine=3), TypeError, "^engine: must be a str"),
        (lambda s: s.log(engine="x"), ValueError, "engine x: must be unfolded or events"),
        (lambda s: s.frames()[10**30], IndexError, "there is no number"),
        (lambda s: s.frames()["a"], TypeError, ""),
        (lambda s: s.golden_record("a/b", "c"), ValueError, "has a slash"),
    ],
)
def test_other_refusals(ask, error, message):
    scene = piblocks.Scene(view_size="64x36")
    with pytest.raises(error, match=message):
        ask(scene)
    assert os.listdir() == []


def test_messages_of_a_file_name_its_keys():
    with pytest.raises(piblocks.SceneError) as raised:
        piblocks.Scene.from_toml_text("view.fps = 0\nmass-ratio = -1\n", "talk", view_shutter=2)
    assert [problem.split(" = ")[0] for problem in raised.value.problems] == [
        "talk:2: red.mass", "talk:1: view.fps", "view_shutter"]


def test_every_option_of_a_scene_has_its_keyword():
    for option in {**KEY_OF, **FLAG_OF}:
        assert "--" not in _as_keywords(f"use {option} or leave it out"), option


@pytest.mark.parametrize(
    "ask, kind, filename",
    [
        (lambda: piblocks.Scene.from_toml("it's.toml"), piblocks.SceneError, "it's.toml"),
        (lambda: piblocks.Scene(show_logo="no.png").frame(), piblocks.IoError, "no.png"),
        (lambda: piblocks.Scene(show_logo="no.png").render("a.mp4"), piblocks.IoError, "no.png"),
        (lambda: piblocks.join(["no.mp4"], "a.mp4"), piblocks.UsageError, "no.mp4"),
    ],
)
def test_a_missing_file_is_pythons_error_too(ask, kind, filename):
    with pytest.raises(FileNotFoundError) as raised:
        ask()
    error = raised.value
    assert isinstance(error, kind) and isinstance(error, piblocks.Error)
    assert error.errno == errno.ENOENT and error.filename == filename
    assert str(error).endswith(f"'{filename}': No such file or directory")
    again = pickle.loads(pickle.dumps(error))
    assert type(again) is type(error) and again.errno == errno.ENOENT and str(again) == str(error)


def test_other_reasons_have_their_classes():
    os.mkdir("folder")
    with pytest.raises(IsADirectoryError):
        piblocks.Scene.from_toml("folder")
    with open("file", "w"):
        pass
    with pytest.raises(NotADirectoryError) as raised:
        piblocks.Scene(1, view_size="64x36").still("file/a.png")
    assert isinstance(raised.value, piblocks.UsageError)


def test_a_closed_file():
    with open("a.png", "wb") as file:
        pass
    with pytest.raises(ValueError, match="closed file"):
        piblocks.Scene(view_size="64x36").still(file)


def test_exceptions_are_those_of_python_too():
    assert issubclass(piblocks.UsageError, ValueError)
    assert issubclass(piblocks.SceneError, piblocks.UsageError)
    assert issubclass(piblocks.IoError, OSError)
    for name in ("UsageError", "SimulationError", "DrawError", "MediaError", "IoError"):
        assert issubclass(getattr(piblocks, name), piblocks.Error)


@pytest.mark.parametrize(
    "ask, words",
    [
        (lambda: piblocks.Scene(1, time_speed="1/10000").frames(),
         "narrow them with time_from and time_to, or raise time_speed"),
        (lambda: piblocks.Scene(10).log(),
         "narrow them with from_, to or first, or allow them with limit"),
        (lambda: piblocks.Scene(view_shutter=1, view_background="transparent"),
         "leave the shutter out, or use view_background='opaque'"),
        (lambda: piblocks.Scene().render("a.mp4", for_="web", smallest=True, crf=3),
         "smallest chooses the encoder and its settings; leave out crf"),
        (lambda: piblocks.Scene(show_title="--size")._script.count() and
         piblocks.Scene.shipped("--size"), "there is no scene '--size'"),
    ],
)
def test_messages_name_keywords(ask, words):
    with pytest.raises(piblocks.UsageError) as raised:
        ask()
    assert words in str(raised.value)
