#include <fmt/format.h>
#include <piblocks/compare.hpp>
#include <piblocks/error.hpp>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>

#include "golden/off_pixels.hpp"

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

/// Where red, green, blue and alpha are in a pixel, or what is in their places.
template <typename Word>
constexpr std::array kShifts = {sizeof(Word) * 4, sizeof(Word) * 2, std::size_t{0},
                                sizeof(Word) * 6};

template <typename Word>
int level(Word word, std::size_t channel) {
  constexpr Word kMask = (Word{1} << sizeof(Word) * 2) - 1;
  return static_cast<int>((word >> kShifts<Word>[channel]) & kMask);
}

template <typename Word>
int delta(Word a, Word b, std::size_t channel) {
  return std::abs(level(a, channel) - level(b, channel));
}

/// Which pixels are not compared.
class Mask {
 public:
  explicit Mask(std::span<const PixelRect> rects) : rects_(rects) {}

  bool hides(int x, int y) const {
    return std::ranges::any_of(rects_, [&](const PixelRect& r) {
      return x >= r.x_px && x - r.x_px < r.width_px && y >= r.y_px && y - r.y_px < r.height_px;
    });
  }

 private:
  std::span<const PixelRect> rects_;
};

/// Calls take(a, b, x, y) for each pair of pixels that differ outside the mask, row by row.
template <typename Word, typename Take>
void for_each_difference(const Picture<Word>& reference, const Picture<Word>& actual,
                         const Mask& mask, const Take& take) {
  const auto row_bytes = static_cast<std::size_t>(reference.width_px) * sizeof(Word);
  for (int y = 0; y < reference.height_px; ++y) {
    const Word* const a = reference.row(y);
    const Word* const b = actual.row(y);
    if (std::memcmp(a, b, row_bytes) == 0) continue;
    for (int x = 0; x < reference.width_px; ++x) {
      if (a[x] != b[x] && !mask.hides(x, y)) take(a[x], b[x], x, y);
    }
  }
}

/// How many levels a delta is, of which 255 are the full range: down to a whole number, since
/// deltas of samples are whole.
int levels_of(const Rational& delta, int max_level) {
  return static_cast<int>(floor(delta * max_level / 255).get_si());
}

template <typename Word>
class Comparison {
 public:
  Comparison(const Picture<Word>& reference, const Picture<Word>& actual,
             const Tolerance& tolerance, std::span<const PixelRect> masks)
      : reference_(reference),
        actual_(actual),
        tolerance_(tolerance),
        max_delta_(levels_of(tolerance.max_delta, reference.max_level)),
        mask_(masks) {
    result_.max_level = reference.max_level;
  }

  Difference run() {
    for_each_difference(reference_, actual_, mask_,
                        [this](Word a, Word b, int x, int y) { compare_pixel(a, b, x, y); });
    if (off_) off_->find_densest(tolerance_.window.value_or(Window{}).side_px, result_);
    result_.is_accepted = accepts();
    return result_;
  }

 private:
  void compare_pixel(Word a, Word b, int x, int y) {
    int largest = 0;
    for (std::size_t channel = 0; channel < kShifts<Word>.size(); ++channel) {
      const int d = delta(a, b, channel);
      if (d > 0 && result_.largest_delta == 0) {
        result_.first = {x, y, static_cast<int>(channel)};
        result_.largest_delta = d;
      }
      largest = std::max(largest, d);
    }
    ++result_.different_pixels;
    result_.largest_delta = std::max(result_.largest_delta, largest);
    if (largest <= max_delta_) return;
    ++result_.off_pixels;
    if (!off_) off_.emplace(reference_.width_px, reference_.height_px);
    off_->add(x, y);
  }

  bool accepts() const {
    return result_.off_pixels <= tolerance_.max_pixels &&
           result_.largest_delta <= levels_of(tolerance_.hard_delta, reference_.max_level) &&
           (!tolerance_.window || result_.densest_off <= tolerance_.window->max_pixels);
  }

  const Picture<Word>& reference_;
  const Picture<Word>& actual_;
  const Tolerance& tolerance_;
  int max_delta_;
  Mask mask_;
  Difference result_;
  std::optional<OffPixels> off_;  // made when there is something to hold
};

template <typename Word>
void check_pictures(const Picture<Word>& reference, const Picture<Word>& actual) {
  if (reference.width_px != actual.width_px || reference.height_px != actual.height_px) {
    throw UsageError(fmt::format("compare: the images are of different sizes: {}x{} and {}x{}",
                                 reference.width_px, reference.height_px, actual.width_px,
                                 actual.height_px));
  }
  if (reference.max_level != actual.max_level) {
    throw UsageError(
        fmt::format("compare: the images are of different depths: samples up to {} "
                    "and up to {}",
                    reference.max_level, actual.max_level));
  }
}

void check_tolerance(const Tolerance& tolerance) {
  const auto is_level = [](const Rational& value) { return value >= 0 && value <= 255; };
  const bool is_valid =
      is_level(tolerance.max_delta) && is_level(tolerance.hard_delta) &&
      tolerance.max_pixels >= 0 &&
      (!tolerance.window || (tolerance.window->side_px >= 1 && tolerance.window->max_pixels >= 0));
  if (!is_valid) throw UsageError("compare: the tolerance is out of range");
}

template <typename Word>
Difference compare_pictures(const Picture<Word>& reference, const Picture<Word>& actual,
                            const Tolerance& tolerance, std::span<const PixelRect> masks) {
  check_pictures(reference, actual);
  check_tolerance(tolerance);
  return Comparison<Word>(reference, actual, tolerance, masks).run();
}

template <typename Word>
std::vector<std::uint8_t> deltas_of(const Picture<Word>& reference, const Picture<Word>& actual,
                                    std::span<const PixelRect> masks) {
  check_pictures(reference, actual);
  const auto width = static_cast<std::size_t>(reference.width_px);
  std::vector<std::uint8_t> deltas(width * static_cast<std::size_t>(reference.height_px));
  for_each_difference(reference, actual, Mask(masks), [&](Word a, Word b, int x, int y) {
    int largest = 0;
    for (std::size_t channel = 0; channel < kShifts<Word>.size(); ++channel) {
      largest = std::max(largest, delta(a, b, channel));
    }
    deltas[static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)] =
        static_cast<std::uint8_t>((largest * 255 + reference.max_level - 1) / reference.max_level);
  });
  return deltas;
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
                                       std::span<const PixelRect> masks) {
  return deltas_of(picture_of(reference.view()), picture_of(actual.view()), masks);
}

std::vector<std::uint8_t> pixel_deltas(const DeepImage& reference, const DeepImage& actual,
                                       std::span<const PixelRect> masks) {
  return deltas_of(picture_of(reference), picture_of(actual), masks);
}

}  // namespace piblocks
