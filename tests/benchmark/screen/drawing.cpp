// A drawing program: strokes of a pen, then a dialog that is dragged over them.
#include <algorithm>
#include <array>
#include <cmath>

#include "screen/material.hpp"

namespace piblocks::benchmark {
namespace {

constexpr PixelRect kPaper = {90, 50, 1810, 1010};
constexpr int kDrawing = 150;  ///< pictures with the pen; the others have the dialog
constexpr int kStroke = 30;    ///< pictures a stroke
constexpr int kDialogWidth_px = 560;
constexpr int kDialogHeight_px = 320;
constexpr std::array<Colour, 6> kColours = {0x264653, 0xe76f51, 0x2a9d8f,
                                            0x8a5a9e, 0xe9c46a, 0x1d3557};

struct Point {
  double x;
  double y;
};

/// Where the pen is: a hand that swings and trembles.
Point pen_at(int stroke, double t) {
  const double phase = 1.7 * stroke;
  return {400 + 220 * stroke + 260 * std::sin(5 * t + phase) + 5 * std::sin(37 * t),
          520 + 330 * std::sin(3.3 * t + 2 * phase) + 4 * std::sin(41 * t + 1)};
}

class Drawing : public Application {
 public:
  void draw(Screen& screen, int number) override {
    if (number == 0) draw_window(screen);
    if (number < kDrawing) {
      draw_stroke(screen, number / kStroke, number % kStroke);
    } else {
      drag_dialog(screen, number - kDrawing);
    }
  }

 private:
  static void draw_window(Screen& screen) {
    screen.fill(kWholeScreen, 0xd0d0d0);
    screen.fill(kPaper, 0xffffff);
    screen.write(20, 12, "File   Edit   Layer   Tools   View", 0x202020);
    for (int i = 0; i < 12; ++i) {
      screen.fill({14, 60 + 70 * i, 60, 60}, 0xbdbdbd);
      screen.fill({26, 72 + 70 * i, 36, 36}, kColours.at(std::size_t(i) % kColours.size()));
    }
  }

  static void draw_stroke(Screen& screen, int stroke, int step) {
    constexpr double kPen_px = 7;
    constexpr int kPoints = 6;
    cairo_t& cairo = screen.cairo();
    const auto pen = [&](int point) {
      return pen_at(stroke, (step + double(point) / kPoints) / kStroke * 2.2);
    };
    Point low = pen(0);
    Point high = low;
    screen.set_colour(kColours.at(std::size_t(stroke) % kColours.size()));
    cairo_set_line_width(&cairo, kPen_px);
    cairo_set_line_cap(&cairo, CAIRO_LINE_CAP_ROUND);
    cairo_set_line_join(&cairo, CAIRO_LINE_JOIN_ROUND);
    cairo_move_to(&cairo, low.x, low.y);
    for (int i = 1; i <= kPoints; ++i) {
      const Point point = pen(i);
      cairo_line_to(&cairo, point.x, point.y);
      low = {std::min(low.x, point.x), std::min(low.y, point.y)};
      high = {std::max(high.x, point.x), std::max(high.y, point.y)};
    }
    cairo_stroke(&cairo);
    screen.mark_changed(low.x, low.y, high.x, high.y, kPen_px);
  }

  void drag_dialog(Screen& screen, int step) {
    const CairoSurfacePtr shown(cairo_surface_reference(cairo_get_target(&screen.cairo())));
    if (step == 0) below_ = copy_of(shown.get(), kWholeScreen);
    if (step > 0) restore(screen, dialog_);
    const double share = double(step) / (kPictures - kDrawing);
    dialog_ = {int(std::lround(200 + 1050 * share)),
               int(std::lround(180 + 400 * std::sin(3 * share))), kDialogWidth_px,
               kDialogHeight_px};
    draw_dialog(screen);
  }

  static CairoSurfacePtr copy_of(cairo_surface_t* shown, const PixelRect& rect) {
    CairoSurfacePtr copy =
        image_surface(CAIRO_FORMAT_RGB24, rect.width_px, rect.height_px, "keep a picture");
    const CairoPtr cairo(cairo_create(copy.get()));
    cairo_set_source_surface(cairo.get(), shown, -rect.x_px, -rect.y_px);
    cairo_paint(cairo.get());
    return copy;
  }

  void restore(Screen& screen, const PixelRect& rect) {
    cairo_t& cairo = screen.cairo();
    cairo_set_source_surface(&cairo, below_.get(), 0, 0);
    cairo_rectangle(&cairo, rect.x_px, rect.y_px, rect.width_px, rect.height_px);
    cairo_fill(&cairo);
    screen.mark_changed(rect);
  }

  void draw_dialog(Screen& screen) const {
    const int x = dialog_.x_px;
    const int y = dialog_.y_px;
    screen.fill(dialog_, 0x606060);
    screen.fill({x + 1, y + 1, kDialogWidth_px - 2, kDialogHeight_px - 2}, 0xf2f2f2);
    screen.fill({x + 1, y + 1, kDialogWidth_px - 2, 36}, 0x2a6f97);
    screen.write(x + 16, y + 8, "Resize the picture", 0xffffff);
    screen.write(x + 30, y + 70, "Width:     1810 pixels", 0x202020);
    screen.write(x + 30, y + 110, "Height:    1010 pixels", 0x202020);
    screen.write(x + 30, y + 150, "Resolution: 96 pixels an inch", 0x202020);
    screen.fill({x + 300, y + 250, 110, 44}, 0xcccccc);
    screen.fill({x + 430, y + 250, 110, 44}, 0xcccccc);
    screen.write(x + 322, y + 261, "Cancel", 0x202020);
    screen.write(x + 457, y + 261, "Apply", 0x202020);
  }

  CairoSurfacePtr below_;
  PixelRect dialog_ = {};
};

}  // namespace

std::unique_ptr<Application> start_drawing() { return std::make_unique<Drawing>(); }

}  // namespace piblocks::benchmark
