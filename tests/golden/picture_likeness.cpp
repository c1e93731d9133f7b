#include "golden/picture_likeness.hpp"

#include <cairo.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <stdexcept>

namespace piblocks::testing_support {
namespace {

constexpr int kReach_px = 2;
constexpr int kWindow_px = 8;
/// Samples around that differ by no more are even.
constexpr int kEven = 8;

struct SurfaceDeleter {
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
};
using SurfacePtr = std::unique_ptr<cairo_surface_t, SurfaceDeleter>;

/// One channel of a picture, as numbers that can be summed.
struct Plane {
  int width;
  int height;
  std::vector<int> values;

  int& at(int x, int y) { return values[std::size_t(y) * std::size_t(width) + std::size_t(x)]; }
  int at(int x, int y) const {
    return values[std::size_t(y) * std::size_t(width) + std::size_t(x)];
  }
};

Plane channel_of(const Samples& picture, int channel) {
  Plane plane{picture.width_px, picture.height_px, {}};
  for (int y = 0; y < plane.height; ++y) {
    for (int x = 0; x < plane.width; ++x) plane.values.push_back(picture.at(x, y, channel));
  }
  return plane;
}

/// The sum of each window that is wholly in the plane, at its upper left corner.
Plane window_sums(const Plane& plane) {
  Plane rows{std::max(0, plane.width - kWindow_px + 1), plane.height, {}};
  for (int y = 0; y < rows.height; ++y) {
    for (int x = 0; x < rows.width; ++x) {
      int sum = 0;
      for (int i = 0; i < kWindow_px; ++i) sum += plane.at(x + i, y);
      rows.values.push_back(sum);
    }
  }
  Plane sums{rows.width, std::max(0, rows.height - kWindow_px + 1), {}};
  for (int y = 0; y < sums.height; ++y) {
    for (int x = 0; x < sums.width; ++x) {
      int sum = 0;
      for (int i = 0; i < kWindow_px; ++i) sum += rows.at(x, y + i);
      sums.values.push_back(sum);
    }
  }
  return sums;
}

/// The least or, by std::greater, the largest value within reach of each.
template <typename Less>
Plane extremes(const Plane& plane, Less less) {
  const auto pass = [&](const Plane& from, int dx, int dy) {
    Plane to = from;
    for (int y = 0; y < from.height; ++y) {
      for (int x = 0; x < from.width; ++x) {
        for (int i = -kReach_px; i <= kReach_px; ++i) {
          const int at_x = std::clamp(x + i * dx, 0, from.width - 1);
          const int at_y = std::clamp(y + i * dy, 0, from.height - 1);
          to.at(x, y) = std::min(to.at(x, y), from.at(at_x, at_y), less);
        }
      }
    }
    return to;
  };
  return pass(pass(plane, 1, 0), 0, 1);
}

struct Range {
  explicit Range(const Plane& plane)
      : low(extremes(plane, std::less())), high(extremes(plane, std::greater())) {}

  Plane low;
  Plane high;
};

template <typename Value>
void keep_worst(Value value, int x, int y, const char* what, Value& worst, std::string& where) {
  if (value <= worst) return;
  worst = value;
  where = fmt::format("{} at ({}, {})", what, x, y);
}

/// What `a` shows where `b` is even; `b`'s channels are even together.
void compare_beside_nothing(const std::vector<Plane>& a, const std::vector<Range>& b,
                            Unlikeness& worst, std::string& where) {
  for (int y = 0; y < a[0].height; ++y) {
    for (int x = 0; x < a[0].width; ++x) {
      const auto is_even = [&](const Range& r) {
        return r.high.at(x, y) - r.low.at(x, y) <= kEven;
      };
      if (!std::ranges::all_of(b, is_even)) continue;
      for (std::size_t c = 0; c < a.size(); ++c) {
        const int value = a[c].at(x, y);
        const int beyond = std::max(b[c].low.at(x, y) - value, value - b[c].high.at(x, y));
        keep_worst(beyond, x, y, "beside nothing", worst.beside_nothing, where);
      }
    }
  }
}

void compare_windows(const Plane& a, const Range& b, Unlikeness& worst, std::string& where) {
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) {
      const int value = a.at(x, y);
      const int beyond = std::max(b.low.at(x, y) - value, value - b.high.at(x, y));
      keep_worst(double(beyond) / (kWindow_px * kWindow_px), x, y, "window", worst.of_window,
                 where);
    }
  }
}

}  // namespace

Samples read_samples(const std::filesystem::path& path, std::uint8_t grey) {
  const SurfacePtr file(cairo_image_surface_create_from_png(path.c_str()));
  if (cairo_surface_status(file.get()) != CAIRO_STATUS_SUCCESS) {
    throw std::runtime_error(path.string() + " is no PNG");
  }
  const int width = cairo_image_surface_get_width(file.get());
  const int height = cairo_image_surface_get_height(file.get());
  const SurfacePtr surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height));
  cairo_t* const cr = cairo_create(surface.get());
  cairo_set_source_rgb(cr, grey / 255.0, grey / 255.0, grey / 255.0);
  cairo_paint(cr);
  cairo_set_source_surface(cr, file.get(), 0, 0);
  cairo_paint(cr);
  cairo_destroy(cr);
  cairo_surface_flush(surface.get());
  Samples samples{width, height};
  for (int y = 0; y < height; ++y) {
    const unsigned char* const row =
        cairo_image_surface_get_data(surface.get()) +
        std::ptrdiff_t{y} * cairo_image_surface_get_stride(surface.get());
    for (int x = 0; x < width; ++x) {
      std::uint32_t word = 0;
      std::memcpy(&word, row + std::ptrdiff_t{4} * x, 4);
      for (const int shift : {16, 8, 0}) samples.rgb.push_back(std::uint8_t(word >> shift & 0xFF));
    }
  }
  return samples;
}

Unlikeness unlikeness(const Samples& a, const Samples& b) {
  if (a.width_px != b.width_px || a.height_px != b.height_px) {
    throw std::runtime_error(
        fmt::format("sizes {}x{} and {}x{}", a.width_px, a.height_px, b.width_px, b.height_px));
  }
  Unlikeness worst;
  std::string pixel;
  std::string window;
  std::vector<Plane> of_a;
  std::vector<Plane> of_b;
  std::vector<Range> around_a;
  std::vector<Range> around_b;
  for (int channel = 0; channel < 3; ++channel) {
    of_a.push_back(channel_of(a, channel));
    of_b.push_back(channel_of(b, channel));
    around_a.emplace_back(of_a.back());
    around_b.emplace_back(of_b.back());
    const Plane sums_a = window_sums(of_a.back());
    const Plane sums_b = window_sums(of_b.back());
    compare_windows(sums_a, Range(sums_b), worst, window);
    compare_windows(sums_b, Range(sums_a), worst, window);
  }
  compare_beside_nothing(of_a, around_b, worst, pixel);
  compare_beside_nothing(of_b, around_a, worst, pixel);
  worst.where = pixel + (pixel.empty() || window.empty() ? "" : ", ") + window;
  return worst;
}

}  // namespace piblocks::testing_support
