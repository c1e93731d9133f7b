"""The article's scene as a lecturer would script it: what every peer shares.

In: the number of frames. Out: the state at each frame, where it goes in the picture, and a pipe
into ffmpeg.
"""

import argparse
import math
import subprocess

WIDTH, HEIGHT, FPS = 1920, 1080, 60
DIGITS = 3
FONT = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"

# Pixels: the size of one unit of the scene, where its origin is, the label's baseline.
UNIT = 140
ORIGIN_X, ORIGIN_Y = 190, 609
LINE, DASH = 3, 12
TEXT_SIZE = 80
TEXT_X, TEXT_Y = 682, 389

# Red, green, blue.
WHITE = (255, 255, 255)
BLACK = (0, 0, 0)
BLUE = (0, 0, 255)
RED = (255, 0, 0)
TEXT = (16, 16, 16)


def arguments(version, *flags):
    """--frames, the output and flags; `--version` names the libraries and ends."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--version", action="version", version=version)
    parser.add_argument("--frames", type=int, required=True)
    for flag in flags:
        parser.add_argument(flag, action="store_true")
    parser.add_argument("output")
    return parser.parse_args()


def states(frames):
    """Centre of the blue block, centre of the red one, collisions so far; for each frame."""
    mass = 100.0 ** (DIGITS - 1)
    blue, red, v_blue, v_red = 2.0, 5.0, 0.0, -1.0
    time, count = 0.0, 0
    for frame in range(frames):
        now = frame / FPS
        while True:
            to_wall = (0.5 - blue) / v_blue if v_blue < 0 else math.inf
            to_blocks = (red - blue - 1) / (v_blue - v_red) if v_blue > v_red else math.inf
            step = min(to_wall, to_blocks)
            if time + step > now:
                break
            blue, red, time, count = blue + v_blue * step, red + v_red * step, time + step, count + 1
            if to_wall < to_blocks:
                v_blue = -v_blue
            else:
                centre = (v_blue + mass * v_red) / (1 + mass)
                v_blue, v_red = 2 * centre - v_blue, 2 * centre - v_red
        yield blue + v_blue * (now - time), red + v_red * (now - time), count


def block(position):
    """Left, top and side of a block, in pixels."""
    return ORIGIN_X + (position - 0.5) * UNIT, ORIGIN_Y - UNIT / 2, UNIT


def wall():
    """Column, top and bottom of the dashed line that is the wall, in pixels."""
    return ORIGIN_X - LINE / 2, ORIGIN_Y - UNIT, ORIGIN_Y + UNIT


def label(count):
    return f"Collisions:{count}"


def ffmpeg(pixel_format, output):
    """ffmpeg as a process that takes raw frames on its standard input."""
    return subprocess.Popen(
        ["ffmpeg", "-y", "-loglevel", "error",
         "-f", "rawvideo", "-pix_fmt", pixel_format, "-s", f"{WIDTH}x{HEIGHT}", "-r", str(FPS),
         "-i", "-", "-c:v", "libx264", "-preset", "ultrafast", "-pix_fmt", "yuv420p",
         "-movflags", "+faststart", output],
        stdin=subprocess.PIPE)


def close(process):
    """Waits until ffmpeg has written its file."""
    process.stdin.close()
    if process.wait() != 0:
        raise SystemExit("ffmpeg failed")
