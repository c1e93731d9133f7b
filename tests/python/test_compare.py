"""piblocks.compare: every kind of picture, by an independent computation; what is rejected."""

import gc
import io
import os
import pickle
import re
import subprocess
import sys
import weakref
from pathlib import Path

import numpy as np
import pytest
from conftest import in_threads

import piblocks
from piblocks import Scene, compare


def noise(*shape, seed=1, dtype=np.uint8):
    return np.random.default_rng(seed).integers(0, np.iinfo(dtype).max, shape, dtype, endpoint=True)


def changed(picture, count, by, seed=2):
    """The picture with so many samples changed by up to so much."""
    random = np.random.default_rng(seed)
    other = picture.astype(np.int64)
    flat = other.reshape(-1)
    flat[random.choice(flat.size, count, replace=False)] += random.integers(-by, by + 1, count)
    return np.clip(other, 0, np.iinfo(picture.dtype).max).astype(picture.dtype)


def png_of(picture):
    """By somebody else's program."""
    image = pytest.importorskip("PIL.Image", reason="there is no Pillow (python3-pil)")
    file = io.BytesIO()
    image.fromarray(picture).save(file, "PNG")
    return file.getvalue()


def png_of_piblocks(picture):
    return piblocks._piblocks.picture_of_samples(picture).png()


class Figure:
    """A figure of matplotlib, as far as it is used."""

    def __init__(self, picture):
        self._picture = picture

    def savefig(self, file, format):
        assert format == "png"
        file.write(png_of_piblocks(self._picture))


class Canvas:
    def __init__(self, picture):
        self._picture = picture
        self._drawn = None

    def draw(self):
        self._drawn = self._picture

    def buffer_rgba(self):
        return memoryview(self._drawn)


@pytest.mark.parametrize("shape", [(33, 47), (33, 47, 3), (33, 47, 4)])
@pytest.mark.parametrize("dtype, by", [(np.uint8, 9), (np.uint16, 900)])
@pytest.mark.parametrize("max_delta", [0, 2, "2.5"])
def test_numbers_are_those_of_numpy(shape, dtype, by, max_delta):
    expected = noise(*shape, dtype=dtype)
    actual = changed(expected, 60, by)
    full = np.iinfo(dtype).max
    deltas = np.abs(expected.astype(np.int64) - actual)
    if deltas.ndim == 2:
        deltas = deltas[..., np.newaxis]
    of_pixel = deltas.max(axis=2)
    off = of_pixel * 255 > float(max_delta) * full
    windows = np.lib.stride_tricks.sliding_window_view(off, (16, 16)).sum(axis=(2, 3))

    result = compare(expected, actual, max_delta=max_delta)
    assert not result and result.outcome == "different" and result.max_level == full
    assert result.different_pixels == np.count_nonzero(of_pixel)
    assert result.off_pixels == np.count_nonzero(off) > 0
    assert result.largest_delta == of_pixel.max()
    y, x, channel = np.argwhere(deltas)[0]
    assert result.first == (x, y, channel)
    y, x = np.argwhere(windows == windows.max())[0]
    assert result.densest == (x, y, 16, 16) and result.densest_off == windows.max()
    assert np.array_equal(result.deltas(), np.ceil(of_pixel * 255 / full))
    # What is bounded by these numbers is accepted, and what is bounded by one less is not.
    given = {"max_delta": max_delta}
    for name, bound in [("max_pixels", result.off_pixels),
                        ("max_window", (16, result.densest_off))]:
        less = bound - 1 if name == "max_pixels" else (16, bound[1] - 1)
        assert compare(expected, actual, **given, **{name: bound})
        assert not compare(expected, actual, **given, **{name: less})
    percent = 100 * result.off_pixels / off.size
    assert compare(expected, actual, **given, max_pixels=f"{percent + 0.01:.4f}%")
    assert not compare(expected, actual, **given, max_pixels=f"{percent - 0.01:.4f}%")
    hard = result.largest_delta * 255 / full
    assert compare(expected, actual, max_pixels=10**6, hard_delta=hard + 0.001)
    assert not compare(expected, actual, max_pixels=10**6, hard_delta=hard - 0.001)


def test_every_kind_of_picture_is_the_same_picture():
    picture = noise(20, 30, 4)
    other = changed(picture, 7, 99)
    png = png_of_piblocks(picture)
    Path("a.png").write_bytes(png)
    kinds = [picture, png, bytearray(png), memoryview(png), "a.png", Path("a.png"), Figure(picture),
             Canvas(picture), memoryview(picture), np.asfortranarray(picture),
             np.repeat(picture, 2, axis=1)[:, ::2], png_of(picture)]
    number = compare(picture, other).different_pixels
    equal = compare("a.png", "a.png")
    assert equal.different_pixels == 0 and not equal.deltas().any() and equal.png() != b""
    for kind in kinds:
        for same in kinds:
            assert compare(kind, same).outcome == "equal"
        assert compare(kind, other).different_pixels == number
        assert compare(other, kind).different_pixels == number


@pytest.mark.parametrize("mode", ["1", "L", "LA", "P", "RGB", "RGBA", "CMYK", "YCbCr", "I;16"])
def test_images_of_pillow(mode):
    image = pytest.importorskip("PIL.Image", reason="there is no Pillow (python3-pil)")
    if mode == "I;16":
        deep = noise(20, 30, dtype=np.uint16)
        given = image.frombuffer("I;16", (30, 20), deep.tobytes(), "raw", "I;16", 0, 1)
        assert compare(given, deep) and not compare(given, deep + 1)
        return
    given = image.fromarray(noise(20, 30, 4)).convert(mode)
    assert compare(given, np.asarray(given.convert("RGBA")))
    black = image.new(mode, given.size)
    assert not compare(given, black)
    if mode not in ("CMYK", "YCbCr"):  # no PNG file has these
        given.save("a.png")
        assert compare(given, "a.png")


def test_greys_are_opaque_colours():
    grey = noise(9, 8)
    colours = np.stack([grey] * 3, axis=2)
    assert compare(grey, colours)
    assert compare(grey[..., np.newaxis], np.dstack([colours, np.full_like(grey, 255)]))
    assert not compare(grey, np.dstack([colours, np.full_like(grey, 254)]))
    assert compare(grey, grey.astype(np.uint16) * 257)
    assert compare(grey.astype(">u2") * 257, grey)


def test_deep_pictures_keep_their_depth_in_files():
    deep = noise(9, 8, 4, dtype=np.uint16)
    Path("deep.png").write_bytes(png_of_piblocks(deep))
    other = deep.copy()
    other[3, 4, 2] ^= 1
    result = compare("deep.png", other)
    assert compare("deep.png", deep) and result.largest_delta == 1 and result.max_level == 65535
    assert result.first == (4, 3, 2) and "0.00390 of 255 (1 of 65535)" in str(result)


def test_files_in_memory_are_read_as_those_on_disk():
    """Also those that libpng has to read: interlaced, deep, turned by Exif, animated."""
    image = pytest.importorskip("PIL.Image", reason="there is no Pillow (python3-pil)")
    picture = image.fromarray(noise(20, 30, 3))
    turned = image.Exif()
    turned[0x112] = 6
    picture.save("turned.png", exif=turned)
    picture.save("plain.png")
    image.fromarray(noise(20, 30).astype(np.int32) * 256, "I").save("deep.png")
    for name in ("turned.png", "plain.png", "deep.png"):
        assert compare(name, Path(name).read_bytes()).outcome == "equal"
    for one in ("turned.png", Path("turned.png").read_bytes()):
        result = compare(one, "plain.png")
        assert not result and "shown another way" in str(result)
    picture.save("moving.png", save_all=True, append_images=[image.fromarray(noise(20, 30, 3, seed=9))])
    for one in ("moving.png", Path("moving.png").read_bytes()):
        with pytest.raises(piblocks.IoError, match="it is animated"):
            compare(picture, one)
    assert len(compare("moving.png", "moving.png").rows) == 2


def test_a_figure_of_matplotlib():
    matplotlib = pytest.importorskip("matplotlib", reason="there is no matplotlib (python3-matplotlib)")
    matplotlib.use("Agg")
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure as RealFigure

    def figure(last):
        made = RealFigure(figsize=(3, 2))
        made.subplots().plot([1, 2, last])
        return made

    assert compare(figure(3), figure(3))
    result = compare(figure(3), figure(4))
    assert not result and result.different_pixels > 10
    drawn = FigureCanvasAgg(figure(3))
    figure(3).savefig("a.png")
    assert compare(drawn, drawn) and compare("a.png", figure(3))


def test_importing_the_package_imports_no_library_of_pictures():
    code = ("import sys, piblocks, numpy; piblocks.compare(numpy.zeros((2, 2), 'u1'), "
            "numpy.zeros((2, 2), 'u1')); print([m for m in ('PIL', 'matplotlib') if m in "
            "sys.modules])")
    assert subprocess.run([sys.executable, "-c", code], capture_output=True,
                          text=True).stdout == "[]\n"


def test_what_a_result_says():
    picture = noise(20, 30, 3)
    other = picture.copy()
    other[3, 4, 1] ^= 255
    equal = compare(picture, picture)
    assert equal and str(equal) == "equal" and equal.first is None and equal.densest is None
    assert (equal.different_pixels, equal.off_pixels, equal.largest_delta) == (0, 0, 0)
    different = compare(picture, other)
    assert re.fullmatch(r"1 pixel differs, largest delta \d+ of 255, first at x=4 y=3 \(green\), "
                        r"densest 16x16 window at x=0 y=0: 1", str(different))
    assert repr(different) == f"<Comparison different: {different}>"
    with pytest.raises(AssertionError, match="Comparison different: 1 pixel differs"):
        assert different, repr(different)
    accepted = compare(picture, other, max_pixels=1)
    assert accepted and accepted.outcome == "accepted" and "within tolerance" in str(accepted)
    assert different.rows == (different,)
    size = compare(picture, other[:10])
    assert not size and size.outcome == "not comparable" and size.different_pixels is None
    assert str(size) == "another size: 30x10 instead of 30x20"


def test_lines_are_those_of_the_command_line(program):
    picture = noise(20, 30, 3)
    for name, one in [("a.png", picture), ("b.png", changed(picture, 5, 50))]:
        Path(name).write_bytes(png_of_piblocks(one))
    for options, tolerance in [
        ([], {}),
        (["--max-delta", "20.5"], {"max_delta": 20.5}),
        (["--threshold", "0.1", "--count-antialiasing"],
         {"threshold": 0.1, "count_antialiasing": True}),
        (["--max-window", "4:0", "--hard-delta", "9"], {"max_window": "4:0", "hard_delta": 9}),
        (["--ignore-transparent", "--mask", "3x4+1+2", "--mask", "30x1+0+0"],
         {"ignore_transparent": True, "masks": [(1, 2, 3, 4), "30x1+0+0"]}),
    ]:
        said = program("compare", "a.png", "b.png", *options, check=False)
        result = compare("a.png", "b.png", **tolerance)
        assert said.returncode == (0 if result else 1)
        assert said.stdout.decode().splitlines()[0] == str(result)


def test_folders_and_videos_have_rows(program):
    for folder in ("a", "b"):
        os.mkdir(folder)
    picture = noise(20, 30, 3)
    shown = {"a": {"0": picture, "1": picture, "2": picture, "3": picture},
             "b": {"0": picture, "1": changed(picture, 5, 50), "2": picture[:10], "4": picture}}
    for folder, pictures in shown.items():
        for name, one in pictures.items():
            Path(folder, name + ".png").write_bytes(png_of_piblocks(one))
    result = compare("a", Path("b"))
    assert not result and result.different_pixels is None
    assert [(row.name, row.outcome) for row in result.rows] == [
        ("0.png", "equal"), ("1.png", "different"), ("2.png", "not comparable"),
        ("3.png", "missing"), ("4.png", "new")]
    assert result.rows[1].first == compare(picture, shown["b"]["1"]).first
    said = program("compare", "a", "b", check=False).stdout.decode().splitlines()
    assert list(result.lines) == said and str(result).splitlines() == said
    assert result._repr_html_().startswith("<pre>2.png: another size")
    result.report("page.html")
    assert b"1.png" in Path("page.html").read_bytes()
    for action in (result.png, result.deltas, lambda: result.save("c.png"), result.rows[1].png):
        with pytest.raises(piblocks.UsageError, match="compare two pictures"):
            action()
    scene = Scene(1, view_size="64x36", view_fps=5)
    scene.render("a.mp4")
    scene.render("frames/%06d.png")
    assert len(compare("a.mp4", "a.mp4").rows) == len(scene.frames())
    assert compare("a.mp4", "frames/%06d.png", max_delta=100)


def test_masks():
    picture = noise(20, 30, 3)
    other = picture.copy()
    other[5:9, 3:7] ^= 1
    outside = np.zeros((20, 30), bool)
    outside[5:9, 3:7] = True
    Path("mask.png").write_bytes(png_of_piblocks(255 * outside.astype(np.uint8)))
    for masks in [(3, 5, 4, 4), [3, 5, 4, 4], [(3, 5, 4, 4)], "4x4+3+5", ["4x4+3+5"], outside, [outside],
                  255 * outside.astype(np.uint8), "mask.png", Path("mask.png"),
                  [Path("mask.png").read_bytes()], [(3, 5, 4, 2), np.array([3, 7, 4, 2]).tolist()]]:
        result = compare(picture, other, masks=masks)
        assert result and result.outcome == "accepted", masks
        assert result.masked_pixels == 16 and result.different_pixels == 0
    for none in (None, [], ()):
        assert not compare(picture, other, masks=none)
    part = compare(picture, other, masks=[(3, 5, 4, 1)])
    assert not part and part.different_pixels == 12 and part.masked_pixels == 4
    assert np.count_nonzero(part.deltas()) == 12


@pytest.mark.parametrize("threshold", [0.05, 0.1, 0.3])
def test_what_looks_alike_is_that_of_numpy(threshold):
    """By YIQ, as pixelmatch 7 weighs it: 35215 is the distance of black and white."""
    expected = noise(40, 50, 3)
    actual = changed(expected, 4000, 90)
    yiq = (expected.astype(float) - actual) @ np.array([
        [0.29889531, 0.59597799, 0.21147017],
        [0.58662247, -0.27417610, -0.52261711],
        [0.11448223, -0.32180189, 0.31114694]])
    off = yiq**2 @ np.array([0.5053, 0.299, 0.1957]) > 35215 * threshold**2
    result = compare(expected, actual, threshold=threshold, count_antialiasing=True)
    assert result.off_pixels == np.count_nonzero(off) > 0
    # Without that, smoothed edges are accepted.
    assert compare(expected, actual, threshold=threshold).off_pixels <= result.off_pixels


def test_what_looks_alike_and_what_is_transparent():
    picture = np.full((20, 30, 4), 200, np.uint8)
    near = picture.copy()
    near[3, 4, 0] += 3
    assert not compare(picture, near) and compare(picture, near, threshold=0.1)
    clear, other = picture.copy(), picture.copy()
    clear[..., 3] = other[..., 3] = 0
    other[..., 0] = 9
    assert not compare(clear, other) and compare(clear, other, ignore_transparent=True)


def test_pictures_of_a_difference():
    picture = np.full((20, 30, 3), 255, np.uint8)
    other = picture.copy()
    other[3, 4] = 0
    Path("a.png").write_bytes(png_of_piblocks(picture))
    result = compare("a.png", other)
    assert result.png("expected") == Path("a.png").read_bytes()
    assert compare(result.png("actual"), other)
    red = picture.copy()
    red[3, 4, 1:] = 0
    assert compare(result.png(), red), "red where it differs, white elsewhere"
    result.save("diff.png")
    assert Path("diff.png").read_bytes() == result.png("diff")
    with pytest.raises(piblocks.UsageError, match="file.*a.png|a.png.*the reference"):
        result.save("a.png")
    with pytest.raises(piblocks.UsageError, match="cannot open 'a.png/b.png': Not a directory"):
        result.save("a.png/b.png")
    for write in (result.save, result.report):
        with pytest.raises(piblocks.UsageError, match="'-' is standard output only for"):
            write("-")
    html = result._repr_html_()
    assert html.count("data:image/png;base64,") == 3
    captions = re.findall("<figcaption>([a-z]*)</figcaption>", html)
    assert captions == ["expected", "difference", "actual"]
    result.report("page.html")
    assert b"1 pixel differs" in Path("page.html").read_bytes()
    os.remove("a.png")
    assert result.png("actual") and result._repr_html_()


def test_large_pictures_stay_out_of_notebooks():
    picture = noise(1500, 1500, 3)
    html = compare(picture, changed(picture, 5, 5))._repr_html_()
    assert len(html) < 1000 and "would add" in html


def test_results_are_freed_at_once():
    gc.disable()
    try:
        result = compare(noise(20, 30), noise(20, 30, seed=3))
        freed = weakref.ref(result)
        del result
        assert freed() is None
    finally:
        gc.enable()


def test_results_can_be_pickled_without_their_pictures():
    result = pickle.loads(pickle.dumps(compare(noise(20, 30), noise(20, 30, seed=3))))
    assert not result and "pixels differ" in str(result) and result.off_pixels > 500
    assert result._repr_html_() == f"<pre>{result}</pre>"
    with pytest.raises(piblocks.UsageError, match="a copy have no pictures"):
        result.png()


def test_threads_may_share_a_result():
    picture = noise(200, 300, 3)
    result = compare(picture, changed(picture, 500, 50))
    expected = (result.png(), result.deltas().tobytes())
    found = [None] * 8

    def work(place):
        found[place] = (result.png(), result.deltas().tobytes())

    in_threads(work, range(8))
    assert found == [expected] * 8
