import math
import sys

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot
from matplotlib.animation import FFMpegWriter, FuncAnimation
from matplotlib.patches import Rectangle

MASS, FPS, FRAMES = 100.0**2, 60, 832


def states():
    blue, red, v_blue, v_red = 2.0, 5.0, 0.0, -1.0
    time, count = 0.0, 0
    for frame in range(FRAMES):
        while True:
            to_wall = (0.5 - blue) / v_blue if v_blue < 0 else math.inf
            to_red = (red - blue - 1) / (v_blue - v_red) if v_blue > v_red else math.inf
            step = min(to_wall, to_red)
            if time + step > frame / FPS:
                break
            time, count = time + step, count + 1
            blue, red = blue + v_blue * step, red + v_red * step
            if to_wall < to_red:
                v_blue = -v_blue
            else:
                centre = (v_blue + MASS * v_red) / (1 + MASS)
                v_blue, v_red = 2 * centre - v_blue, 2 * centre - v_red
        late = frame / FPS - time
        yield blue + v_blue * late, red + v_red * late, count


figure = pyplot.figure(figsize=(19.2, 10.8), dpi=100)
axes = figure.add_axes([0, 0, 1, 1])
axes.set_axis_off()
axes.set(xlim=(-1, 12), ylim=(-3.65, 3.65))
axes.add_patch(Rectangle((-1, -1), 1, 2, fill=False, linestyle="--"))
red_block = axes.add_patch(Rectangle((4.5, -0.5), 1, 1, color="tab:red"))
blue_block = axes.add_patch(Rectangle((1.5, -0.5), 1, 1, color="tab:blue"))
label = axes.text(3.5, 1.5, "", fontsize=58)


def update(state):
    blue, red, count = state
    blue_block.set_x(blue - 0.5)
    red_block.set_x(red - 0.5)
    label.set_text(f"Collisions: {count}")
    return blue_block, red_block, label


animation = FuncAnimation(figure, update, frames=states(), save_count=FRAMES, blit=True)
animation.save(sys.argv[1], writer=FFMpegWriter(fps=FPS, codec="libx264"), dpi=100)
