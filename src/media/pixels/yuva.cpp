#include <cassert>
#include <cstring>

#include "media/pixels/yuv.hpp"

namespace piblocks {
namespace {

/// Sums of samples multiplied by alpha, and of the alphas.
struct Sums {
  std::int64_t red = 0;
  std::int64_t green = 0;
  std::int64_t blue = 0;
  std::int64_t alpha = 0;

  friend bool operator==(const Sums&, const Sums&) = default;
};

std::int64_t rounded_quotient(std::int64_t dividend, std::int64_t divisor) {
  const std::int64_t twice = 2 * dividend + divisor;
  const std::int64_t quotient = twice / (2 * divisor);
  return twice % (2 * divisor) < 0 ? quotient - 1 : quotient;
}

/// Luma times kAllWeights.
std::int64_t weighted_sum(const Sums& c) {
  return kRedWeight * c.red + (kAllWeights - kRedWeight - kBlueWeight) * c.green +
         kBlueWeight * c.blue;
}

/// Limited range: `steps` of luma above black.
std::int64_t luma(const Sums& c, std::int64_t steps) {
  return c.alpha == 0 ? 0 : rounded_quotient(steps * weighted_sum(c), kAllWeights * c.alpha);
}

/// Limited range: `steps` of chroma from one end to the other.
/// @param sample, weight  of blue for Cb, of red for Cr.
std::int64_t chroma(const Sums& c, std::int64_t sample, std::int64_t weight, std::int64_t steps) {
  if (c.alpha == 0) return 0;
  return rounded_quotient(steps * (kAllWeights * sample - weighted_sum(c)),
                          2 * (kAllWeights - weight) * c.alpha);
}
std::int64_t cb_of(const Sums& c, std::int64_t steps) {
  return chroma(c, c.blue, kBlueWeight, steps);
}
std::int64_t cr_of(const Sums& c, std::int64_t steps) {
  return chroma(c, c.red, kRedWeight, steps);
}

/// Reads the pixels of one picture.
class Reader {
 public:
  explicit Reader(const ImageView& image)
      : image_(image), opaque_(image.has_alpha ? 0 : 0xff000000) {}

  std::uint32_t word(int x, int y) const {
    std::uint32_t word = 0;
    std::memcpy(&word, image_.row(y) + std::ptrdiff_t{4} * x, sizeof word);
    return word | opaque_;
  }
  void add(int x, int y, std::int64_t weight, Sums& sums) const {
    const std::uint32_t pixel = word(x, y);
    sums.red += weight * (pixel >> 16 & 0xff);
    sums.green += weight * (pixel >> 8 & 0xff);
    sums.blue += weight * (pixel & 0xff);
    sums.alpha += weight * (pixel >> 24);
  }

 private:
  const ImageView& image_;
  std::uint32_t opaque_;
};

struct Sample444 {
  std::uint16_t y, cb, cr, alpha;
};

Sample444 sample_444(const Sums& c) {
  return {std::uint16_t(64 + luma(c, 876)), std::uint16_t(512 + cb_of(c, 896)),
          std::uint16_t(512 + cr_of(c, 896)), std::uint16_t(rounded_quotient(1023 * c.alpha, 255))};
}

void convert_luma_420(const Reader& reader, const PixelRect& rect, int y,
                      const YuvView<std::uint8_t>& picture) {
  std::uint32_t last = 0;
  std::uint8_t value = 16;
  for (int x = rect.x_px; x < rect.right_px(); ++x) {
    const std::uint32_t word = reader.word(x, y);
    if (word != last) {
      Sums pixel;
      reader.add(x, y, 1, pixel);
      value = std::uint8_t(16 + luma(pixel, 219));
      last = word;
    }
    picture.y.row(y)[x] = value;
    picture.alpha.row(y)[x] = std::uint8_t(word >> 24);
  }
}

void convert_chroma_420(const Reader& reader, const PixelRect& rect, int y,
                        const YuvView<std::uint8_t>& picture) {
  Sums last;
  std::uint8_t cb = 128;
  std::uint8_t cr = 128;
  for (int x = rect.x_px; x < rect.right_px(); x += 2) {
    Sums sums;
    for (const int line : {y, y + 1}) {
      reader.add(x > 0 ? x - 1 : x, line, 1, sums);
      reader.add(x, line, 2, sums);
      reader.add(x + 1, line, 1, sums);
    }
    if (sums != last) {
      cb = std::uint8_t(128 + cb_of(sums, 224));
      cr = std::uint8_t(128 + cr_of(sums, 224));
      last = sums;
    }
    picture.cb.row(y / 2)[x / 2] = cb;
    picture.cr.row(y / 2)[x / 2] = cr;
  }
}

}  // namespace

void convert_to_yuva444p10(const ImageView& image, const PixelRect& rect,
                           const YuvView<std::uint16_t>& picture) {
  const Reader reader(image);
  std::uint32_t last = 0;
  Sample444 sample = sample_444({});
  for (int y = rect.y_px; y < rect.bottom_px(); ++y) {
    for (int x = rect.x_px; x < rect.right_px(); ++x) {
      const std::uint32_t word = reader.word(x, y);
      if (word != last) {
        Sums pixel;
        reader.add(x, y, 1, pixel);
        sample = sample_444(pixel);
        last = word;
      }
      picture.y.row(y)[x] = sample.y;
      picture.cb.row(y)[x] = sample.cb;
      picture.cr.row(y)[x] = sample.cr;
      if (picture.alpha.samples != nullptr) picture.alpha.row(y)[x] = sample.alpha;
    }
  }
}

void convert_to_yuva420(const ImageView& image, const PixelRect& rect,
                        const YuvView<std::uint8_t>& picture) {
  assert((image.width_px | image.height_px) % 2 == 0);
  assert((rect.x_px | rect.y_px | rect.width_px | rect.height_px) % 2 == 0);
  const Reader reader(image);
  for (int y = rect.y_px; y < rect.bottom_px(); y += 2) {
    convert_luma_420(reader, rect, y, picture);
    convert_luma_420(reader, rect, y + 1, picture);
    convert_chroma_420(reader, rect, y, picture);
  }
}

}  // namespace piblocks
