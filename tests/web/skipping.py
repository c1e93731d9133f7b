"""Tests of the page that this machine cannot run, or that would test an old page."""

import pathlib
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]


def skip_unless(program, page):
    """Ends this test with 77 if the program is missing, or if scripts/web has not made the page of these
    sources."""
    if not shutil.which(program):
        skip(f"{program} is missing")
    if not page.is_file():
        skip(f"{page} is missing; scripts/web makes it")
    digest = subprocess.run([ROOT / "src/web/digest_sources"], check=True, capture_output=True, text=True)
    if digest.stdout.strip() not in page.read_text():
        skip(f"{page} was made of other sources; scripts/web makes it anew")


def skip(reason):
    print(f"skipped: {reason}")
    sys.exit(77)
