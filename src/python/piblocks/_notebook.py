"""Films in a notebook: the page's player, or a slider."""

from __future__ import annotations

import base64
import os
import tempfile
from html import escape
from typing import TYPE_CHECKING, Any

from ._errors import Error

if TYPE_CHECKING:
    from ._scene import Scene

_LONGER_SIDE = 960  # pixels: what a notebook has room for
_MOST_FRAMES = 20_000  # five and a half minutes; longer films are shown as a picture
_MOST_BYTES = 64 << 20  # of a file that is put into a notebook
_CONTROLS_HEIGHT = 330  # pixels that the page needs beside its video

_TYPES = {
    ".mp4": "video/mp4",
    ".mov": "video/quicktime",
    ".webm": "video/webm",
    ".gif": "image/gif",
    ".apng": "image/apng",
    ".wav": "audio/wav",
}


class Player:
    """A film that a notebook shows by its ``_repr_html_``."""

    def __init__(self, html: str) -> None:
        self.html = html

    def _repr_html_(self) -> str:
        return self.html


def _data_url(data: bytes, kind: str) -> str:
    return f"data:{kind};base64,{base64.b64encode(data).decode()}"


def _frame_of_page(page: str, width: int, height: int) -> str:
    return (
        f'<iframe srcdoc="{escape(page, quote=True)}" sandbox="allow-scripts" '
        f'title="piblocks" style="width: 100%; max-width: {width + 40}px; '
        f'height: {height + _CONTROLS_HEIGHT}px; border: 0"></iframe>'
    )


def _media(data: bytes, kind: str) -> str:
    source = f'src="{_data_url(data, kind)}"'
    if kind.startswith("image/"):
        return f'<img {source} alt="film" style="max-width: 100%">'
    tag = kind.split("/")[0]
    return f'<{tag} {source} controls style="max-width: 100%"></{tag}>'


def file_html(path: str) -> str | None:
    """What a notebook shows for a file; None if it has no way to, or the file is very large."""
    ending = os.path.splitext(path)[1].lower()
    try:
        if os.path.getsize(path) > _MOST_BYTES:
            return None
        with open(path, "rb") as file:
            data = file.read()
    except OSError:
        return None
    if ending == ".html":
        return _frame_of_page(data.decode(), _LONGER_SIDE, _LONGER_SIDE * 9 // 16)
    kind = _TYPES.get(ending)
    return None if kind is None else _media(data, kind)


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


def film_html(scene: Scene) -> str:
    """The film in the page's player; a storyboard as a video; a very long film as a picture."""
    shown = _for_display(scene)
    if len(shown.frames()) > _MOST_FRAMES:
        return _media(shown.frames().png(-1), "image/png")
    if scene.is_storyboard:
        return _media(_rendered(shown, "film.mp4"), "video/mp4")
    return _frame_of_page(_rendered(shown, "film.html").decode(), *shown.size)


def scene_html(scene: Scene) -> str:
    """As film_html(). A scene that cannot be shown says why."""
    try:
        return film_html(scene)
    except Error as error:
        return f"<pre>{escape(repr(scene))}\n{escape(str(error))}</pre>"


def slider(scene: Scene) -> Any:
    """A slider over all frames, with ipywidgets; without them the page's player."""
    try:
        import ipywidgets
    except ImportError:
        return Player(film_html(scene))
    # Older ones, such as Debian 12's, speak a protocol that Jupyter no longer understands.
    if int(ipywidgets.__version__.split(".")[0]) < 7:
        return Player(film_html(scene))
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
