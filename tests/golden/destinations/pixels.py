"""Grey pictures, to see where a film is and whether it moves.

In: pictures. Out: bytes, one a pixel, row by row; what differs.
"""

import subprocess

DARK = 60  # the theme of the film is darker, but for its lines and letters
SAME = 16  # by which a pixel may differ in a film that rests
ALIKE = 24  # the same of the mean of a square, of a film and its last picture
SQUARE = 5


def grey(file, width, height, fit=False):
    """A picture in this size. @param fit  keeps its shape, black around it"""
    scale = f"scale={width}:{height}:flags=area"
    if fit:
        # Large at first, since the edges of a small picture are whole pixels.
        large = f"{4 * width}:{4 * height}"
        scale = f"scale={large}:force_original_aspect_ratio=decrease,pad={large}:-1:-1,{scale}"
    return subprocess.run(["ffmpeg", "-loglevel", "error", "-i", file, "-vf", scale, "-frames:v", "1",
                           "-pix_fmt", "gray", "-f", "rawvideo", "-"], stdout=subprocess.PIPE, check=True).stdout


def dark_share(file, width, height):
    """How much of the width or height what is dark takes, whichever is more."""
    levels = grey(file, width, height)
    dark = [(at % width, at // width) for at, level in enumerate(levels) if level < DARK]
    if not dark:
        return 0
    return max((max(values) - min(values) + 1) / size for values, size in zip(zip(*dark), (width, height)))


def is_same(one, other):
    return one == other or all(abs(a - b) <= SAME for a, b in zip(one, other))


def _means(picture, width):
    """Of squares. A thin line that another program has moved by half a pixel has the same."""
    rows = [picture[at:at + width] for at in range(0, len(picture), width)]
    return [sum(sum(row[x:x + SQUARE]) for row in rows[y:y + SQUARE]) // SQUARE ** 2
            for y in range(0, len(rows), SQUARE) for x in range(0, width, SQUARE)]


def are_alike(one, other, width):
    """Whether both show the same, scaled by two programs."""
    return all(abs(a - b) <= ALIKE for a, b in zip(_means(one, width), _means(other, width)))
