// A plot: two curves grow over axes and a grid; a label tells the latest value.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "screen/material.hpp"

namespace piblocks::benchmark {
namespace {

constexpr int kLeft_px = 140;
constexpr int kRight_px = 1860;
constexpr int kTop_px = 80;
constexpr int kBottom_px = 980;
constexpr Colour kInk = 0x202020;
constexpr Colour kGrid = 0xdddddd;
constexpr double kLine_px = 3;

struct Point {
  double x;
  double y;
};

Point first_curve(double t) {
  return {kLeft_px + t * (kRight_px - kLeft_px), 530 - 380 * std::sin(9 * t) * std::exp(-1.5 * t)};
}
Point second_curve(double t) {
  return {kLeft_px + t * (kRight_px - kLeft_px),
          600 + 90 * std::sin(31 * t) + 60 * std::sin(83 * t + 1) + 40 * std::sin(211 * t)};
}

class Plot : public Application {
 public:
  void draw(Screen& screen, int number) override {
    if (number == 0) {
      draw_axes(screen);
      return;
    }
    const double from = double(number - 1) / (kPictures - 1);
    const double to = double(number) / (kPictures - 1);
    extend(screen, first_curve, from, to, 0x1f77b4);
    extend(screen, second_curve, from, to, 0xd62728);
    screen.fill({1600, 36, 22 * Screen::kCellWidth_px, Screen::kLineHeight_px}, 0xffffff);
    screen.write(1600, 36, fmt::format("t = {:.3f} s", to), kInk);
  }

 private:
  static void extend(Screen& screen, Point (*curve)(double), double from, double to,
                     Colour colour) {
    constexpr int kSteps = 4;
    cairo_t& cairo = screen.cairo();
    screen.set_colour(colour);
    cairo_set_line_width(&cairo, kLine_px);
    cairo_set_line_cap(&cairo, CAIRO_LINE_CAP_ROUND);
    cairo_set_line_join(&cairo, CAIRO_LINE_JOIN_ROUND);
    Point low = curve(from);
    Point high = low;
    cairo_move_to(&cairo, low.x, low.y);
    for (int i = 1; i <= kSteps; ++i) {
      const Point point = curve(from + (to - from) * i / kSteps);
      cairo_line_to(&cairo, point.x, point.y);
      low = {std::min(low.x, point.x), std::min(low.y, point.y)};
      high = {std::max(high.x, point.x), std::max(high.y, point.y)};
    }
    cairo_stroke(&cairo);
    screen.mark_changed(low.x, low.y, high.x, high.y, kLine_px);
  }

  static void draw_axes(Screen& screen) {
    screen.fill(kWholeScreen, 0xffffff);
    for (int i = 0; i <= 10; ++i) {
      const int x = kLeft_px + i * (kRight_px - kLeft_px) / 10;
      const int y = kBottom_px - i * (kBottom_px - kTop_px) / 10;
      screen.fill({x, kTop_px, 1, kBottom_px - kTop_px}, kGrid);
      screen.fill({kLeft_px, y, kRight_px - kLeft_px, 1}, kGrid);
      screen.write(x - 16, kBottom_px + 10, fmt::format("{:.1f}", 0.1 * i), kInk);
      screen.write(kLeft_px - 66, y - 12, fmt::format("{:+.1f}", 0.2 * i - 1), kInk);
    }
    screen.fill({kLeft_px, kTop_px, 2, kBottom_px - kTop_px}, kInk);
    screen.fill({kLeft_px, kBottom_px, kRight_px - kLeft_px, 2}, kInk);
    screen.write_large(560, 56, 30, "Displacement and load over time", kInk);
    screen.write(900, kBottom_px + 50, "time in seconds", kInk);
    draw_legend(screen);
  }

  static void draw_legend(Screen& screen) {
    screen.fill({1560, 100, 270, 80}, 0xf4f4f4);
    screen.fill({1575, 120, 50, 3}, 0x1f77b4);
    screen.write(1640, 110, "displacement", kInk);
    screen.fill({1575, 155, 50, 3}, 0xd62728);
    screen.write(1640, 145, "load", kInk);
  }
};

}  // namespace

std::unique_ptr<Application> start_plot() { return std::make_unique<Plot>(); }

}  // namespace piblocks::benchmark
