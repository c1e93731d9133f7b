"""What all destinations of films share.

In: the program, a shape. Out: films and storyboards of that shape in a folder.
"""

import re
import shutil
import subprocess

# Two cuts and a fade, and a diagram in the last picture. The theme is dark, the slides around it are white.
STORY = """
view = {{ size = "{}", theme = "lecture", fps = 30 }}
[[part]]
card = "One"
seconds = 0.5
[[part]]
digits = 1
time.to = 2
[[part]]
fade = 0.4
digits = 1
time.from = 2
time.to = 3
show.panels = ["velocity"]
"""
SHOTS = range(1, 4)
LEAST_SHARE = 0.7  # of the slide's width or height


class Wrong(Exception):
    """Something else was seen than what is promised."""


def require(what, found, expected=True):
    if found != expected:
        raise Wrong(f"not so: {what}" if expected is True else f"{what}: {found} instead of {expected}")


def require_share(what, share):
    """As large as fits: of a slide's width or height, whichever is more."""
    require(f"{what}: at least {LEAST_SHARE} of the slide, found {share:.2f}", share >= LEAST_SHARE)


def version(*command):
    """The first number with a point in what a program says of itself."""
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, check=False)
    found = re.search(r"\d+(\.\d+)+", done.stdout)
    return found[0] if found else "of an unknown version"


class Destination:
    """Where a film is shown."""

    id = name = ""
    programs = {}  # that are needed, and the Debian packages that have them

    def missing(self):
        """What has to be installed; empty if nothing."""
        return " and ".join(package for program, package in self.programs.items() if not shutil.which(program))

    def versions(self):
        """Of the programs, as text."""
        return []

    def look(self, visit):
        """Shows the film. Raises Wrong. @returns what was seen, in a few words."""
        raise NotImplementedError


class Visit:
    """Films of one shape, and a folder to show them in."""

    def __init__(self, program, shape, folder, pictures):
        self._program, self.shape, self.folder, self._pictures = program, shape, folder, pictures
        self.package = program.parent / "python"  # for Python
        self.width, self.height = map(int, shape.split("x"))

    def render(self, *arguments):
        subprocess.run([self._program, "render", "--quiet", *arguments], cwd=self.folder, check=True)

    def film(self):
        """The folder of a bundle of one scene."""
        self.render("--digits", "2", "--to", "4", "--size", self.shape, "--bundle", "film", "-o", "pi.mp4")
        return self.folder / "film"

    def write_story(self):
        (self.folder / "story.toml").write_text(STORY.format(self.shape))
        return "story.toml"

    def story(self):
        """The folder of a bundle of a storyboard."""
        self.render(self.write_story(), "--bundle", "story", "-o", "pi.mp4")
        return self.folder / "story"

    def new_folder(self, name):
        folder = self.folder / name
        folder.mkdir(mode=0o700)
        return folder

    def keep_picture(self, name, save):
        """If a person wants to see it. @param save  writes a PNG file"""
        if self._pictures:
            save(self._pictures / f"{name}-{self.shape}.png")
