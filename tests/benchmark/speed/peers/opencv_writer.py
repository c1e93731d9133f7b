"""Draws with OpenCV and writes with its VideoWriter, which encodes H.264 at its own settings."""

import cv2
import numpy

import article


def bgr(colour):
    return colour[::-1]


def rectangle(frame, left, top, right, bottom, colour):
    low = (round(left), round(top))
    high = (round(right) - 1, round(bottom) - 1)
    cv2.rectangle(frame, low, high, bgr(colour), cv2.FILLED)


def draw_wall(frame):
    column, top, bottom = article.wall()
    half = article.LINE / 2
    for dash in range(top, bottom, 2 * article.DASH):
        rectangle(frame, column - half, dash, column + half, min(dash + article.DASH, bottom),
                  article.BLACK)


def draw_block(frame, position, fill):
    left, top, side = article.block(position)
    rectangle(frame, left, top, left + side, top + side, fill)


def draw(frame, blue, red, count):
    frame[:] = 255
    draw_wall(frame)
    draw_block(frame, red, article.RED)
    draw_block(frame, blue, article.BLUE)
    cv2.putText(frame, article.label(count), (article.TEXT_X, article.TEXT_Y),
                cv2.FONT_HERSHEY_SIMPLEX, 2.7, bgr(article.TEXT), 5, cv2.LINE_AA)


def main():
    options = article.arguments(f"OpenCV {cv2.__version__}")
    frame = numpy.empty((article.HEIGHT, article.WIDTH, 3), numpy.uint8)
    writer = cv2.VideoWriter(options.output, cv2.VideoWriter_fourcc(*"avc1"), article.FPS,
                             (article.WIDTH, article.HEIGHT))
    if not writer.isOpened():
        raise SystemExit("OpenCV cannot write H.264")
    for state in article.states(options.frames):
        draw(frame, *state)
        writer.write(frame)
    writer.release()


main()
