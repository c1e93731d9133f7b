// A talk: six slides, each at rest for some time; on one of them, points appear one by one. One has
// a gradient, one a picture with the noise of a camera.
#include <algorithm>
#include <cmath>

#include "screen/material.hpp"
#include "screen/sample_text.hpp"

namespace piblocks::benchmark {
namespace {

constexpr int kSlide = 40;  ///< pictures a slide
constexpr Colour kInk = 0x22303c;
constexpr Colour kAccent = 0x2a6f97;
constexpr PixelRect kPhotograph = {160, 200, 1200, 760};

/// Smooth values between 0 and 1 from random ones on a grid.
class SmoothNoise {
 public:
  double at(double x, double y) const {
    const double column = std::floor(x);
    const double row = std::floor(y);
    const double right = smooth(x - column);
    const double down = smooth(y - row);
    const double upper = mix(knot(column, row), knot(column + 1, row), right);
    const double lower = mix(knot(column, row + 1), knot(column + 1, row + 1), right);
    return mix(upper, lower, down);
  }

 private:
  static double smooth(double t) { return t * t * (3 - 2 * t); }
  static double mix(double a, double b, double share) { return a + share * (b - a); }
  static double knot(double column, double row) {
    unsigned bits = unsigned(int(column)) * 374761393U + unsigned(int(row)) * 668265263U;
    bits = (bits ^ (bits >> 13)) * 1274126177U;
    return double((bits ^ (bits >> 16)) & 0xffff) / 0xffff;
  }
};

class Slides : public Application {
 public:
  void draw(Screen& screen, int number) override {
    const int step = number % kSlide;
    switch (number / kSlide) {
      case 0:
        if (step == 0) draw_title(screen);
        break;
      case 1:
        draw_points(screen, step);
        break;
      case 2:
        if (step == 0) draw_gradient(screen);
        break;
      case 3:
        if (step == 0) draw_photograph(screen);
        break;
      case 4:
        if (step == 0) draw_chart(screen);
        break;
      default:
        if (step == 0) draw_end(screen);
    }
  }

 private:
  static void draw_head(Screen& screen, const std::string& title) {
    screen.fill(kWholeScreen, 0xffffff);
    screen.fill({0, 0, kScreenWidth_px, 120}, kAccent);
    screen.write_large(160, 80, 52, title, 0xffffff);
  }

  static void draw_title(Screen& screen) {
    screen.fill(kWholeScreen, kAccent);
    screen.write_large(200, 480, 80, "A talk about screens", 0xffffff);
    screen.write_large(200, 580, 40, "what changes, and what stays", 0xcfe3ee);
  }

  void draw_points(Screen& screen, int step) {
    if (step == 0) draw_head(screen, "Points");
    if (step % 8 != 0) return;
    const int y = 220 + step / 8 * 130;
    screen.fill({160, y + 12, 20, 20}, kAccent);
    screen.write_large(210, y + 38, 40, text_.sentence(7), kInk);
    screen.mark_changed({160, y - 20, 1600, 90});
  }

  static void draw_gradient(Screen& screen) {
    const std::unique_ptr<cairo_pattern_t, Released<cairo_pattern_destroy>> gradient(
        cairo_pattern_create_linear(0, 0, kScreenWidth_px, kScreenHeight_px));
    cairo_pattern_add_color_stop_rgb(gradient.get(), 0, 0.05, 0.15, 0.35);
    cairo_pattern_add_color_stop_rgb(gradient.get(), 1, 0.95, 0.6, 0.35);
    cairo_set_source(&screen.cairo(), gradient.get());
    cairo_paint(&screen.cairo());
    screen.mark_changed(kWholeScreen);
    screen.write_large(160, 560, 70, "A gradient behind the text", 0xffffff);
  }

  static void draw_photograph(Screen& screen) {
    draw_head(screen, "A photograph");
    const CairoSurfacePtr photograph = make_photograph();
    cairo_set_source_surface(&screen.cairo(), photograph.get(), kPhotograph.x_px, kPhotograph.y_px);
    cairo_paint(&screen.cairo());
    screen.write_large(1400, 260, 32, "Clouds, with grain", kInk);
  }

  static CairoSurfacePtr make_photograph() {
    CairoSurfacePtr surface = image_surface(CAIRO_FORMAT_RGB24, kPhotograph.width_px,
                                            kPhotograph.height_px, "make a photograph");
    cairo_surface_flush(surface.get());
    std::uint8_t* const bytes = cairo_image_surface_get_data(surface.get());
    const int stride = cairo_image_surface_get_stride(surface.get());
    SampleText random(7);
    for (int y = 0; y < kPhotograph.height_px; ++y) {
      auto* const row = reinterpret_cast<std::uint32_t*>(bytes + std::ptrdiff_t{y} * stride);
      for (int x = 0; x < kPhotograph.width_px; ++x) row[x] = photograph_pixel(x, y, random);
    }
    cairo_surface_mark_dirty(surface.get());
    return surface;
  }

  static Colour photograph_pixel(int x, int y, SampleText& random) {
    double cloud = 0;
    double weight = 0.5;
    for (double scale = 240; scale > 3; scale /= 2, weight /= 2) {
      cloud += weight * SmoothNoise().at(x / scale, y / scale);
    }
    const auto level = [&](double clear, double white) {
      const double grain = random.pick(13) - 6;
      return Colour(std::clamp(clear + cloud * (white - clear) + grain, 0.0, 255.0));
    };
    const Colour red = level(20, 250);
    const Colour green = level(70, 245);
    return red << 16 | green << 8 | level(150, 240);
  }

  static void draw_chart(Screen& screen) {
    draw_head(screen, "A chart");
    for (int i = 0; i < 9; ++i) {
      const int height = 120 + (i * 397) % 560;
      screen.fill({200 + 180 * i, 960 - height, 120, height}, i % 2 == 0 ? kAccent : 0xe07a5f);
      screen.write(240 + 180 * i, 970, std::to_string(2010 + i), kInk);
    }
  }

  static void draw_end(Screen& screen) {
    screen.fill(kWholeScreen, 0x101820);
    screen.write_large(200, 520, 80, "Questions?", 0xffffff);
  }

  SampleText text_{3};
};

}  // namespace

std::unique_ptr<Application> start_slides() { return std::make_unique<Slides>(); }

}  // namespace piblocks::benchmark
