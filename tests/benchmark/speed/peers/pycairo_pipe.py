"""Draws with pycairo and pipes the frames into ffmpeg."""

import cairo

import article


def rgb(colour):
    return [value / 255 for value in colour]


def draw_block(context, position, fill, edge):
    left, top, side = article.block(position)
    context.rectangle(left, top, side, side)
    context.set_source_rgb(*rgb(fill))
    context.fill_preserve()
    context.set_source_rgb(*rgb(edge))
    context.stroke()


def draw(context, blue, red, count):
    context.set_source_rgb(*rgb(article.WHITE))
    context.paint()
    context.set_source_rgb(*rgb(article.BLACK))
    context.set_dash([4 * article.LINE])
    context.rectangle(*article.wall())
    context.stroke()
    context.set_dash([])
    draw_block(context, red, article.RED, article.RED_EDGE)
    draw_block(context, blue, article.BLUE, article.BLUE_EDGE)
    context.set_source_rgb(*rgb(article.TEXT))
    context.move_to(article.TEXT_X, article.TEXT_Y)
    context.show_text(article.label(count))


def main():
    options = article.arguments(f"pycairo {cairo.version}")
    surface = cairo.ImageSurface(cairo.Format.RGB24, article.WIDTH, article.HEIGHT)
    context = cairo.Context(surface)
    context.set_line_width(article.LINE)
    context.select_font_face("DejaVu Sans")
    context.set_font_size(article.TEXT_SIZE)
    encoder = article.ffmpeg("bgr0", options.output)
    for state in article.states(options.frames):
        draw(context, *state)
        surface.flush()
        encoder.stdin.write(surface.get_data())
    article.close(encoder)


main()
