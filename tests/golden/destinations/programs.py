"""Films in programs with windows of their own, and on slides of beamer.

In: a visit. Out: what was seen.
"""

import pathlib
import re
import shutil
import subprocess
import time
import xml.etree.ElementTree

from destination import SHOTS, Destination, require, require_share, version
from pixels import dark_share
from screen import Screen

BEAMER = r"""\documentclass[aspectratio=%s]{beamer}
\usepackage{graphicx} \usepackage{multimedia}
\begin{document}
%s
\end{document}
"""
TITLED_FRAMES = r"""\begin{frame}{A title}
%s
\end{frame}
\begin{frame}
%s
\end{frame}"""


def run(command, folder):
    """What it prints."""
    done = subprocess.run(command, cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, errors="replace", check=False)
    require(f"exit code of {pathlib.Path(command[0]).name}", done.returncode, 0)
    return done.stdout


def pages_of(file):
    return int(re.search(r"Pages: *(\d+)", run(["pdfinfo", file], file.parent))[1])


class Beamer(Destination):
    """No box is overfull, and the picture is as large as fits."""

    programs = {"pdflatex": "texlive-latex-base", "pdftoppm": "poppler-utils", "ffmpeg": "ffmpeg"}

    def __init__(self, width, height):
        self.id, self.name = f"beamer-{width}-{height}", f"beamer, {width}:{height}"
        self._aspect = f"{width}{height}"
        self._size = 20 * width, 20 * height

    def missing(self):
        missing = super().missing()
        if not missing and subprocess.run(["kpsewhich", "beamer.cls"], stdout=subprocess.DEVNULL,
                                          check=False).returncode != 0:
            return "texlive-latex-recommended"
        return missing

    def versions(self):
        styles = run(["kpsewhich", "beamer.cls"], "/").strip()
        return [f"beamer {version('grep', '-m1', '-oE', 'v[0-9]+[.][0-9]+', styles)}"]

    def _set(self, folder, text, pages):
        (folder / "talk.tex").write_text(BEAMER % (self._aspect, text))
        printed = run(["pdflatex", "-interaction=nonstopmode", "talk.tex"], folder)
        require("boxes", re.findall(r"^Overfull.*", printed, re.MULTILINE), [])
        require("pages", pages_of(folder / "talk.pdf"), pages)

    def look(self, visit):
        film, story = visit.film(), visit.story()
        snippet = (film / "latex.tex").read_text()
        self._set(film, TITLED_FRAMES % (snippet, snippet), 2)
        self._set(story, r"\input{latex.tex}", len(SHOTS))
        least = 1
        for folder, pages in ((film, 2), (story, len(SHOTS))):
            run(["pdftoppm", "-png", "-r", "100", "talk.pdf", "talk"], folder)
            for page in range(1, pages + 1):
                picture = folder / f"talk-{page}.png"
                visit.keep_picture(f"{self.id}-{folder.name}-{page}",
                                   lambda file, picture=picture: shutil.copy(picture, file))
                if folder == story:
                    share = dark_share(picture, *self._size)
                    require_share(f"page {page}", share)
                    least = min(least, share)
        return f"{least:.2f}; {len(SHOTS)} frames, nothing overfull"


def has_element(name):
    """Of GStreamer."""
    return subprocess.run(["gst-inspect-1.0", "--exists", name], check=False).returncode == 0


class Impress(Destination):
    """The show plays each shot by itself, and stays at its end until a click."""

    id, name = "impress", "LibreOffice Impress"
    programs = {"soffice": "libreoffice-impress", "pdfinfo": "poppler-utils",
                "gst-inspect-1.0": "gstreamer1.0-tools", **Screen.programs}
    # Without the first, a show with videos stays blank.
    elements = {"gtksink": "gstreamer1.0-gtk3", "avdec_h264": "gstreamer1.0-libav",
                "qtdemux": "gstreamer1.0-plugins-good"}

    def _office(self):
        return pathlib.Path(shutil.which("soffice")).resolve().parent / "soffice.bin"

    def missing(self):
        missing = super().missing()
        if missing:
            return missing
        if not (self._office().parent / "libvclplug_gtk3lo.so").exists():
            return "libreoffice-gtk3"
        return " and ".join(package for name, package in self.elements.items() if not has_element(name))

    def versions(self):
        return [f"LibreOffice {version('soffice', '--version')}",
                f"GStreamer {version('gst-inspect-1.0', '--gst-version')}"]

    def _require_files(self, story):
        tree = xml.etree.ElementTree.parse(story / "impress.fodp")
        names = filter(None, (element.get("{http://www.w3.org/1999/xlink}href") for element in tree.iter()))
        require("files", sorted(names), sorted(f"pi-{shot:02}.{kind}" for shot in SHOTS for kind in ("mp4", "png")))
        require("files that are there", all((story / f"pi-{shot:02}.mp4").exists() for shot in SHOTS))

    def _require_slides(self, office, story):
        # With 81 a new profile asks for another start.
        for _ in range(2):
            code = subprocess.run([*office, "--headless", "--convert-to", "pdf", "impress.fodp"], cwd=story,
                                  timeout=300, check=False, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                  stderr=subprocess.DEVNULL).returncode
            if code != 81:
                break
        require("exit code", code, 0)
        require("slides", pages_of(story / "impress.pdf"), len(SHOTS))

    def look(self, visit):
        story = visit.story()
        self._require_files(story)
        office = [self._office(), "--norestore", "--nologo",
                  f"-env:UserInstallation={visit.new_folder('office').as_uri()}"]
        self._require_slides(office, story)
        with Screen(visit.new_folder("screen")) as screen:
            show = screen.start([*office, "--show", "impress.fodp"], story, SAL_USE_VCLPLUGIN="gtk3")
            begin, seconds = 0, 60
            for shot in SHOTS:
                # The first shot is a card, which rests.
                screen.require_end(f"shot {shot}", begin, story / f"pi-{shot:02}.png", seconds, plays=shot > 1)
                visit.keep_picture(f"{self.id}-{shot}", screen.save_picture)
                begin, seconds = screen.now(), 20
                screen.do(*(("key", "Right") if shot == 1 else ("click", "1")))
            time.sleep(1)
            require("exit code after the last slide", show.poll(), None)
            screen.do("key", "Right")
            require("exit code", show.wait(20), 0)
        return f"as large as the screen; each of {len(SHOTS)} shots plays by itself, then waits for a click"


class Mpv(Destination):
    """Plays to the last frame."""

    id, name = "mpv", "mpv"
    programs = {"mpv": "mpv", **Screen.programs}

    def versions(self):
        return [f"mpv {version('mpv', '--version')}"]

    def look(self, visit):
        story = visit.story()
        with Screen(visit.new_folder("screen")) as screen:
            screen.start(["mpv", "--no-config", "--fs", "--vo=x11", "--ao=null", "--no-osc", "--keep-open=always",
                          "pi.mp4"], story)
            screen.require_end("film", 0, story / f"pi-{SHOTS[-1]:02}.png", 30)
            visit.keep_picture(self.id, screen.save_picture)
        return "as large as the screen; plays to its last frame"
