"""Draws PNG files with gnuplot's pngcairo, and makes a video of them with ffmpeg."""

import os
import subprocess
import tempfile

import article

HEAD = """
set terminal pngcairo size {width},{height} font "DejaVu Sans,{text}" linewidth {line}
unset key; unset border; unset tics
set margins 0, 0, 0, 0
set xrange [0:{width}]
set yrange [{height}:0]
set arrow 1 from {wall[0]},{wall[1]} to {wall[0]},{wall[2]} nohead linecolor rgb "black" dashtype 2
"""
FRAME = """
set output "{name}"
set object 2 rectangle from {red[0]},{red[1]} rto {red[2]},{red[2]} \
  fillcolor rgb {red_fill} fillstyle solid noborder
set object 3 rectangle from {blue[0]},{blue[1]} rto {blue[2]},{blue[2]} \
  fillcolor rgb {blue_fill} fillstyle solid noborder
set label 1 "{text}" at {x},{y}
plot NaN
"""


def gnuplot_colour(colour):
    return '"#%02x%02x%02x"' % colour


def script(folder, frames):
    # A point of text is 4/3 pixels in pngcairo.
    yield HEAD.format(width=article.WIDTH, height=article.HEIGHT, text=article.TEXT_SIZE * 3 / 4,
                      line=article.LINE, wall=article.wall())
    for number, (blue, red, count) in enumerate(article.states(frames), 1):
        yield FRAME.format(
            name=os.path.join(folder, "%06d.png" % number),
            red=article.block(red), red_fill=gnuplot_colour(article.RED),
            blue=article.block(blue), blue_fill=gnuplot_colour(article.BLUE),
            text=article.label(count), x=article.TEXT_X, y=article.TEXT_Y)


def version():
    return subprocess.run(["gnuplot", "--version"], capture_output=True, text=True,
                          check=True).stdout.strip()


def make_video(folder, frames, output):
    with subprocess.Popen(["gnuplot"], stdin=subprocess.PIPE, text=True) as gnuplot:
        gnuplot.stdin.writelines(script(folder, frames))
    if gnuplot.returncode != 0:
        raise SystemExit("gnuplot failed")
    subprocess.run(["ffmpeg", "-y", "-loglevel", "error", "-framerate", str(article.FPS),
                    "-i", os.path.join(folder, "%06d.png"), "-c:v", "libx264",
                    "-preset", "ultrafast", "-pix_fmt", "yuv420p", "-movflags", "+faststart",
                    output], check=True)


def main():
    options = article.arguments(version())
    with tempfile.TemporaryDirectory(dir=os.path.dirname(options.output)) as folder:
        make_video(folder, options.frames, options.output)


main()
