#include "golden/describe.hpp"

#include <fmt/format.h>

#include <array>

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

}  // namespace

std::string describe(const FrameComparison& frame) {
  if (!frame.difference) return frame.is_accepted ? "equal hashes" : "different hashes";
  const Difference& d = *frame.difference;
  if (d.is_equal()) return "equal";
  std::string text = fmt::format(
      "{}, largest delta {}, first at x={} y={} ({})",
      pixels(d.different_pixels, d.different_pixels == 1 ? "differs" : "differ"), d.largest_delta,
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
