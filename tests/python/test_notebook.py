"""Notebooks: what a scene shows there, and the notebook of the project."""

import base64
import builtins
import html
import importlib.util
import re

import pytest
from conftest import TREE, bytes_of

import piblocks
from piblocks import Scene

NOTEBOOK = TREE / "assets/notebooks/pi-from-blocks.ipynb"
SMALL = Scene(1, view_size="128x72", view_fps=5)
NO_WIDGETS = "there is no ipywidgets (python3-ipywidgets)"


def test_a_scene_shows_the_page():
    story = Scene(part=[{"digits": 1, "time_duration": 1}], view_size="128x72")
    for film in (SMALL, story):
        shown = film._repr_html_()
        assert shown.startswith('<iframe srcdoc="') and 'sandbox="allow-scripts"' in shown
        # All that Jupyter leaves of it in a notebook that is not trusted.
        assert re.sub("<[^>]*>", "", shown) == "Jupyter shows the film once you trust this notebook."
        page = html.unescape(re.search(r'srcdoc="([^"]*)"', shown)[1])
        film.render("a.html")
        assert page == open("a.html").read()


@pytest.mark.parametrize(
    "size, shown",
    [("1920x1080", (960, 540)), ("1080x1920", (540, 960)), ("127x71", (128, 72)),
     ("128x72", (128, 72)), ("16384x2", (960, 2))],
)
def test_of_a_size_that_a_notebook_has_room_for(size, shown):
    from piblocks._notebook import display_size

    width, height = size.split("x")
    assert display_size(int(width), int(height)) == shown


def test_what_no_page_shows():
    transparent = SMALL.replace(view_background="transparent")
    assert transparent._repr_html_().startswith("<iframe")
    long = SMALL.replace(time_speed="1/200", view_fps=60)
    asked = long._repr_html_()
    assert "78,001 frames. To embed it all the same, call" in asked and "<img" in asked
    wrong = SMALL.replace(time_from="#99")
    assert "the scene has collisions" in wrong._repr_html_()


def test_what_was_rendered_is_shown():
    for name, start in (("a.mp4", "<video"), ("a.gif", "<img"), ("a.webp", "<img"), ("a.html", "<iframe"),
                        ("a.wav", "<audio")):
        rendered = SMALL.render(name)
        assert rendered._repr_html_().startswith(start)
    data = re.search(r"base64,([^\"]*)", SMALL.render("a.mp4")._repr_html_())[1]
    assert base64.b64decode(data) == bytes_of("a.mp4")
    assert SMALL.render("a.framehash")._repr_html_() is None
    assert SMALL.render("null")._repr_html_() is None


def test_a_large_film_is_embedded_when_it_is_asked_for(monkeypatch):
    story = Scene(part=[{"digits": 1, "time_duration": 1}], view_size="128x72")
    films = [SMALL.render("a.mp4"), SMALL.render("a.gif"), SMALL, story]
    whole = [film._repr_html_() for film in films]
    monkeypatch.setattr("piblocks._notebook._MOST_UNASKED_BYTES", 1000)
    for film, before in zip(films, whole):
        asked = film._repr_html_()
        assert re.search(r"would add \d+\.\d MB to the notebook", asked)
        assert ".player()" in asked and "<iframe" not in asked and "<video" not in asked
        assert film.player()._repr_html_() == before
    monkeypatch.setattr("piblocks._notebook._MOST_BYTES", 1000)
    for film in films:
        with pytest.raises(piblocks.UsageError, match="and a notebook takes 0.0 MB at most"):
            film.player()
    with pytest.raises(piblocks.UsageError, match="a notebook cannot play 'a.framehash'"):
        SMALL.render("a.framehash").player()


def test_a_slider_over_exact_frames():
    ipywidgets = pytest.importorskip("ipywidgets", reason=NO_WIDGETS)
    from piblocks._notebook import widget

    image, controls = widget(SMALL, ipywidgets).children
    play, slider = controls.children
    frames = SMALL.frames()
    assert slider.max == play.max == len(frames) - 1 and image.value == frames.png(0)
    for number in (3, len(frames) - 1, 1):
        slider.value = number
        assert image.value == frames.png(number)


@pytest.mark.parametrize("version, is_widget", [("6.0.0", False), ("8.1.5", True)])
def test_old_widgets_are_not_used(monkeypatch, version, is_widget):
    ipywidgets = pytest.importorskip("ipywidgets", reason=NO_WIDGETS)
    monkeypatch.setattr(ipywidgets, "__version__", version)
    shown = SMALL.animate()
    assert isinstance(shown, piblocks.Player) == (not is_widget)
    if not is_widget:
        assert f"needs ipywidgets 7 or later, and this is {version}" in shown._repr_html_()


def test_without_ipywidgets_it_is_the_player(monkeypatch):
    real = builtins.__import__

    def importing(name, *rest):
        if name == "ipywidgets":
            raise ImportError(name)
        return real(name, *rest)

    monkeypatch.setattr(builtins, "__import__", importing)
    player = SMALL.animate()
    assert isinstance(player, piblocks.Player)
    assert player._repr_html_().endswith(SMALL._repr_html_())
    for said in (player._repr_html_(), repr(player)):
        assert "needs ipywidgets 7 or later, and there is none" in html.unescape(said)


def test_the_notebook_has_no_outputs():
    import json

    for cell in json.loads(NOTEBOOK.read_text())["cells"]:
        assert not cell.get("outputs") and not cell.get("execution_count")


def test_the_notebook_runs():
    for module in ("nbclient", "nbformat", "ipykernel"):
        if importlib.util.find_spec(module) is None:
            pytest.skip(f"there is no {module} (python3-{module})")
    import nbclient
    import nbformat

    notebook = nbformat.read(NOTEBOOK, 4)
    nbclient.NotebookClient(notebook, timeout=120, kernel_name="python3").execute()
    text = "".join(
        str(output.get("text", "")) + str(output.get("data", {}))
        for cell in notebook.cells if cell.cell_type == "code" for output in cell.outputs)
    assert "[3, 31, 314]" in text and "31415926535897932384" in text
    assert text.count("<iframe srcdoc") >= 2, "a scene and a storyboard"
    assert "tiny: recorded" in text and "tiny: equal" in text and "tiny: different: " in text
