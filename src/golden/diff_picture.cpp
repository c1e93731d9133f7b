#include <algorithm>
#include <array>

#include "golden/reports.hpp"

namespace piblocks {
namespace {

constexpr std::uint32_t kOpaque = 0xff000000;
constexpr std::uint32_t kGap = 0xff808080;
constexpr int kGap_px = 8;

int level(std::uint32_t pixel, int shift) { return static_cast<int>((pixel >> shift) & 0xff); }

std::uint32_t grey(int value) { return kOpaque | static_cast<std::uint32_t>(value) * 0x010101U; }

std::uint32_t pale(std::uint32_t pixel) {
  const int mean = (level(pixel, 16) + 2 * level(pixel, 8) + level(pixel, 0)) / 4;
  return grey(255 - (255 - mean) / 4);
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
