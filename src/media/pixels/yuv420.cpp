#include <algorithm>
#include <array>
#include <cassert>

#include "media/pixels/yuv.hpp"

// All arithmetic has 16 bits, since SSE2, which every x86-64 has, is slow at products of 32. GCC
// turns `high_half` into one vector instruction. Buffers of short strips stay in cache.

namespace piblocks {
namespace {

constexpr double kRed = double(kRedWeight) / kAllWeights;
constexpr double kBlue = double(kBlueWeight) / kAllWeights;
constexpr double kGreen = 1 - kRed - kBlue;
// Limited range: 219 steps of luma above 16, 224 of chroma around 128.
constexpr double kLuma = 219.0 / 255;
constexpr double kChroma = 224.0 / 255;

/// A fraction of one in units of 2^-16, rounded.
constexpr int in_65536ths(double value) { return int(value * 65536 + (value < 0 ? -0.5 : 0.5)); }

constexpr auto kLumaRed = std::uint16_t(in_65536ths(kLuma * kRed));
constexpr auto kLumaGreen = std::uint16_t(in_65536ths(kLuma * kGreen));
constexpr auto kLumaBlue = std::uint16_t(in_65536ths(kLuma * kBlue));

/// How much each colour adds to a chroma sample.
struct ChromaWeights {
  std::int16_t red, green, blue;
};
constexpr ChromaWeights kCb = {std::int16_t(in_65536ths(-kChroma * kRed / (2 * (1 - kBlue)))),
                               std::int16_t(in_65536ths(-kChroma* kGreen / (2 * (1 - kBlue)))),
                               std::int16_t(in_65536ths(kChroma / 2))};
constexpr ChromaWeights kCr = {std::int16_t(in_65536ths(kChroma / 2)),
                               std::int16_t(in_65536ths(-kChroma* kGreen / (2 * (1 - kRed)))),
                               std::int16_t(in_65536ths(-kChroma* kBlue / (2 * (1 - kRed))))};

/// floor(a * b / 2^16)
inline std::uint16_t high_half(std::uint16_t a, std::uint16_t b) {
  return std::uint16_t((std::uint32_t{a} * b) >> 16);
}
inline std::int16_t high_half(std::int16_t a, std::int16_t b) {
  return std::int16_t((std::int32_t{a} * b) >> 16);
}

/// Pixels that one pass over a pair of rows takes; even.
constexpr int kStrip_px = 512;

/// Luma of `count` pixels, in 256ths until the last step. The three products are floored, which
/// makes their sum 1.5 too small on average: hence the 1 beside the half.
void convert_luma(const std::uint32_t* __restrict pixels, int count, std::uint8_t* __restrict y) {
  for (int x = 0; x < count; ++x) {
    const std::uint32_t pixel = pixels[x];
    const auto red = std::uint16_t((pixel >> 8) & 0xff00);
    const auto green = std::uint16_t(pixel & 0xff00);
    const auto blue = std::uint16_t((pixel << 8) & 0xff00);
    const auto sum = std::uint16_t(high_half(red, kLumaRed) + high_half(green, kLumaGreen) +
                                   high_half(blue, kLumaBlue));
    y[x] = std::uint8_t(std::uint16_t(sum + 16 * 256 + 128 + 1) >> 8);
  }
}

/// Two rows added up, column by column; entry 0 is the column left of the strip. Red and blue
/// share a word, sixteen bits each, which is enough for the eight samples added up later.
struct ColumnSums {
  std::array<std::uint32_t, kStrip_px + 1> red_blue;
  std::array<std::uint32_t, kStrip_px + 1> green;
};

struct RowPair {
  const std::uint32_t* upper;
  const std::uint32_t* lower;
};

void add_rows(const RowPair& rows, int count, std::uint32_t* __restrict red_blue,
              std::uint32_t* __restrict green) {
  const std::uint32_t* __restrict upper = rows.upper;
  const std::uint32_t* __restrict lower = rows.lower;
  for (int x = 0; x < count; ++x) {
    red_blue[x] = (upper[x] & 0xff00ff) + (lower[x] & 0xff00ff);
    green[x] = ((upper[x] >> 8) & 0xff) + ((lower[x] >> 8) & 0xff);
  }
}

/// One chroma sample in 128ths, from colours that are 128 times their value.
inline std::uint8_t chroma(std::int16_t red, std::int16_t green, std::int16_t blue,
                           ChromaWeights weights) {
  const auto sum = std::int16_t(high_half(red, weights.red) + high_half(green, weights.green) +
                                high_half(blue, weights.blue) + 128 * 128 + 64 + 1);
  return std::uint8_t(sum >> 7);
}

/// The samples of `count` pairs of columns: half the even column, a quarter of each neighbour.
void convert_chroma(const ColumnSums& sums, int count, std::uint8_t* __restrict cb,
                    std::uint8_t* __restrict cr) {
  const std::uint32_t* __restrict red_blue = sums.red_blue.data();
  const std::uint32_t* __restrict greens = sums.green.data();
  for (int i = 0; i < count; ++i) {
    const std::uint32_t both = red_blue[2 * i] + 2 * red_blue[2 * i + 1] + red_blue[2 * i + 2];
    const std::uint32_t eight = greens[2 * i] + 2 * greens[2 * i + 1] + greens[2 * i + 2];
    const auto red = std::int16_t((both >> 16) << 4);
    const auto green = std::int16_t(eight << 4);
    const auto blue = std::int16_t((both & 0xffff) << 4);
    cb[i] = chroma(red, green, blue, kCb);
    cr[i] = chroma(red, green, blue, kCr);
  }
}

const std::uint32_t* pixels_at(const ImageView& image, int x, int y) {
  return reinterpret_cast<const std::uint32_t*>(image.row(y)) + x;
}

/// @param strip  of two rows.
void convert_strip(const ImageView& image, const PixelRect& strip,
                   const YuvView<std::uint8_t>& picture) {
  const int x = strip.x_px;
  const int y = strip.y_px;
  const int count = strip.width_px;
  const std::uint32_t* const upper = pixels_at(image, x, y);
  const std::uint32_t* const lower = pixels_at(image, x, y + 1);
  convert_luma(upper, count, picture.y.row(y) + x);
  convert_luma(lower, count, picture.y.row(y + 1) + x);

  ColumnSums sums;  // NOLINT(cppcoreguidelines-pro-type-member-init): filled where it is read
  const int left = x > 0 ? 1 : 0;  // at the edge the first column stands for its neighbour
  add_rows({upper - left, lower - left}, 1, sums.red_blue.data(), sums.green.data());
  add_rows({upper, lower}, count, sums.red_blue.data() + 1, sums.green.data() + 1);
  convert_chroma(sums, count / 2, picture.cb.row(y / 2) + x / 2, picture.cr.row(y / 2) + x / 2);
}

}  // namespace

PixelRect chroma_aligned(const PixelRect& rect, const ImageView& image) {
  // A chroma sample depends on two rows and on three columns: its own and both beside it.
  const int left = rect.x_px & ~1;
  const int top = rect.y_px & ~1;
  const int right = std::min((rect.right_px() + 2) & ~1, image.width_px);
  const int bottom = (rect.bottom_px() + 1) & ~1;
  return {.x_px = left, .y_px = top, .width_px = right - left, .height_px = bottom - top};
}

void convert_to_yuv420(const ImageView& image, const PixelRect& rect,
                       const YuvView<std::uint8_t>& picture) {
  assert((image.width_px | image.height_px) % 2 == 0);
  assert((rect.x_px | rect.y_px | rect.width_px | rect.height_px) % 2 == 0);
  assert(rect.x_px >= 0 && rect.right_px() <= image.width_px);
  assert(rect.y_px >= 0 && rect.bottom_px() <= image.height_px);

  const int right = rect.right_px();
  const int bottom = rect.bottom_px();
  for (int y = rect.y_px; y < bottom; y += 2) {
    for (int x = rect.x_px; x < right; x += kStrip_px) {
      convert_strip(image, {x, y, std::min(kStrip_px, right - x), 2}, picture);
    }
  }
}

}  // namespace piblocks
