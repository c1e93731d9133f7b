"""Scenes: their keys, values, equality, text and copies."""

import copy
import os
import pickle
from decimal import Decimal
from fractions import Fraction

import numpy as np
import pytest

import piblocks
from piblocks import Scene

ARTICLE = Scene()


@pytest.mark.parametrize(
    "value, text",
    [
        (0.1, "1/10"), (np.float64(0.1), "1/10"), (np.float32(0.1), "1/10"), (1e-7, "1/10000000"),
        (Fraction(1, 3), "1/3"), (Decimal("1E+3"), "1000"), (Decimal("0.30"), "3/10"),
        (7, "7"), (np.int8(7), "7"), (np.uint64(2**63), str(2**63)), (np.array(7), "7"),
        ("1/3", "1/3"), ("100^7", str(100**7)), (10**5000, str(Decimal(10**5000))),
        (Fraction(1, 10**5000), "1/" + str(Decimal(10**5000))),
    ],
    ids=lambda value: type(value).__name__,
)
def test_numbers_are_exact(value, text):
    assert dict(Scene(red_mass=value)._description())[b"red.mass"].decode() == text


@pytest.mark.parametrize(
    "keys",
    [
        {"view": {"size": (640, 360)}}, {"view": {"size": "640x360"}}, {"view_size": [640, 360]},
        {"view_size": np.array([640, 360])}, {"view.size": "640x360"}, {"view": {"size": None,
         "fps": 60}, "view_size": "640x360"},
    ],
)
def test_a_dict_stands_for_the_keys_that_begin_with_its_name(keys):
    assert Scene(**keys) == Scene(view_size="640x360") != ARTICLE


def test_every_key_of_the_file_is_a_keyword():
    keys = piblocks.keys()
    assert {"digits", "mass_ratio", "base", "time_slow_motion", "golden_frames"} <= set(keys)
    described = {key.decode() for key, _ in ARTICLE._description()}
    assert {key.replace(".", "_").replace("-", "_") for key in described} <= set(keys)
    assert len(keys) == len(set(keys)) == len(described) + 3


@pytest.mark.parametrize(
    "keys",
    [
        {"wall_face": "1/2"}, {"time_loop": True}, {"sound_on": np.True_}, {"view_x": (-1, 3)},
        {"time_freeze": ["turn:2"]}, {"time_slow_motion": ["auto"]}, {"time_from": "turn-1"},
        {"show_overlays": ["energy", "time"]}, {"show_panels": "velocity,time"}, {"base": 2},
        {"red_width": "by-mass"}, {"show_title": 'a "b" \\ c'}, {"show_loupe": "auto"},
        {"golden_frames": [0, "last"]}, {"golden_size": "64x36"}, {"time_duration": 5},
        {"view_theme": "lecture", "view_shutter": 0}, {"view_theme": "lecture"},
        {"show_hits": False}, {"show_caption": "α, β"}, {"show_title": "30"},
        {"show_title": "true"}, {"show_overlays": []}, {"time_speed": 1e-300},
    ],
    ids=str,
)
def test_to_toml_reads_back_as_the_same(keys):
    scene = Scene(**keys)
    text = scene.to_toml()
    assert Scene.from_toml_text(text) == scene
    with open("a.toml", "w") as file:
        file.write(text)
    assert Scene.from_toml("a.toml") == scene
    assert scene == eval(repr(scene)) == pickle.loads(pickle.dumps(scene))


PARTS = [{"card": ["a'b", '\\ "é"'], "seconds": Fraction(1, 2)},
         {"compare": [{"digits": 1}, {"digits": "2"}], "time": {"to": 3}}]


@pytest.mark.parametrize(
    "scene, shown",
    [
        (Scene(3).replace(mass_ratio=16), "Scene(digits=3).replace(mass_ratio=16)"),
        (Scene(restitution=0.5).replace(wall_restitution=1, digits=2),
         "Scene(restitution='1/2').replace(wall_restitution=1, digits=2)"),
        (Scene(time_speed=2).replace(time_duration=3).replace(time_speed=1), None),
        (Scene.shipped("lecture").replace(view_theme=None, digits=4).replace(red_mass=3),
         "Scene.shipped('lecture').replace(view_theme=None, digits=4).replace(red_mass=3)"),
        (Scene(part=PARTS, view_fps=10).replace(view_size="64x36"), None),
        (Scene(part=PARTS).replace(part=PARTS[:1]), None),
        (Scene.from_toml_text("digits = 2 # 'a'\r\n", "part", base=3).replace(base=None), None),
        (Scene.from_toml_text("digits = 2", "lecture (shipped)"), None),
        (Scene.from_toml_text('show.title = "a"', "\udcff").replace(show_panels=[]), None),
    ],
    ids=lambda value: "",
)
def test_what_replace_makes_is_shown_as_it_is_made(scene, shown):
    assert eval(repr(scene)) == scene == pickle.loads(pickle.dumps(scene))
    assert repr(eval(repr(scene))) == repr(scene)
    assert shown is None or shown.replace("1/2", "0.5") == repr(scene)


def test_none_resets_to_the_default():
    assert Scene(view_theme="dark", digits=5).replace(view_theme=None, digits=None) == ARTICLE
    assert Scene(view_theme="dark", view_fps=3).replace(view=None) == ARTICLE
    assert Scene(view_fps=3).replace(view={"fps": None, "size": "64x36"}) == Scene(view_size="64x36")
    for scene in (Scene.shipped("lecture"), Scene.from_toml_text('[view]\ntheme = "dark"\n')):
        plain = scene.replace(view_theme=None)
        assert dict(plain._description())[b"view.theme"] == b"lecture-light"
        assert plain.replace(view_theme="print") == scene.replace(view_theme="print")
        assert dict(plain.replace(view_fps=7)._description())[b"view.theme"] == b"lecture-light"
    # Also of what the file sets by another key.
    lossy = Scene.from_toml_text("restitution = 0.5")
    assert lossy.replace(blocks_restitution=None) == Scene(wall_restitution=0.5)
    assert lossy.replace(blocks_restitution=None, wall_restitution=None) == ARTICLE
    assert lossy.replace(restitution=None) == ARTICLE
    assert Scene.from_toml_text("blocks.restitution = 0.5").replace(restitution=None) == ARTICLE
    for mass in ("digits = 5", "mass-ratio = 7", "red.mass = 7"):
        for key in ("digits", "mass_ratio", "red_mass"):
            assert Scene.from_toml_text(mass).replace(**{key: None}) == ARTICLE
    story = Scene(part=PARTS, view_fps=10)
    assert story.replace(part=None) == Scene(view_fps=10)
    with pytest.raises(piblocks.SceneError, match="^part: these parts are those of a scene file"):
        Scene.shipped("storyboard").replace(part=PARTS)
    # To a constructor it says nothing.
    assert Scene.shipped("lecture", view_theme=None) == Scene.shipped("lecture")


@pytest.mark.parametrize("name", piblocks.scenes())
def test_shipped_scenes(name):
    scene = Scene.shipped(name)
    assert Scene.from_toml_text(scene.to_toml()) == scene
    assert eval(repr(scene)) == scene == pickle.loads(pickle.dumps(scene))
    assert hash(scene) == hash(Scene.shipped(name))
    assert scene.is_storyboard == ("[[part]]" in scene.to_toml())
    if not scene.is_storyboard:
        assert isinstance(scene.count, int)
    else:
        with pytest.raises(piblocks.UsageError, match="is a storyboard; 'count' takes a scene"):
            scene.count


def test_a_storyboard_of_dicts():
    parts = [
        {"card": ["Counting π,", 'by "blocks"'], "seconds": 1},
        {"digits": 2, "fade": Fraction(1, 2), "time": {"hold-end": 1, "slow_motion": "auto"}},
        {"compare": [{"digits": 1}, {"digits": 2}], "split": "rows"},
    ]
    story = Scene(part=parts, view_size="320x180", view_fps=10)
    assert story.is_storyboard and story.size == (320, 180)
    assert Scene.from_toml_text(story.to_toml()) == story == pickle.loads(pickle.dumps(story))
    assert len(story.frames()) > 100
    with pytest.raises(piblocks.SceneError, match="^digits: 'part' is a storyboard; put digits"):
        Scene(part=parts, digits=3)


def test_keywords_win_over_a_file_and_over_older_ones():
    scene = Scene.shipped("lecture", view_theme="dark").replace(view_theme="print", digits=4)
    assert dict(scene._description())[b"view.theme"] == b"print"
    assert scene.count == 3141
    assert scene.replace(mass_ratio=1).count == 3


def test_a_logo_in_a_file_is_beside_it():
    os.mkdir("talk")
    ARTICLE.replace(view_size="64x36").still("talk/logo.png")
    with open("talk/a.toml", "w") as file:
        file.write('show.logo = "logo.png"\nview.theme = "lecture"\nview.size = "1280x720"\n')
    scene = Scene.from_toml("talk/a.toml")
    again = Scene.from_toml_text(scene.to_toml())
    assert (again.frame(1) == scene.frame(1)).all()
    for write in (scene.still, scene.render):
        with pytest.raises(piblocks.UsageError, match="would write over"):
            write("talk/logo.png" if write == scene.still else "talk/%d.png".replace("%d", "logo"))
    with pytest.raises(piblocks.UsageError, match="would write over the scene file"):
        os.rename("talk/a.toml", "talk/a.png")
        Scene.from_toml("talk/a.png").still("talk/a.png")


def test_copies_are_the_scene_itself():
    assert copy.copy(ARTICLE) is ARTICLE and copy.deepcopy(ARTICLE) is ARTICLE
    assert ARTICLE != 3 and ARTICLE != Scene(4) and len({ARTICLE, Scene(3), Scene(4)}) == 2
    assert len(pickle.dumps(ARTICLE)) < 300


def test_a_scene_cannot_be_changed():
    with pytest.raises(AttributeError):
        ARTICLE.count = 3
    with pytest.raises(AttributeError):
        ARTICLE.view_size = "1x1"


def test_a_file_that_is_no_scene():
    with open("a.toml", "wb") as file:
        file.write(b"digits = 0\nred.mas = 3\n\xff\n")
    with pytest.raises(piblocks.SceneError):
        Scene.from_toml("a.toml")
    with pytest.raises(piblocks.SceneError) as raised:
        Scene.from_toml_text("digits = 0\nred.mas = 3", "talk")
    assert raised.value.problems == (
        "talk:1: digits = 0: must be a whole number from 1 to 100000",
        "talk:2: red.mas: unknown key; did you mean 'red.mass'?",
    )
    assert pickle.loads(pickle.dumps(raised.value)).problems == raised.value.problems


def test_names_are_suggested():
    with pytest.raises(piblocks.UsageError, match="no scene 'lectur'; did you mean 'lecture'"):
        Scene.shipped("lectur")


def test_own_colors():
    scene = Scene(view={"background": "#FDF6E3", "colors": {"ink": "#073642"}}, red_color="#dc322f")
    assert scene == Scene(view_background="#fdf6e3", view_colors_ink="#073642", red_color="#dc322f")
    assert scene == Scene.from_toml_text(scene.to_toml()) == eval(repr(scene))
    assert scene.notes == () and tuple(scene.frame(0)[0, 0]) == (0xFD, 0xF6, 0xE3)
    (note,) = scene.replace(view_colors_accent="#ffffff").notes
    assert note.startswith("view.colors.accent = #ffffff: its contrast to the background #fdf6e3 is 1.0")
    assert scene.replace(view=None, red_color=None) == ARTICLE
    with pytest.raises(piblocks.SceneError, match="^view_colors_ink = red: must be a colour as"):
        scene.replace(view_colors_ink="red")


def test_notes_tell_of_conventions():
    corner = Scene(blue_position=0.5, red_mass=100, red_position=3)
    assert len(corner.notes) == 1 and "by convention" in corner.notes[0]
    assert ARTICLE.notes == ()
    assert any("collide at once" in note for note in Scene.shipped("rack").notes)
    assert Scene.shipped("gas").notes == ()
