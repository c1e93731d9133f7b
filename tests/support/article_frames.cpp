#include "support/article_frames.hpp"

#include <algorithm>
#include <cmath>
#include <random>

namespace piblocks::testing_support {
namespace {

struct Colour {
  double red, green, blue;
};
constexpr Colour kBlack = {0, 0, 0};
constexpr Colour kBlue = {0.2, 0.4, 0.9};
constexpr Colour kRed = {0.9, 0.2, 0.2};

std::uint32_t blend(std::uint32_t pixel, const Colour& colour, double coverage) {
  const auto mix = [&](int shift, double to) {
    const double from = (pixel >> shift) & 0xff;
    return static_cast<std::uint32_t>(std::lround(from + coverage * (255 * to - from))) << shift;
  };
  return 0xff000000 | mix(16, colour.red) | mix(8, colour.green) | mix(0, colour.blue);
}

/// Measures in lines of a 1080-line picture.
class Painter {
 public:
  explicit Painter(Pixels& pixels) : pixels_(pixels), scale_(pixels.height_px / 1080.0) {}

  /// A filled rectangle; a pixel is covered by the part of its area that is inside.
  void fill(double left, double top, double right, double bottom, const Colour& colour) {
    left *= scale_, top *= scale_, right *= scale_, bottom *= scale_;
    const auto covered = [](int at, double low, double high) {
      return std::clamp(std::min(at + 1.0, high) - std::max<double>(at, low), 0.0, 1.0);
    };
    const int end_y = std::min(pixels_.height_px, static_cast<int>(std::ceil(bottom)));
    const int end_x = std::min(pixels_.width_px, static_cast<int>(std::ceil(right)));
    for (int y = std::max(0, static_cast<int>(top)); y < end_y; ++y) {
      for (int x = std::max(0, static_cast<int>(left)); x < end_x; ++x) {
        const double coverage = covered(x, left, right) * covered(y, top, bottom);
        pixels_.at(x, y) = blend(pixels_.at(x, y), colour, coverage);
      }
    }
  }

  void block(double left, const Colour& colour) {
    constexpr double kTop = 600, kSide = 140, kLine = 1.5;
    fill(left, kTop, left + kSide, kTop + kSide, kBlack);
    fill(left + kLine, kTop + kLine, left + kSide - kLine, kTop + kSide - kLine, colour);
  }

  /// A dashed outline.
  void wall() {
    constexpr double kLeft = 160, kRight = 300, kTop = 600, kBottom = 740, kDash = 12, kLine = 2;
    for (double at = 0; at < 140; at += 2 * kDash) {
      fill(kLeft + at, kTop, kLeft + at + kDash, kTop + kLine, kBlack);
      fill(kLeft + at, kBottom - kLine, kLeft + at + kDash, kBottom, kBlack);
      fill(kLeft, kTop + at, kLeft + kLine, kTop + at + kDash, kBlack);
      fill(kRight - kLine, kTop + at, kRight, kTop + at + kDash, kBlack);
    }
  }

  /// Something with the strokes and the spacing of a line of text; another one for each seed.
  void text(double left, double top, int glyphs, std::uint32_t seed) {
    std::minstd_rand random(seed + 1);
    const auto upto = [&](double limit) { return limit * static_cast<double>(random() % 64) / 64; };
    for (int i = 0; i < glyphs; ++i, left += 26) {
      for (int stroke = 0; stroke < 2; ++stroke) {
        const double x = left + upto(14);
        const double y = top + upto(10);
        fill(x, y, x + 3.3, y + 14 + upto(16), kBlack);
        const double bar = top + upto(36);
        fill(left, bar, left + 17, bar + 2.7, kBlack);
      }
    }
  }

 private:
  Pixels& pixels_;
  double scale_;
};

/// Where something is that runs to and fro at constant speed.
double between(double low, double high, double way) {
  const double span = high - low;
  return low + span - std::abs(std::fmod(way, 2 * span) - span);
}

}  // namespace

Pixels article_frame(int width_px, int height_px, double time_s) {
  Pixels pixels(width_px, height_px);
  Painter painter(pixels);
  painter.fill(300, 740, 4000, 742.4, kBlack);
  painter.wall();
  painter.block(between(300, 900, 431.7 * time_s), kBlue);
  painter.block(between(1041, 1500, 173.3 * time_s), kRed);
  painter.text(300, 120, 30, 1);
  const auto collisions = static_cast<std::uint32_t>(time_s * 5);
  painter.text(1300, 120, 3, 1000 + collisions);
  painter.fill(300, 200, 300 + 40 * time_s, 206, kBlue);
  return pixels;
}

Pixels random_frame(int width_px, int height_px, std::uint32_t seed) {
  Pixels pixels(width_px, height_px);
  std::mt19937 random(seed);
  for (std::uint32_t& word : pixels.words) {
    word = 0xff000000 | static_cast<std::uint32_t>(random());
  }
  return pixels;
}

Pixels transparent_frame(int width_px, int height_px, std::uint32_t seed) {
  Pixels pixels(width_px, height_px);
  std::mt19937 random(seed);
  const auto upto = [&](std::uint32_t limit) {
    return static_cast<std::uint32_t>(random() % (limit + 1));
  };
  for (std::uint32_t& word : pixels.words) {
    const std::uint32_t alphas[] = {0, 255, 1 + upto(8), upto(255)};
    const std::uint32_t alpha = alphas[upto(3)];
    word = alpha << 24 | upto(alpha) << 16;
    word |= upto(alpha) << 8;
    word |= upto(alpha);
  }
  return pixels;
}

}  // namespace piblocks::testing_support
