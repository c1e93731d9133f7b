"""Tests of the page that this machine cannot run, or that would test an old page."""

import pathlib
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]


def skip_unless(program, path):
    """Ends this test with 77 if the program is missing, or if scripts/web has not made `path`, the page
    or the folder that it is made in, of these sources."""
    if not shutil.which(program):
        skip(f"{program} is missing")
    if not path.exists():
        skip(f"{path} is missing; scripts/web makes it")
    digest = subprocess.run([ROOT / "src/web/digest_sources"], check=True, capture_output=True, text=True)
    made_of = path / "sources" if path.is_dir() else path
    if not made_of.is_file() or digest.stdout.strip() not in made_of.read_text():
        skip(f"{path} was made of other sources; scripts/web makes it anew")


def skip(reason):
    print(f"skipped: {reason}")
    sys.exit(77)
