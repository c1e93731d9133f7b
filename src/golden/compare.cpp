#include <fmt/format.h>
#include <piblocks/compare.hpp>
#include <piblocks/error.hpp>

#include <algorithm>
#include <array>
#include <cstring>
#include <numeric>
#include <optional>
#include <type_traits>
#include <utility>

#include "golden/packed_rows.hpp"
#include "golden/perceptual.hpp"

namespace piblocks {
namespace {

/// Rows of pixels at any depth: a word has four samples, alpha in the highest bits.
template <typename Word>
struct Picture {
  const std::uint8_t* data;
  int width_px;
  int height_px;
  std::ptrdiff_t stride_bytes;
  int max_level;

  const Word* row(int y) const { return reinterpret_cast<const Word*>(data + y * stride_bytes); }
};

Picture<std::uint32_t> picture_of(const ImageView& image) {
  return {image.data, image.width_px, image.height_px, image.stride_bytes, 255};
}

Picture<std::uint64_t> picture_of(const DeepImage& image) {
  constexpr std::ptrdiff_t kBytes = sizeof(std::uint64_t);
  return {reinterpret_cast<const std::uint8_t*>(image.words.data()), image.width_px,
          image.height_px, kBytes * image.width_px, image.max_level};
}

/// Rows of packed pixels, of which only those that are asked for are unpacked.
struct PackedRows {
  const PackedImage& image;
  int width_px = image.width_px;
  int height_px = image.height_px;
  int max_level = 255;
  mutable std::vector<std::uint32_t> words = std::vector<std::uint32_t>(std::size_t(width_px));

  const std::uint32_t* row(int y) const {
    image.unpack_row(y, words.data());
    return words.data();
  }
};

PackedRows picture_of(const PackedImage& image) { return {image}; }

template <typename Word>
bool has_equal_rows(const Picture<Word>& reference, const Picture<Word>& actual, int y) {
  return std::memcmp(reference.row(y), actual.row(y),
                     static_cast<std::size_t>(reference.width_px) * sizeof(Word)) == 0;
}

bool has_equal_rows(const PackedRows& reference, const PackedRows& actual, int y) {
  const PackedImage& a = reference.image;
  const PackedImage& b = actual.image;
  return a.is_packed_as(b) &&
         (a.bytes == b.bytes || std::memcmp(a.row(y), b.row(y), a.row_bytes()) == 0);
}

template <typename Word>
using Level = std::conditional_t<sizeof(Word) == 4, std::uint8_t, std::uint16_t>;

/// The largest delta of the samples of each pixel. Every loop becomes vector instructions for
/// single samples, which are four times as fast as those for words.
template <typename Word>
void find_deltas(const Word* a, const Word* b, std::vector<Level<Word>>& deltas) {
  using Sample = Level<Word>;
  constexpr std::size_t kSamples = 4;
  constexpr std::size_t kPixels = 64;
  std::array<Sample, kSamples* kPixels> one = {};
  std::array<Sample, kSamples* kPixels> other = {};
  std::array<Sample, kSamples* kPixels> delta = {};
  for (std::size_t begin = 0; begin < deltas.size(); begin += kPixels) {
    const std::size_t count = std::min(kPixels, deltas.size() - begin);
    std::memcpy(one.data(), a + begin, count * sizeof(Word));
    std::memcpy(other.data(), b + begin, count * sizeof(Word));
    for (std::size_t i = 0; i < delta.size(); ++i) {
      delta[i] = static_cast<Sample>(std::max(one[i], other[i]) - std::min(one[i], other[i]));
    }
    for (std::size_t i = 0; i + 1 < delta.size(); ++i) delta[i] = std::max(delta[i], delta[i + 1]);
    for (std::size_t i = 0; i + 2 < delta.size(); ++i) delta[i] = std::max(delta[i], delta[i + 2]);
    Sample* const to = deltas.data() + begin;
    for (std::size_t x = 0; x < count; ++x) to[x] = delta[kSamples * x];
  }
}

/// Sets deltas inside the masks to 0. @returns how many were not.
template <typename Level>
std::int64_t clear_masked(std::span<const PixelRect> masks, int y, std::vector<Level>& deltas) {
  std::int64_t cleared = 0;
  for (const PixelRect& r : masks) {
    if (y < r.y_px || y - r.y_px >= r.height_px) continue;
    const auto right =
        std::min<std::int64_t>(std::int64_t{r.x_px} + r.width_px, std::ssize(deltas));
    for (std::int64_t x = std::max(r.x_px, 0); x < right; ++x) {
      cleared += std::exchange(deltas[static_cast<std::size_t>(x)], Level{0}) != 0 ? 1 : 0;
    }
  }
  return cleared;
}

/// Whether the masks together cover the whole picture. It is enough to check the first row and the
/// rows at the edges of masks: from edge to edge, all rows have the same masks.
bool cover_all(std::span<const PixelRect> masks, int width_px, int height_px) {
  std::vector<PixelRect> from_left(masks.begin(), masks.end());
  std::ranges::sort(from_left, {}, &PixelRect::x_px);
  const auto is_row_covered = [&](std::int64_t y) {
    std::int64_t end = 0;
    for (const PixelRect& r : from_left) {
      if (y < r.y_px || y - r.y_px >= r.height_px || r.x_px > end) continue;
      end = std::max(end, std::int64_t{r.x_px} + r.width_px);
    }
    return end >= width_px;
  };
  if (!is_row_covered(0)) return false;
  return std::ranges::all_of(masks, [&](const PixelRect& r) {
    const std::int64_t bottom = std::int64_t{r.y_px} + r.height_px;
    const auto is_inside = [&](std::int64_t y) { return y >= 0 && y < height_px; };
    return (!is_inside(r.y_px) || is_row_covered(r.y_px)) &&
           (!is_inside(bottom) || is_row_covered(bottom));
  });
}

/// Calls take(y, deltas) for each row in which pixels differ outside the masks: what find_deltas()
/// finds. @returns the number of pixels that differ inside the masks.
/// @throws UsageError if the pictures are of different sizes or depths.
template <typename Rows, typename Take>
std::int64_t for_each_difference(const Rows& reference, const Rows& actual,
                                 std::span<const PixelRect> masks, bool ignores_transparent,
                                 const Take& take) {
  if (reference.width_px != actual.width_px || reference.height_px != actual.height_px) {
    throw UsageError(fmt::format("compare: the images are of different sizes: {}x{} and {}x{}",
                                 reference.width_px, reference.height_px, actual.width_px,
                                 actual.height_px));
  }
  if (reference.max_level != actual.max_level) {
    throw UsageError(
        fmt::format("compare: the images are of different depths: samples up to {} and up to {}",
                    reference.max_level, actual.max_level));
  }
  using Word = std::remove_cvref_t<decltype(*reference.row(0))>;
  std::vector<Level<Word>> deltas(static_cast<std::size_t>(reference.width_px));
  std::int64_t masked = 0;
  for (int y = 0; y < reference.height_px; ++y) {
    if (has_equal_rows(reference, actual, y)) continue;
    const Word* const a = reference.row(y);
    const Word* const b = actual.row(y);
    find_deltas(a, b, deltas);
    for (std::size_t x = 0; ignores_transparent && x < deltas.size(); ++x) {
      if (sample_of(a[x] | b[x], 3) == 0) deltas[x] = 0;
    }
    masked += clear_masked(masks, y, deltas);
    take(y, std::as_const(deltas));
  }
  return masked;
}

/// The pixels that are off, and the window that has the most of them.
class OffPixels {
 public:
  OffPixels(int width_px, int height_px)
      : width_px_(width_px),
        height_px_(height_px),
        top_(height_px),
        is_off_(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px)) {}

  /// @param is_off  of each pixel of the row, 1 or 0
  void add(int y, const std::vector<std::uint8_t>& is_off) {
    std::ranges::copy(is_off, is_off_.begin() + std::ptrdiff_t{y} * width_px_);
    top_ = std::min(top_, y);
    bottom_ = std::max(bottom_, y);
  }
  /// Finds the first of the squares of this side with the most pixels: densest, densest_off.
  void find_densest(int side_px, Difference& result) const;

 private:
  void add_row(int y, int sign, std::vector<int>& columns) const;
  static void look_along(const std::vector<int>& columns, PixelRect window, Difference& result);

  int width_px_;
  int height_px_;
  int top_;
  int bottom_ = -1;
  std::vector<std::uint8_t> is_off_;
};

/// Moves a band of rows down the picture, and a window along the band's columns. The count of each
/// column is made from the one before, and so is that of each window.
void OffPixels::find_densest(int side_px, Difference& result) const {
  const int width = std::min(side_px, width_px_);
  const int height = std::min(side_px, height_px_);
  std::vector<int> columns(static_cast<std::size_t>(width_px_));
  for (int y = 0; y < height; ++y) add_row(y, 1, columns);
  for (int y = 0;; ++y) {
    if (y + height > top_ && y <= bottom_) look_along(columns, {0, y, width, height}, result);
    if (y + height >= height_px_) return;
    add_row(y, -1, columns);
    add_row(y + height, 1, columns);
  }
}

void OffPixels::add_row(int y, int sign, std::vector<int>& columns) const {
  if (y < top_ || y > bottom_) return;
  // Local copies: else the compiler loads members again after every write to a column.
  const int count = width_px_;
  const std::uint8_t* const row = is_off_.data() + std::ptrdiff_t{y} * count;
  int* const column = columns.data();
  for (int x = 0; x < count; ++x) column[x] += sign * row[x];
}

void OffPixels::look_along(const std::vector<int>& columns, PixelRect window, Difference& result) {
  const auto width = static_cast<std::size_t>(window.width_px);
  int sum = 0;
  for (std::size_t x = 0; x < columns.size(); ++x) {
    sum += columns[x];
    if (x >= width) sum -= columns[x - width];
    if (x + 1 < width || sum <= result.densest_off) continue;
    result.densest_off = sum;
    window.x_px = static_cast<int>(x + 1 - width);
    result.densest = window;
  }
}

void check_tolerance(const Tolerance& tolerance) {
  const auto is_level = [](const Rational& value) { return value >= 0 && value <= 255; };
  const bool is_valid =
      is_level(tolerance.max_delta) && is_level(tolerance.hard_delta) &&
      tolerance.max_pixels >= 0 && tolerance.max_share >= 0 && tolerance.max_share <= 1 &&
      (!tolerance.threshold || (*tolerance.threshold >= 0 && *tolerance.threshold <= 1)) &&
      (!tolerance.window || (tolerance.window->side_px >= 1 && tolerance.window->max_pixels >= 0));
  if (!is_valid) throw UsageError("compare: the tolerance is out of range");
}

/// The number of whole levels in a delta, of which 255 are the full range.
int levels_of(const Rational& delta, int max_level) {
  return static_cast<int>(floor(delta * max_level / 255).get_si());
}

/// Counts what differs, row by row.
template <typename Rows>
class Counter {
 public:
  Counter(const Rows& reference, const Rows& actual, const Tolerance& tolerance)
      : reference_(reference),
        actual_(actual),
        max_delta_(levels_of(tolerance.max_delta, reference.max_level)),
        is_off_(static_cast<std::size_t>(reference.width_px)) {
    if (tolerance.threshold) {
      perceptual_.emplace(reference, actual, *tolerance.threshold, !tolerance.counts_antialiasing);
    }
    result_.max_level = reference.max_level;
  }

  template <typename Level>
  void take(int y, const std::vector<Level>& deltas) {
    // Loops without a branch become vector instructions.
    std::int32_t different = 0;
    Level largest = 0;
    for (const Level delta : deltas) {
      different += delta != 0 ? 1 : 0;
      largest = std::max(largest, delta);
    }
    if (different == 0) return;
    if (result_.different_pixels == 0) result_.first = first_of(y, deltas);
    result_.different_pixels += different;
    result_.largest_delta = std::max(result_.largest_delta, int{largest});
    const std::int64_t off = mark_off(y, deltas);
    if (off == 0) return;
    result_.off_pixels += off;
    if (!off_) off_.emplace(reference_.width_px, reference_.height_px);
    off_->add(y, is_off_);
  }
  Difference finish(int window_px) {
    if (off_) off_->find_densest(window_px, result_);
    return result_;
  }

 private:
  template <typename Level>
  SamplePlace first_of(int y, const std::vector<Level>& deltas) const {
    const auto x =
        std::ranges::find_if(deltas, [](Level delta) { return delta != 0; }) - deltas.begin();
    const auto changed = reference_.row(y)[x] ^ actual_.row(y)[x];
    constexpr std::array<std::size_t, 4> kPlaces = {2, 1, 0, 3};  // of red, green, blue and alpha
    const auto channel = std::ranges::find_if(
        kPlaces, [&](std::size_t place) { return sample_of(changed, place) != 0; });
    return {static_cast<int>(x), y, static_cast<int>(channel - kPlaces.begin())};
  }
  /// @returns how many pixels of the row are off, which is_off_ says of each.
  template <typename Level>
  std::int64_t mark_off(int y, const std::vector<Level>& deltas) {
    const auto max_delta = static_cast<Level>(max_delta_);
    if (perceptual_) {
      for (std::size_t x = 0; x < deltas.size(); ++x) {
        is_off_[x] = deltas[x] != 0 && perceptual_->is_off(static_cast<int>(x), y);
      }
    } else {
      std::ranges::transform(deltas, is_off_.begin(),
                             [&](Level delta) { return delta > max_delta; });
    }
    return std::accumulate(is_off_.begin(), is_off_.end(), 0);
  }

  const Rows& reference_;
  const Rows& actual_;
  int max_delta_;
  std::optional<Perceptual<Rows>> perceptual_;
  std::vector<std::uint8_t> is_off_;  // of a row
  std::optional<OffPixels> off_;      // most frames need none
  Difference result_;
};

template <typename Rows>
Difference compare_pictures(const Rows& reference, const Rows& actual, const Tolerance& tolerance,
                            std::span<const PixelRect> masks) {
  check_tolerance(tolerance);
  if (cover_all(masks, reference.width_px, reference.height_px)) {
    throw UsageError(fmt::format("compare: the masks leave nothing of a picture of {}x{}",
                                 reference.width_px, reference.height_px));
  }
  Counter counter(reference, actual, tolerance);
  const std::int64_t masked =
      for_each_difference(reference, actual, masks, tolerance.ignores_transparent,
                          [&](int y, const auto& deltas) { counter.take(y, deltas); });
  Difference result = counter.finish(tolerance.window.value_or(Window{}).side_px);
  result.masked_pixels = masked;
  const Rational pixels = Rational(reference.width_px) * reference.height_px;
  result.is_accepted =
      result.off_pixels <= tolerance.max_pixels &&
      to_integer(result.off_pixels) <= tolerance.max_share * pixels &&
      result.largest_delta <= levels_of(tolerance.hard_delta, reference.max_level) &&
      (!tolerance.window || result.densest_off <= tolerance.window->max_pixels);
  return result;
}

template <typename Rows>
std::vector<std::uint8_t> largest_deltas(const Rows& reference, const Rows& actual,
                                         std::span<const PixelRect> masks,
                                         bool ignores_transparent) {
  const int max_level = reference.max_level;
  const auto width = static_cast<std::size_t>(reference.width_px);
  std::vector<std::uint8_t> largest(width * static_cast<std::size_t>(reference.height_px));
  for_each_difference(
      reference, actual, masks, ignores_transparent, [&](int y, const auto& deltas) {
        std::ranges::transform(deltas, largest.begin() + y * std::ssize(deltas), [&](int delta) {
          return static_cast<std::uint8_t>((delta * 255 + max_level - 1) / max_level);
        });
      });
  return largest;
}

}  // namespace

Difference compare(const ImageView& reference, const ImageView& actual, const Tolerance& tolerance,
                   std::span<const PixelRect> masks) {
  return compare_pictures(picture_of(reference), picture_of(actual), tolerance, masks);
}

Difference compare(const DeepImage& reference, const DeepImage& actual, const Tolerance& tolerance,
                   std::span<const PixelRect> masks) {
  return compare_pictures(picture_of(reference), picture_of(actual), tolerance, masks);
}

std::vector<std::uint8_t> pixel_deltas(const Image& reference, const Image& actual,
                                       std::span<const PixelRect> masks, bool ignores_transparent) {
  return largest_deltas(picture_of(reference.view()), picture_of(actual.view()), masks,
                        ignores_transparent);
}

std::vector<std::uint8_t> pixel_deltas(const DeepImage& reference, const DeepImage& actual,
                                       std::span<const PixelRect> masks, bool ignores_transparent) {
  return largest_deltas(picture_of(reference), picture_of(actual), masks, ignores_transparent);
}

Difference compare(const PackedImage& reference, const PackedImage& actual,
                   const Tolerance& tolerance, std::span<const PixelRect> masks) {
  if (tolerance.threshold) {  // looks at the rows around, too
    return compare(unpacked(reference).view(), unpacked(actual).view(), tolerance, masks);
  }
  return compare_pictures(picture_of(reference), picture_of(actual), tolerance, masks);
}

std::vector<std::uint8_t> pixel_deltas(const PackedImage& reference, const PackedImage& actual,
                                       std::span<const PixelRect> masks, bool ignores_transparent) {
  return largest_deltas(picture_of(reference), picture_of(actual), masks, ignores_transparent);
}

}  // namespace piblocks
