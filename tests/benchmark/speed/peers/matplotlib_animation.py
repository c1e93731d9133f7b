"""Draws with matplotlib: FuncAnimation with blit, saved by its ffmpeg writer.

With --axes as its manual shows it: axes in sight, and the encoder's own preset.
"""

import matplotlib

matplotlib.use("Agg")

from matplotlib import pyplot
from matplotlib.animation import FFMpegWriter, FuncAnimation
from matplotlib.patches import Rectangle

import article

DPI = 100


def hexadecimal(colour):
    return "#%02x%02x%02x" % colour


def points(pixels):
    return pixels * 72 / DPI


def add_block(axes, position, fill):
    left, top, side = article.block(position)
    return axes.add_patch(Rectangle((left, top), side, side, facecolor=hexadecimal(fill)))


def main():
    options = article.arguments(f"matplotlib {matplotlib.__version__}", "--axes")
    figure = pyplot.figure(figsize=(article.WIDTH / DPI, article.HEIGHT / DPI), dpi=DPI)
    axes = figure.add_axes([0.05, 0.1, 0.93, 0.85] if options.axes else [0, 0, 1, 1])
    if not options.axes:
        axes.set_axis_off()
    axes.set_xlim(0, article.WIDTH)
    axes.set_ylim(article.HEIGHT, 0)

    column, top, bottom = article.wall()
    axes.plot([column, column], [top, bottom], color="black", linestyle="--",
              linewidth=points(article.LINE))
    red = add_block(axes, 5, article.RED)
    blue = add_block(axes, 2, article.BLUE)
    label = axes.text(article.TEXT_X, article.TEXT_Y, "", fontsize=points(article.TEXT_SIZE))

    def update(state):
        blue_position, red_position, count = state
        blue.set_x(article.block(blue_position)[0])
        red.set_x(article.block(red_position)[0])
        label.set_text(article.label(count))
        return blue, red, label

    animation = FuncAnimation(figure, update, frames=article.states(options.frames),
                              save_count=options.frames, blit=True)
    preset = [] if options.axes else ["-preset", "ultrafast"]
    writer = FFMpegWriter(fps=article.FPS, codec="libx264",
                          extra_args=preset + ["-pix_fmt", "yuv420p"])
    animation.save(options.output, writer=writer, dpi=DPI)


main()
