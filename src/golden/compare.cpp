#include <fmt/format.h>
#include <piblocks/compare.hpp>
#include <piblocks/error.hpp>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>

namespace piblocks {
namespace {

/// Where red, green, blue and alpha are in a pixel.
constexpr std::array kShifts = {16, 8, 0, 24};

const std::uint32_t* row_of(const ImageView& image, int y) {
  return reinterpret_cast<const std::uint32_t*>(image.row(y));
}

int delta(std::uint32_t a, std::uint32_t b, int shift) {
  return std::abs(static_cast<int>((a >> shift) & 0xff) - static_cast<int>((b >> shift) & 0xff));
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

/// One bit for each pixel that is off, and the windows over them.
class OffPixels {
 public:
  OffPixels(int width_px, int height_px)
      : width_px_(width_px),
        height_px_(height_px),
        is_off_(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px)) {}

  void add(int x, int y) {
    is_off_[index(x, y)] = 1;
    top_ = std::min(top_, y);
    bottom_ = std::max(bottom_, y);
  }

  /// Counts of the columns of a band of rows, and sums of these, each made from the one before.
  void find_densest(int side_px, Difference& result) const {
    const int width = std::min(side_px, width_px_);
    const int height = std::min(side_px, height_px_);
    std::vector<int> columns(static_cast<std::size_t>(width_px_));
    const auto add_row = [&](int y, int sign) {
      if (y < top_ || y > bottom_) return;
      for (int x = 0; x < width_px_; ++x) columns[std::size_t(x)] += sign * is_off_[index(x, y)];
    };
    for (int y = 0; y < height; ++y) add_row(y, 1);
    for (int y = 0;; ++y) {
      if (y + height > top_ && y <= bottom_) look_along(columns, {0, y, width, height}, result);
      if (y + height >= height_px_) return;
      add_row(y, -1);
      add_row(y + height, 1);
    }
  }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_px_) +
           static_cast<std::size_t>(x);
  }

  void look_along(const std::vector<int>& columns, PixelRect window, Difference& result) const {
    std::int64_t sum = 0;
    for (int x = 0; x < width_px_; ++x) {
      sum += columns[std::size_t(x)];
      if (x >= window.width_px) sum -= columns[std::size_t(x - window.width_px)];
      if (x + 1 < window.width_px || sum <= result.densest_off) continue;
      result.densest_off = sum;
      window.x_px = x + 1 - window.width_px;
      result.densest = window;
    }
  }

  int width_px_;
  int height_px_;
  int top_ = height_px_;
  int bottom_ = -1;
  std::vector<std::uint8_t> is_off_;
};

class Comparison {
 public:
  Comparison(const ImageView& reference, const ImageView& actual, const Tolerance& tolerance,
             std::span<const PixelRect> masks)
      : reference_(reference), actual_(actual), tolerance_(tolerance), mask_(masks) {}

  Difference run() {
    for (int y = 0; y < reference_.height_px; ++y) {
      const std::uint32_t* const a = row_of(reference_, y);
      const std::uint32_t* const b = row_of(actual_, y);
      const auto bytes = static_cast<std::size_t>(reference_.width_px) * sizeof *a;
      if (std::memcmp(a, b, bytes) != 0) compare_row(a, b, y);
    }
    if (off_) off_->find_densest(tolerance_.window.value_or(Window{}).side_px, result_);
    result_.is_accepted = accepts();
    return result_;
  }

 private:
  void compare_row(const std::uint32_t* a, const std::uint32_t* b, int y) {
    for (int x = 0; x < reference_.width_px; ++x) {
      if (a[x] != b[x] && !mask_.hides(x, y)) compare_pixel(a[x], b[x], x, y);
    }
  }

  void compare_pixel(std::uint32_t a, std::uint32_t b, int x, int y) {
    int largest = 0;
    for (std::size_t channel = 0; channel < kShifts.size(); ++channel) {
      const int d = delta(a, b, kShifts[channel]);
      if (d > 0 && result_.largest_delta == 0) {
        result_.first = {x, y, static_cast<int>(channel)};
        result_.largest_delta = d;
      }
      largest = std::max(largest, d);
    }
    ++result_.different_pixels;
    result_.largest_delta = std::max(result_.largest_delta, largest);
    if (largest <= tolerance_.max_delta) return;
    ++result_.off_pixels;
    if (!off_) off_.emplace(reference_.width_px, reference_.height_px);
    off_->add(x, y);
  }

  bool accepts() const {
    return result_.off_pixels <= tolerance_.max_pixels &&
           result_.largest_delta <= tolerance_.hard_delta &&
           (!tolerance_.window || result_.densest_off <= tolerance_.window->max_pixels);
  }

  const ImageView& reference_;
  const ImageView& actual_;
  const Tolerance& tolerance_;
  Mask mask_;
  Difference result_;
  std::optional<OffPixels> off_;  // made when there is something to hold
};

void check(const ImageView& reference, const ImageView& actual, const Tolerance& tolerance) {
  if (reference.width_px != actual.width_px || reference.height_px != actual.height_px) {
    throw UsageError(fmt::format("compare: the images are of different sizes: {}x{} and {}x{}",
                                 reference.width_px, reference.height_px, actual.width_px,
                                 actual.height_px));
  }
  const auto is_level = [](int value) { return value >= 0 && value <= 255; };
  const bool is_valid =
      is_level(tolerance.max_delta) && is_level(tolerance.hard_delta) &&
      tolerance.max_pixels >= 0 &&
      (!tolerance.window || (tolerance.window->side_px >= 1 && tolerance.window->max_pixels >= 0));
  if (!is_valid) throw UsageError("compare: the tolerance is out of range");
}

}  // namespace

Difference compare(const ImageView& reference, const ImageView& actual, const Tolerance& tolerance,
                   std::span<const PixelRect> masks) {
  check(reference, actual, tolerance);
  return Comparison(reference, actual, tolerance, masks).run();
}

}  // namespace piblocks
