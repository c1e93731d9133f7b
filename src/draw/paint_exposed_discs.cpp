#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "draw/extent.hpp"
#include "draw/painter.hpp"

namespace piblocks {
namespace {

/// Steps in which an edge fades, from a pixel that is just outside to one that is just inside.
constexpr int kEdgeSteps = 4;

/// Red, green and blue.
using Rgb = std::array<double, 3>;

/// A circle: what is nearer to the disc's centre looks like this, up to the next smaller circle.
struct Ring {
  double radius = 0;
  double fill = 0;  ///< share of the pixel
  double rim = 0;
};

/// From the outside to the middle. A disc thinner than a pixel is as wide as one, and fainter.
std::vector<Ring> rings_of(const ExposedDisc& disc) {
  constexpr double kLeast_px = 0.5;
  const double radius = std::max(disc.radius, kLeast_px);
  const double opacity = std::min(1.0, disc.radius * disc.radius / (kLeast_px * kLeast_px));
  const double inner = disc.rim_px > 0 ? radius - disc.rim_px : radius;
  std::vector<Ring> rings;
  const auto add_edge = [&](double at, double fill, double rim, double share_before) {
    for (int step = 0; step < kEdgeSteps; ++step) {
      const double in = (step + 1.0) / kEdgeSteps;
      const double ring = at + kSoftEdge_px - 2 * kSoftEdge_px * (step + 0.5) / kEdgeSteps;
      if (ring <= 0) return;
      rings.push_back({ring, fill * in, rim * in + share_before * (1 - in)});
    }
  };
  if (disc.rim_px > 0) add_edge(radius, 0, opacity, 0);
  add_edge(inner, opacity, 0, disc.rim_px > 0 ? opacity : 0);
  return rings;
}

/// For which part of its path, 0 … 1, the centre is within a distance of a place.
/// @param at  the place, from the begin of the path
double share_within(const DiscPath& path, const Point& at, double distance) {
  const Point step{path.to.x - path.from.x, path.to.y - path.from.y};
  const double length2 = step.x * step.x + step.y * step.y;
  const double out2 = at.x * at.x + at.y * at.y - distance * distance;
  if (length2 == 0) return out2 < 0 ? 1 : 0;
  // |at - t step|² = distance²
  const double middle = at.x * step.x + at.y * step.y;
  const double discriminant = middle * middle - length2 * out2;
  if (discriminant <= 0) return 0;
  const double root = std::sqrt(discriminant);
  const double enters = std::clamp((middle - root) / length2, 0.0, 1.0);
  const double leaves = std::clamp((middle + root) / length2, 0.0, 1.0);
  return leaves - enters;
}

/// The light of each ring of a disc over a background, less that of the background.
class RingLights {
 public:
  RingLights(const ExposedDisc& disc, const std::vector<Ring>& rings, const Light& light)
      : disc_(disc), rings_(rings), light_(light), lights_(rings.size()) {}

  const std::vector<Rgb>& over(std::uint32_t background) {
    if (background == background_) return lights_;
    background_ = background;
    for (std::size_t i = 0; i < rings_.size(); ++i) {
      lights_[i] = {light(rings_[i], 16, &Color::red), light(rings_[i], 8, &Color::green),
                    light(rings_[i], 0, &Color::blue)};
    }
    return lights_;
  }

 private:
  double light(const Ring& ring, int shift, std::uint8_t Color::*channel) const {
    const double behind = background_ >> shift & 0xFF;
    const double sample = behind + ring.fill * (disc_.fill.*channel - behind) +
                          ring.rim * (disc_.rim.*channel - behind);
    return light_.of(sample) - light_.of(behind);
  }

  const ExposedDisc& disc_;
  const std::vector<Ring>& rings_;
  const Light& light_;
  std::uint32_t background_ = std::numeric_limits<std::uint32_t>::max();  // none yet
  std::vector<Rgb> lights_;
};

/// Adds up the light of pixels that discs pass.
class ExposedPixels {
 public:
  ExposedPixels(const PixelRect& area, unsigned char* data, std::ptrdiff_t stride_bytes,
                const Light& light)
      : area_(area),
        data_(data),
        stride_bytes_(stride_bytes),
        light_(light),
        places_(static_cast<std::size_t>(area.width_px) * static_cast<std::size_t>(area.height_px),
                kNone) {}

  void add(const ExposedDisc& disc) {
    const std::vector<Ring> rings = rings_of(disc);
    RingLights lights(disc, rings, light_);
    for (const DiscPath& path : disc.paths) {
      ExposedDisc alone{disc.radius, disc.rim_px, disc.fill, disc.rim, {path}};
      const PixelRect pixels = pixels_of(extent_of(alone), area_);
      for (int y = pixels.y_px; y < pixels.y_px + pixels.height_px; ++y) {
        for (int x = pixels.x_px; x < pixels.x_px + pixels.width_px; ++x) {
          add_path(path, rings, {x + 0.5 - path.from.x, y + 0.5 - path.from.y}, x, y, lights);
        }
      }
    }
  }

  void write() const {
    for (const Sum& sum : sums_) {
      const auto& [red, green, blue] = sum.light;
      *sum.pixel = (*sum.pixel & 0xFF000000U) | std::uint32_t{light_.sample(red)} << 16 |
                   std::uint32_t{light_.sample(green)} << 8 | light_.sample(blue);
    }
  }

 private:
  struct Sum {
    std::uint32_t* pixel = nullptr;
    Rgb light = {};
  };
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  void add_path(const DiscPath& path, const std::vector<Ring>& rings, const Point& at, int x, int y,
                RingLights& lights) {
    double share = share_within(path, at, rings.front().radius);
    if (share == 0) return;
    Sum& sum = sum_of(x, y);
    const std::vector<Rgb>& light = lights.over(*sum.pixel & 0xFFFFFFU);
    // All of a pixel in the middle of a slow disc is in the innermost ring all the time.
    const double within = share_within(path, at, rings.back().radius);
    for (std::size_t ring = 0; ring < rings.size() && share > 0; ++ring) {
      const bool is_last = ring + 1 == rings.size() || share == within;
      const double next = is_last ? 0 : share_within(path, at, rings[ring + 1].radius);
      const std::size_t seen = is_last ? rings.size() - 1 : ring;
      for (std::size_t i = 0; i < 3; ++i) {
        sum.light[i] += path.share * (share - next) * light[seen][i];
      }
      share = next;
    }
  }

  /// The sum of a pixel, which begins with its background.
  Sum& sum_of(int x, int y) {
    const auto row = static_cast<std::size_t>(y - area_.y_px);
    const auto column = static_cast<std::size_t>(x - area_.x_px);
    std::uint32_t& place = places_[row * static_cast<std::size_t>(area_.width_px) + column];
    if (place == kNone) {
      place = static_cast<std::uint32_t>(sums_.size());
      auto* const pixels = reinterpret_cast<std::uint32_t*>(
          data_ + static_cast<std::ptrdiff_t>(row) * stride_bytes_);
      const std::uint32_t pixel = pixels[column];
      sums_.push_back(
          {pixels + column,
           {light_.of(pixel >> 16 & 0xFF), light_.of(pixel >> 8 & 0xFF), light_.of(pixel & 0xFF)}});
    }
    return sums_[place];
  }

  PixelRect area_;
  unsigned char* data_;  // of the area's first pixel
  std::ptrdiff_t stride_bytes_;
  const Light& light_;
  std::vector<std::uint32_t> places_;  // of each pixel's sum, row by row
  std::vector<Sum> sums_;
};

}  // namespace

/// A pixel depends on the discs that pass it and its background alone, and adds them up in their
/// order, so that a part of the picture has the pixels of the whole.
void Painter::paint_exposed(cairo_t& cr, const ExposedDiscsItem& item, const PixelRect& area) {
  const PixelRect moving = moving_area(item, area);
  if (moving.width_px <= 0 || moving.height_px <= 0) return;
  cairo_surface_t* const surface = cairo_get_target(&cr);
  cairo_surface_flush(surface);
  const std::ptrdiff_t stride_bytes = cairo_image_surface_get_stride(surface);
  unsigned char* const first = cairo_image_surface_get_data(surface) +
                               (moving.y_px - area.y_px) * stride_bytes +
                               std::ptrdiff_t{4} * (moving.x_px - area.x_px);
  if (!light_) light_ = std::make_unique<Light>();
  ExposedPixels pixels(moving, first, stride_bytes, *light_);
  for (const ExposedDisc& disc : item.discs) pixels.add(disc);
  pixels.write();
  cairo_surface_mark_dirty(surface);
}

}  // namespace piblocks
