#include <fmt/format.h>
#include <piblocks/exact.hpp>

#include <array>

#include "golden/reports.hpp"

namespace piblocks {
namespace {

const char* channel_name(const FrameComparison& frame, int channel) {
  constexpr std::array kRgb = {"red", "green", "blue", "alpha"};
  constexpr std::array kYuv = {"Y", "Cb", "Cr", "alpha"};
  return (frame.is_yuv ? kYuv : kRgb).at(static_cast<std::size_t>(channel));
}

std::string pixels(std::int64_t count, const char* what) {
  return fmt::format("{} {} {}", count, count == 1 ? "pixel" : "pixels", what);
}

/// So many decimals that three digits are written, but at most five decimals.
int decimals_of(const Rational& value) {
  int decimals = 0;
  for (Rational scaled = value; scaled < 100 && decimals < 5; scaled *= 10) ++decimals;
  return decimals;
}

/// "3 of 255", and for deeper samples "0.250 of 255 (1 of 1023)". It is rounded up, so that the
/// printed number, as a tolerance, accepts the delta.
std::string largest_delta(const Difference& d) {
  if (d.max_level == 255) return fmt::format("{} of 255", d.largest_delta);
  const Rational delta = Rational(d.largest_delta) * 255 / d.max_level;
  const int decimals = decimals_of(delta);
  const Rational unit = power(Rational(10), static_cast<unsigned long>(decimals));
  return fmt::format("{:.{}f} of 255 ({} of {})", to_double(Rational(ceil(delta * unit)) / unit),
                     decimals, d.largest_delta, d.max_level);
}

}  // namespace

std::string difference_text(const FrameComparison& frame) {
  if (!frame.difference) return frame.is_accepted ? "equal hashes" : "different hashes";
  const Difference& d = *frame.difference;
  if (d.is_equal()) return "equal";
  std::string text = fmt::format(
      "{}, largest delta {}, first at x={} y={} ({})",
      pixels(d.different_pixels, d.different_pixels == 1 ? "differs" : "differ"), largest_delta(d),
      d.first.x_px, d.first.y_px, channel_name(frame, d.first.channel));
  if (d.off_pixels != d.different_pixels) {
    text += fmt::format(", {} beyond the accepted delta", d.off_pixels);
  }
  if (d.off_pixels > 0) {
    text += fmt::format(", densest {}x{} window at x={} y={}: {}", d.densest.width_px,
                        d.densest.height_px, d.densest.x_px, d.densest.y_px, d.densest_off);
  }
  if (d.is_accepted) text += ", within tolerance";
  return text;
}

}  // namespace piblocks
