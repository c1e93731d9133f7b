#include "golden/difference.hpp"

#include <fmt/format.h>
#include <piblocks/exact.hpp>

#include <algorithm>
#include <array>

namespace piblocks {
namespace {

const char* channel_name(const FrameComparison& frame, int channel) {
  constexpr std::array kRgb = {"red", "green", "blue", "alpha"};
  constexpr std::array kYuv = {"Y", "Cb", "Cr", "alpha"};
  return (frame.is_yuv ? kYuv : kRgb).at(static_cast<std::size_t>(channel));
}

std::string differing(std::int64_t pixels) {
  return fmt::format("{} {}", pixels, pixels == 1 ? "pixel differs" : "pixels differ");
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

std::string differing_pixels(const FrameComparison& frame, const Difference& d) {
  std::string text = fmt::format("{}, largest delta {}, first at x={} y={} ({})",
                                 differing(d.different_pixels), largest_delta(d), d.first.x_px,
                                 d.first.y_px, channel_name(frame, d.first.channel));
  if (d.off_pixels != d.different_pixels) {
    text += fmt::format(", {} beyond the accepted delta", d.off_pixels);
    if (d.off_pixels == 0 && !d.is_accepted) text += ", the largest beyond the hard limit";
  }
  if (d.off_pixels > 0) {
    text += fmt::format(", densest {}x{} window at x={} y={}: {}", d.densest.width_px,
                        d.densest.height_px, d.densest.x_px, d.densest.y_px, d.densest_off);
  }
  return text;
}

constexpr std::uint32_t kOpaque = 0xff000000;
constexpr std::uint32_t kGap = 0xff808080;
constexpr int kGap_px = 8;

int level(std::uint32_t pixel, int shift) { return static_cast<int>((pixel >> shift) & 0xff); }

std::uint32_t grey(int value) { return kOpaque | static_cast<std::uint32_t>(value) * 0x010101U; }

std::uint32_t pale(std::uint32_t pixel) {
  const int mean = (level(pixel, 16) + 2 * level(pixel, 8) + level(pixel, 0)) / 4;
  return grey(255 - (255 - mean) * level(pixel, 24) / 255 / 4);
}

/// Red, so that even the least delta can be seen.
std::uint32_t mark(int delta) {
  const auto other = static_cast<std::uint32_t>(160 - 160 * delta / 255);
  return kOpaque | 0xff0000U | other << 8 | other;
}

Image part_of(const Image& image, int x_px, int width_px) {
  Image part{width_px, image.height_px, {}};
  for (int y = 0; y < image.height_px; ++y) {
    const auto row = image.words.begin() + std::ptrdiff_t{y} * image.width_px + x_px;
    part.words.insert(part.words.end(), row, row + width_px);
  }
  return part;
}

Image beside_each_other(const std::array<Image, 3>& images) {
  Image strip{3 * images[0].width_px + 2 * kGap_px, images[0].height_px, {}};
  for (int y = 0; y < strip.height_px; ++y) {
    for (std::size_t i = 0; i < images.size(); ++i) {
      if (i > 0) strip.words.insert(strip.words.end(), kGap_px, kGap);
      const Image& image = images.at(i);
      const auto row = image.words.begin() + std::ptrdiff_t{y} * image.width_px;
      strip.words.insert(strip.words.end(), row, row + image.width_px);
    }
  }
  return strip;
}

}  // namespace

std::string difference_text(const FrameComparison& frame) {
  if (!frame.problem.empty()) return frame.problem;
  if (!frame.difference) {
    const bool is_compared = frame.outcome <= Outcome::different;
    return std::string(name_of(frame.outcome)) + (is_compared ? " hashes" : "");
  }
  const Difference& d = *frame.difference;
  std::string text = "equal";
  if (!d.is_equal()) text = differing_pixels(frame, d);
  if (d.masked_pixels > 0) text += fmt::format(", {} in the masks", differing(d.masked_pixels));
  if (d.is_accepted && !d.is_equal()) text += ", within tolerance";
  return text;
}

std::string row_text(const FrameComparison& frame) {
  const std::string text = difference_text(frame);
  const bool has_name =
      frame.outcome == Outcome::unreadable && text.find(frame.name) != std::string::npos;
  return has_name ? text : fmt::format("{}: {}", frame.name, text);
}

std::string summary_text(const ComparisonJob& job, const ComparisonResult& result) {
  const Outcome worst = result.worst();
  std::string text = name_of(worst);
  if (worst > Outcome::different && worst < Outcome::unreadable) text = name_of(Outcome::different);
  if (result.reference_frames == 0 && worst < Outcome::unreadable) {
    if (result.actual_frames == 0) return "nothing to compare";
    text = "no reference";
  }
  const char* separator = ": ";
  const auto add = [&](const std::string& part) {
    text += separator + part;
    separator = ", ";
  };
  if (const std::int64_t compared = result.compared_frames(); compared > 0) {
    add(fmt::format("{} of {} frames differ{}", result.different_frames, compared,
                    job.masks.empty() ? "" : " outside of the masks"));
    if (result.masked_frames > 0) add(fmt::format("{} in them", result.masked_frames));
    const std::int64_t beyond = result.count(Outcome::different);
    if (beyond != result.different_frames) add(fmt::format("{} beyond tolerance", beyond));
  }
  for (const Outcome outcome :
       {Outcome::unreadable, Outcome::mismatch, Outcome::missing, Outcome::added}) {
    const std::int64_t count = result.count(outcome);
    if (count > 0) add(fmt::format("{} {}", count, name_of(outcome)));
  }
  return text;
}

Image difference_picture(const Image& reference, const std::vector<std::uint8_t>& deltas) {
  Image picture{reference.width_px, reference.height_px, {}};
  picture.words.resize(reference.words.size());
  std::ranges::transform(
      reference.words, deltas, picture.words.begin(),
      [](std::uint32_t a, std::uint8_t delta) { return delta == 0 ? pale(a) : mark(delta); });
  return picture;
}

Image difference_strip(const Image& reference, const std::vector<std::uint8_t>& deltas,
                       const Image& actual, const PixelRect& focus) {
  constexpr std::int64_t kLongest_px = (kMaxSide_px - 2 * kGap_px) / 3;
  // Three pictures and the gaps in one frame.
  const std::int64_t most_px = kMaxFrame_px / 3 / reference.height_px - kGap_px;
  const int width = static_cast<int>(
      std::clamp<std::int64_t>(std::min(kLongest_px, most_px), 1, reference.width_px));
  const int centre = focus.x_px + focus.width_px / 2;
  const int x = std::clamp(centre - width / 2, 0, reference.width_px - width);
  return beside_each_other({part_of(reference, x, width),
                            part_of(difference_picture(reference, deltas), x, width),
                            part_of(actual, x, width)});
}

}  // namespace piblocks
