"""Draws with Pillow and pipes the frames into ffmpeg."""

import PIL
from PIL import Image, ImageDraw, ImageFont

import article


def draw_block(draw, position, fill):
    left, top, side = article.block(position)
    draw.rectangle([left, top, left + side - 1, top + side - 1], fill=fill)


def draw_frame(image, font, blue, red, count):
    draw = ImageDraw.Draw(image)
    draw.rectangle([0, 0, article.WIDTH, article.HEIGHT], fill=article.WHITE)
    column, top, bottom = article.wall()
    for dash in range(top, bottom, 2 * article.DASH):
        draw.line([column, dash, column, min(dash + article.DASH, bottom)], fill=article.BLACK,
                  width=article.LINE)
    draw_block(draw, red, article.RED)
    draw_block(draw, blue, article.BLUE)
    draw.text((article.TEXT_X, article.TEXT_Y), article.label(count), fill=article.TEXT, font=font,
              anchor="ls")


def main():
    options = article.arguments(f"Pillow {PIL.__version__}")
    image = Image.new("RGB", (article.WIDTH, article.HEIGHT))
    font = ImageFont.truetype(article.FONT, article.TEXT_SIZE)
    encoder = article.ffmpeg("rgb24", options.output)
    for state in article.states(options.frames):
        draw_frame(image, font, *state)
        encoder.stdin.write(image.tobytes())
    article.close(encoder)


main()
