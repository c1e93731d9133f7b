"""Films in a notebook: the page's player, or a slider."""

from __future__ import annotations

import base64
import os
import tempfile
from html import escape
from typing import TYPE_CHECKING, Any

from ._errors import Error, UsageError

if TYPE_CHECKING:
    from ._scene import Scene

_LONGER_SIDE = 960  # pixels: what a notebook has room for
_MOST_FRAMES = 20_000  # five and a half minutes; longer films are not rendered unasked
_MOST_UNASKED_BYTES = 8 << 20  # that are put into a notebook because a scene is its last line
_MOST_BYTES = 64 << 20  # that are put into a notebook at all
_CONTROLS_HEIGHT = 330  # pixels that the page needs beside its video

_TYPES = {
    ".mp4": "video/mp4",
    ".mov": "video/quicktime",
    ".webm": "video/webm",
    ".gif": "image/gif",
    ".apng": "image/apng",
    ".webp": "image/webp",
    ".wav": "audio/wav",
}


class Player:
    """A film that a notebook shows by its ``_repr_html_``."""

    def __init__(self, html: str, note: str = "") -> None:
        self.html = html
        #: Why it is a player and no slider, if a slider was asked for.
        self.note = note

    def _repr_html_(self) -> str:
        return f"<p>{escape(self.note)}</p>\n{self.html}" if self.note else self.html

    def __repr__(self) -> str:
        note = f": {self.note}" if self.note else ""
        return f"<piblocks.Player, {_megabytes(len(self.html))} for a notebook{note}>"


def _megabytes(size: int) -> str:
    return f"{size / 1e6:,.1f} MB"


def _data_url(data: bytes, kind: str) -> str:
    return f"data:{kind};base64,{base64.b64encode(data).decode()}"


# What is left of a frame in a notebook that is not trusted.
_UNTRUSTED = "Jupyter shows the film once you trust this notebook."


def _frame_of_page(page: str, width: int, height: int) -> str:
    # In a frame that may not fill the screen, Chromium does not play a film on a click.
    return (
        f'<iframe srcdoc="{escape(page, quote=True)}" sandbox="allow-scripts" allowfullscreen '
        f'title="piblocks" style="width: 100%; max-width: {width + 40}px; '
        f'height: {height + _CONTROLS_HEIGHT}px; border: 0">{_UNTRUSTED}</iframe>'
    )


def _media(data: bytes, kind: str) -> str:
    source = f'src="{_data_url(data, kind)}"'
    if kind.startswith("image/"):
        return f'<img {source} alt="film" style="max-width: 100%">'
    tag = kind.split("/")[0]
    return f'<{tag} {source} controls style="max-width: 100%"></{tag}>'


def _rendering(png: bytes) -> str:
    """How to scale a PNG file to a third of a notebook: pixels of small ones stay squares."""
    width = int.from_bytes(png[16:20], "big")
    return "pixelated" if width < _LONGER_SIDE // 3 else "auto"


def pictures_html(line: str, pictures: dict[str, bytes]) -> str:
    """A line and, side by side, PNG files by their captions, unless they are large."""
    text = f"<p>{escape(line)}</p>"
    size = sum(map(len, pictures.values()))
    if size > _MOST_UNASKED_BYTES:
        return text + f"\n<p>The pictures would add {_megabytes(size)} to the notebook.</p>"
    figures = "".join(
        '<figure style="flex: 1; margin: 0">'
        f'<img src="{_data_url(png, "image/png")}" alt="{caption}" '
        f'style="width: 100%; image-rendering: {_rendering(png)}">'
        f"<figcaption>{caption}</figcaption></figure>"
        for caption, png in pictures.items()
    )
    return f'{text}\n<div style="display: flex; gap: 8px">{figures}</div>'


def _require_embeddable(what: str, size: int) -> None:
    if size > _MOST_BYTES:
        raise UsageError(
            f"player: {what} has {_megabytes(size)}, and a notebook takes "
            f"{_megabytes(_MOST_BYTES)} at most; open the file by itself, or make it smaller"
        )


def _is_shown(ending: str) -> bool:
    return ending == ".html" or ending in _TYPES


def _embedded_file(path: str) -> str:
    ending = os.path.splitext(path)[1].lower()
    with open(path, "rb") as file:
        data = file.read()
    if ending == ".html":
        return _frame_of_page(data.decode(), _LONGER_SIDE, _LONGER_SIDE * 9 // 16)
    return _media(data, _TYPES[ending])


def file_html(path: str) -> str | None:
    """What a notebook shows for a file: the film, or the size of a large one; None if it cannot."""
    if not _is_shown(os.path.splitext(path)[1].lower()):
        return None
    try:
        size = os.path.getsize(path)
        if size <= _MOST_UNASKED_BYTES:
            return _embedded_file(path)
    except OSError:
        return None
    return (
        f"<p>{escape(path)} would add {_megabytes(size)} to the notebook. To embed it all the "
        "same, call <code>.player()</code> of this result.</p>"
    )


def file_player(path: str) -> Player:
    """The film of a file. Raises UsageError, OSError."""
    ending = os.path.splitext(path)[1].lower()
    if not _is_shown(ending):
        raise UsageError(f"player: a notebook cannot play '{path}'; write *.mp4 or *.html")
    _require_embeddable(f"'{path}'", os.path.getsize(path))
    return Player(_embedded_file(path))


def display_size(width: int, height: int) -> tuple[int, int]:
    """At most 960 pixels a side, of the same shape, and even, as videos need it."""
    scale = min(1, _LONGER_SIDE / max(width, height))
    return tuple(max(2, round(side * scale / 2) * 2) for side in (width, height))  # type: ignore


def _for_display(scene: Scene) -> Scene:
    """The scene as a notebook shows it: opaque, and of a size that it has room for."""
    width, height = display_size(*scene.size)
    keys: dict[str, Any] = {}
    if (width, height) != scene.size:
        keys["view_size"] = (width, height)
    if scene.is_transparent:
        keys["view_background"] = "opaque"
    return scene.replace(**keys) if keys else scene


def _rendered(scene: Scene, name: str) -> bytes:
    with tempfile.TemporaryDirectory(prefix="piblocks-") as folder:
        path = os.path.join(folder, name)
        scene.render(path)
        with open(path, "rb") as file:
            return file.read()


def _film_html(shown: Scene) -> str:
    """The film in the page's player."""
    return _frame_of_page(_rendered(shown, "film.html").decode(), *shown.size)


def player(scene: Scene) -> Player:
    """The film, however large. Raises UsageError."""
    html = _film_html(_for_display(scene))
    _require_embeddable("the film", len(html))
    return Player(html)


def _film_or_question(scene: Scene) -> str:
    shown = _for_display(scene)
    frames = shown.frames()
    size = f"{len(frames):,} frames"
    if len(frames) <= _MOST_FRAMES:
        html = _film_html(shown)
        if len(html) <= _MOST_UNASKED_BYTES:
            return html
        size += f", and would add {_megabytes(len(html))} to the notebook"
    return (
        f"<p>This film has {size}. To embed it all the same, call <code>.player()</code> of the "
        'scene; to write a file, <code>.render("film.mp4")</code>. Its last picture:</p>\n'
        + _media(frames.png(-1), "image/png")
    )


def scene_html(scene: Scene) -> str:
    """The film of a scene, or the size of a large one and how to embed it. A scene that cannot be
    shown says why."""
    try:
        return _film_or_question(scene)
    except Error as error:
        return f"<pre>{escape(repr(scene))}\n{escape(str(error))}</pre>"


def _problem_of_slider() -> str:
    """What is missing for a slider; empty if nothing is."""
    needs = "A slider needs ipywidgets 7 or later"
    remedy = "pip install 'ipywidgets>=7', and restart the kernel. Until then this is the player."
    try:
        import ipywidgets
    except ImportError:
        return f"{needs}, and there is none: {remedy}"
    # Older ones, such as Debian 12's, speak a protocol that Jupyter no longer understands.
    if int(ipywidgets.__version__.split(".")[0]) < 7:
        return f"{needs}, and this is {ipywidgets.__version__}: {remedy}"
    return ""


def slider(scene: Scene) -> Any:
    """A slider over all frames, with ipywidgets; without them a player that says what it needs."""
    problem = _problem_of_slider()
    if problem:
        return Player(scene_html(scene), problem)
    import ipywidgets

    return widget(scene, ipywidgets)


def widget(scene: Scene, ipywidgets: Any) -> Any:
    """A picture above a button to play and a slider."""
    shown = _for_display(scene)
    frames = shown.frames()
    last = len(frames) - 1
    image = ipywidgets.Image(format="png", value=frames.png(0), width=shown.size[0])
    position = ipywidgets.IntSlider(min=0, max=last, description="Frame")
    play = ipywidgets.Play(min=0, max=last, interval=max(1, round(1000 / frames.fps)))
    ipywidgets.jslink((play, "value"), (position, "value"))

    def show(change: Any) -> None:
        image.value = frames.png(change["new"])

    position.observe(show, names="value")
    return ipywidgets.VBox([image, ipywidgets.HBox([play, position])])
