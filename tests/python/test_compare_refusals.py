"""What piblocks.compare rejects, and in which words."""

import io
import os
from pathlib import Path

import numpy as np
import pytest
from test_compare import noise, png_of_piblocks

import piblocks
from piblocks import compare

GREY = np.zeros((4, 5), np.uint8)


@pytest.mark.parametrize(
    "picture, message",
    [
        (GREY / 255, r"reference: samples are float64; .*\(255 \* picture\).round\(\)"),
        (GREY > 0, r"reference: samples are bool; give 255 \* picture.astype\('uint8'\)"),
        (GREY.astype(int), r"reference: samples are int64; give picture.astype\('uint8'\)"),
        (GREY.astype(np.uint32), "reference: samples are uint32"),
        (np.array(["a"]), "reference: samples are <U1"),
        (GREY[0], "reference: the array is 5; it must be height x width"),
        (np.uint8(3) + np.zeros((), np.uint8), "reference: the array is a number; it must be"),
        (np.zeros((4, 5, 2), np.uint8), "reference: the array is 4 x 5 x 2"),
        (np.zeros((3, 4, 5), np.uint8), "reference: the array is 3 x 4 x 5"),
        (np.zeros((0, 5), np.uint8), "compare: cannot take a picture of 5x0 pixels"),
        (np.lib.stride_tricks.as_strided(GREY, (1, 16385), (0, 0)), "picture of 16385x1 pixels"),
        (b"", "reference: the bytes are no PNG file"),
        (b"GIF89a", "reference: the bytes are no PNG file"),
        ("a\0b", "reference: 'a.x00b' has a null character"),
    ],
)
def test_pictures_that_are_none(picture, message):
    with pytest.raises(piblocks.UsageError, match=message):
        compare(picture, GREY)


@pytest.mark.parametrize("given", [3, None, [1, 2], {}, object(), io.BytesIO(b"x"), 1.5])
def test_wrong_types(given):
    with pytest.raises(TypeError, match="actual: must be an array, an image of Pillow, .* not "
                       + type(given).__name__):
        compare(GREY, given)


@pytest.mark.parametrize(
    "tolerance, message",
    [
        ({"max_delta": 256}, "max_delta 256: must be a number from 0 to 255"),
        ({"max_delta": "x"}, "max_delta x: not a number"),
        ({"max_delta": float("nan")}, "max_delta nan: not a number"),
        ({"hard_delta": -1}, "hard_delta -1: must be a number from 0 to 255"),
        ({"threshold": 2}, "threshold 2: must be a number from 0 to 1"),
        ({"threshold": 0.1, "max_delta": 1}, "threshold and max_delta: use one of them"),
        ({"count_antialiasing": True}, "count_antialiasing belongs to threshold"),
        ({"max_pixels": "101%"}, "max_pixels 101%: must be a number of pixels, or from 0% to 100%"),
        ({"max_pixels": 1.5}, "max_pixels 1.5: "),
        ({"max_window": 16}, "max_window 16: must be N:K, such as 16:40"),
        ({"max_window": (16, 2, 3)}, "max_window 16:2:3: "),
        ({"masks": [(0, 0, 5, 4)]}, "compare: the masks leave nothing of a picture of 5x4"),
        ({"masks": [(0, 0, 5)]}, r"masks\[0\]: \(0, 0, 5\) must be x, y, width, height"),
        ({"masks": [(9, 9, 5, 4)]}, "the mask 5x4.9.9 lies outside of every picture"),
        ({"masks": ((0, 0, 5, 4),)}, "compare: the masks leave nothing"),
        ({"masks": ["5x4"]}, r"masks 5x4: must be WxH\+X\+Y"),
        ({"masks": [(-1, 0, 2, 2)]}, "masks 2x2"),
        ({"masks": ["no.png"]}, "masks no.png: png: cannot read 'no.png'"),
        ({"masks": [Path("no.png")]}, r"masks\[0\]: png: cannot read 'no.png'"),
        ({"masks": [GREY]}, r"masks\[0\]: all of it is black or transparent"),
        ({"masks": [GREY[:2] + 1]}, r"the mask masks\[0\] is 5x2, and 'the picture' is 5x4"),
    ],
)
def test_tolerances_that_make_no_sense(tolerance, message):
    with pytest.raises(piblocks.UsageError, match=message):
        compare(GREY, GREY, **tolerance)


@pytest.mark.parametrize("tolerance, message", [
    ({"max_delta": [None]}, "max_delta: must be a number"),
    ({"ignore_transparent": 1}, "ignore_transparent: must be True or False"),
    ({"masks": 3}, "masks: must be a list of masks, not int"),
    ({"masks": [None]}, r"masks\[0\]: must be an array"),
    ({"tolerance": 3}, "unexpected keyword argument 'tolerance'"),
])
def test_wrong_types_of_tolerances(tolerance, message):
    with pytest.raises(TypeError, match=message):
        compare(GREY, GREY, **tolerance)


def test_files_that_cannot_be_read():
    Path("cut.png").write_bytes(png_of_piblocks(noise(20, 30))[:300])
    Path("text.png").write_text("no picture, but a long enough text")
    os.mkdir("empty")
    good = png_of_piblocks(GREY)
    Path("good.png").write_bytes(good)
    for other in (GREY, "good.png"):
        for missing in ("no.png", Path("no.png")):
            with pytest.raises(FileNotFoundError, match="cannot read 'no.png'") as caught:
                compare(missing, other)
            assert isinstance(caught.value, piblocks.IoError)
        for broken in ("cut.png", "text.png"):
            with pytest.raises(piblocks.IoError, match=broken):
                compare(other, broken)
    with pytest.raises(piblocks.IoError, match="png: cannot read 'the actual picture'"):
        compare(GREY, Path("cut.png").read_bytes())
    with pytest.raises(piblocks.IoError, match="empty"):
        compare("empty", "empty")
    with pytest.raises(piblocks.IoError, match="'empty': Is a directory"):
        compare(GREY, "empty")
    with pytest.raises(FileNotFoundError):
        compare("nowhere", "empty")
