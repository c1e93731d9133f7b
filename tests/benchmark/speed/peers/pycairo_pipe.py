"""Draws with pycairo and pipes the frames into ffmpeg."""

import cairo

import article


def rgb(colour):
    return [value / 255 for value in colour]


def draw_block(context, position, fill):
    left, top, side = article.block(position)
    context.rectangle(left, top, side, side)
    context.set_source_rgb(*rgb(fill))
    context.fill()


def draw(context, blue, red, count):
    context.set_source_rgb(*rgb(article.WHITE))
    context.paint()
    context.set_source_rgb(*rgb(article.BLACK))
    column, top, bottom = article.wall()
    context.move_to(column, top)
    context.line_to(column, bottom)
    context.stroke()
    draw_block(context, red, article.RED)
    draw_block(context, blue, article.BLUE)
    context.set_source_rgb(*rgb(article.TEXT))
    context.move_to(article.TEXT_X, article.TEXT_Y)
    context.show_text(article.label(count))


def main():
    options = article.arguments(f"pycairo {cairo.version}")
    surface = cairo.ImageSurface(cairo.Format.RGB24, article.WIDTH, article.HEIGHT)
    context = cairo.Context(surface)
    context.set_line_width(article.LINE)
    context.set_dash([article.DASH])
    context.select_font_face("DejaVu Sans")
    context.set_font_size(article.TEXT_SIZE)
    encoder = article.ffmpeg("bgr0", options.output)
    for state in article.states(options.frames):
        draw(context, *state)
        surface.flush()
        encoder.stdin.write(surface.get_data())
    article.close(encoder)


main()
