"""Films in browsers: slides of reveal.js, pages, and a notebook.

In: a visit. Out: what was seen.
"""

import contextlib
import json
import os
import pathlib
import secrets
import shutil
import socket
import subprocess
import sys
import time

HERE = pathlib.Path(__file__).resolve().parent
sys.path += [str(HERE.parent), str(HERE.parent.parent / "h264" / "decoders")]
from browser import Browser, browsing
from destination import SHOTS, Destination, require, require_share, version
from firefox import Firefox

WINDOWS = ((1280, 720), (1024, 768), (1920, 1080))
DECK = """<!doctype html><html><head><meta charset="utf-8">
<link rel="stylesheet" href="../dist/reveal.css"><link rel="stylesheet" href="../dist/theme/white.css">
</head><body><div class="reveal"><div class="slides"><section><h2>First</h2></section>
%s</div></div><script src="../dist/reveal.js"></script>
<script>Reveal.initialize({transition: "none"});</script></body></html>"""
ON_SLIDE = "document.querySelector('section.present video')"


def wait_until(browser, script, seconds=10):
    deadline = time.monotonic() + seconds
    while not browser.value(script):
        if time.monotonic() > deadline:
            return False
        time.sleep(0.05)
    return True


def wait_until_listening(port, seconds):
    deadline = time.monotonic() + seconds
    while time.monotonic() < deadline:
        with contextlib.suppress(OSError), socket.create_connection(("127.0.0.1", port)):
            return True
        time.sleep(0.1)
    return False


def share_in_window(browser, video):
    """How much of the window's width or height it takes, whichever is more. Raises Wrong if a part is outside."""
    left, top, width, height, wide, high = browser.value(f"""new Promise(resolve => setTimeout(() => {{
        const r = {video}.getBoundingClientRect();
        resolve([r.x, r.y, r.width, r.height, innerWidth, innerHeight]); }}, 300))""")
    require(f"a video at {left}, {top} of {width}x{height} lies in a window of {wide}x{high}",
            left >= 0 and top >= 0 and left + width <= wide and top + height <= high)
    return max(width / wide, height / high)


class Reveal(Destination):
    """As large as fits, plays when the slide is shown, has captions, and each shot stays until a key is pressed."""

    def __init__(self, program, browser, *options):
        self.id, self.name = f"reveal-{program.split('-')[0]}", f"reveal.js in {program.split('-')[0].capitalize()}"
        self.programs = {program: program}
        self._browser, self._options = browser, options

    def _reveal(self):
        return pathlib.Path(os.environ.get("PIBLOCKS_REVEAL", "/nowhere"))

    def missing(self):
        if not (self._reveal() / "dist" / "reveal.js").exists():
            return "reveal.js, whose folder PIBLOCKS_REVEAL names"
        return super().missing()

    def versions(self):
        [program] = self.programs
        return [f"reveal.js {json.loads((self._reveal() / 'package.json').read_text())['version']}",
                f"{program.split('-')[0].capitalize()} {version(program, '--version')}"]

    def look(self, visit):
        shutil.copytree(self._reveal() / "dist", visit.folder / "dist")
        film, story = visit.film(), visit.story()
        for folder in (film, story):
            (folder / "deck.html").write_text(DECK % (folder / "reveal.html").read_text())
        with browsing(self._browser, *self._options) as (browser, _):
            share = min(self._look_at_film(browser, film, window) for window in WINDOWS)
            share = min(share, self._look_at_shots(browser, story, visit))
        return f"{share:.2f}; each of {len(SHOTS)} shots plays by itself, with captions, then waits for a key"

    def _look_at_film(self, browser, film, window):
        what = f"in {window[0]}x{window[1]}"
        browser.resize(*window)
        browser.show_address((film / "deck.html").as_uri())
        browser.press("ArrowRight", 39)
        share = share_in_window(browser, ON_SLIDE)
        require_share(what, share)
        expected = (film / "captions.vtt").read_text().count(" --> ")
        browser.value(f"{ON_SLIDE}.textTracks[0].mode = 'showing'")
        require(f"{what}: {expected} captions", wait_until(
            browser, f"({ON_SLIDE}.textTracks[0].cues?.length ?? 0) === {expected}"))
        require(f"{what}: plays", browser.value(
            f"""new Promise(resolve => {{ const video = {ON_SLIDE};
                const begin = video.currentTime;
                setTimeout(() => resolve(!video.paused && video.currentTime > begin), 700); }})"""))
        return share

    def _look_at_shots(self, browser, story, visit):
        browser.resize(*WINDOWS[0])
        browser.show_address((story / "deck.html").as_uri())
        least = 1
        for shot in SHOTS:
            what = f"shot {shot}"
            browser.press("ArrowRight", 39)
            share = share_in_window(browser, ON_SLIDE)
            require_share(what, share)
            least = min(least, share)
            browser.value(f"{ON_SLIDE}.textTracks[0].mode = 'showing'")
            require(f"{what}: ends", wait_until(browser, f"{ON_SLIDE}.ended"))
            time.sleep(0.5)
            require(f"{what}: stays, with its last caption", browser.value(
                f"[Reveal.getIndices().h, {ON_SLIDE}.ended, {ON_SLIDE}.currentSrc.split('/').pop(), "
                f"{ON_SLIDE}.textTracks[0].activeCues.length]"), [shot, True, f"pi-{shot:02}.mp4", 1])
            visit.keep_picture(f"{self.id}-{shot}", lambda file: browser.save_picture("document.documentElement", file))
        return least


class PageInFrame:
    """The page that is the only frame in another page."""

    def __init__(self, browser):
        self._browser = browser
        frame = browser.call("Page.getFrameTree")["frameTree"]["childFrames"][0]["frame"]["id"]
        self._context = next(event["params"]["context"]["id"] for event in reversed(browser.events)
                             if event["method"] == "Runtime.executionContextCreated"
                             and event["params"]["context"]["auxData"]["frameId"] == frame)

    def value(self, script):
        return self._browser.call("Runtime.evaluate", expression=script, contextId=self._context,
                                  returnByValue=True)["result"].get("value")


class Page(Destination):
    """A page with the film in it: no part of the film is outside the window, and a click plays it to its end."""

    id, name = "page", "page in Chromium"
    programs = {"chromium": "chromium"}

    def versions(self):
        return [f"Chromium {version('chromium', '--version')}"]

    def look(self, visit):
        visit.render(visit.write_story(), "-o", "page.html")
        with browsing(Browser) as (browser, _):
            browser.resize(*WINDOWS[0])
            browser.show(visit.folder / "page.html")
            require("the film is there", wait_until(browser, "video.readyState >= 2"))
            share = share_in_window(browser, "video")
            require("waits", browser.value("video.paused && video.currentTime === 0"))
            browser.click("video")
            require("ends", wait_until(browser, "video.ended"))
            visit.keep_picture(self.id, lambda file: browser.save_picture("document.documentElement", file))
        return f"{share:.2f}; a click plays it to its end"


class Notebook(Destination):
    """What a notebook shows for a scene: the page, in a frame that is as wide as the notebook."""

    id, name = "jupyter", "Jupyter Notebook in Chromium"
    programs = {"chromium": "chromium"}
    # Packages of Debian are for Debian's Python.
    python = "/usr/bin/python3"

    def missing(self):
        missing = super().missing()
        if not missing and subprocess.run([self.python, "-c", "import ipykernel, notebook, numpy"], check=False,
                                          stderr=subprocess.DEVNULL).returncode != 0:
            return "python3-notebook or python3-numpy"
        return missing

    def versions(self):
        return [f"Chromium {version('chromium', '--version')}",
                f"Jupyter Notebook {version(self.python, '-m', 'notebook', '--version')}"]

    def look(self, visit):
        scene = f"import piblocks\npiblocks.Scene(digits=1, time_to=2, view_size=({visit.width}, {visit.height}))"
        cell = {"cell_type": "code", "execution_count": None, "metadata": {}, "outputs": [], "source": scene}
        (visit.folder / "film.ipynb").write_text(json.dumps(
            {"cells": [cell], "metadata": {"kernelspec": {"name": "python3", "display_name": "Python 3"}},
             "nbformat": 4, "nbformat_minor": 5}))
        with self._serving(visit) as address, browsing(Browser, SAME_PROCESS) as (browser, _):
            browser.resize(*WINDOWS[0])
            browser.show_address(address)
            require("the notebook has a kernel", wait_until(
                browser, "window.Jupyter?.notebook?.kernel?.is_connected() ?? false", 60))
            browser.value("Jupyter.notebook.execute_all_cells()")
            frame = "document.querySelector('.output iframe')"
            require("a film", wait_until(browser, f"{frame} !== null", 60))
            return self._look_at_frame(browser, frame, visit)

    def _look_at_frame(self, browser, frame, visit):
        film = PageInFrame(browser)
        require("the film is there", wait_until(film, "video.readyState >= 2"))
        left, top, *_ = browser.rect(frame)
        x, y, width, height, wide, high = film.value("""(() => { const r = video.getBoundingClientRect();
            return [r.x, r.y, r.width, r.height, innerWidth, innerHeight]; })()""")
        require(f"a video of {width}x{height} at {x}, {y} lies in a frame of {wide}x{high}",
                x >= 0 and y >= 0 and x + width <= wide and y + height <= high)
        for kind in ("mousePressed", "mouseReleased"):
            browser.mouse(kind, left + x + width / 2, top + y + height / 2)
        require("ends", wait_until(film, "video.ended"))
        visit.keep_picture(self.id, lambda file: browser.save_picture("document.getElementById('site')", file))
        return f"{width:.0f}x{height:.0f} pixels; a click plays it to its end"

    @contextlib.contextmanager
    def _serving(self, visit):
        """@returns the notebook's address"""
        with socket.create_server(("127.0.0.1", 0)) as free:
            port = free.getsockname()[1]
        token = secrets.token_hex()
        server = subprocess.Popen(
            [self.python, "-m", "notebook", "--no-browser", "--allow-root", "--ip=127.0.0.1", f"--port={port}",
             "--port-retries=0", f"--NotebookApp.token={token}"], cwd=visit.folder, stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
            env={**os.environ, "HOME": str(visit.new_folder("home")), "PYTHONPATH": str(visit.package),
                 "PYTHONDONTWRITEBYTECODE": "1"})
        try:
            require("the server listens", wait_until_listening(port, 60))
            yield f"http://127.0.0.1:{port}/notebooks/film.ipynb?token={token}"
        finally:
            server.terminate()
            server.wait()


AUTOPLAY = "--autoplay-policy=no-user-gesture-required"
# Or a frame would be a target of its own.
SAME_PROCESS = "--disable-features=IsolateSandboxedIframes"
REVEAL_IN_CHROMIUM = Reveal("chromium", Browser, AUTOPLAY)
REVEAL_IN_FIREFOX = Reveal("firefox-esr", Firefox)
