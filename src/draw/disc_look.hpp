// How a disc that moves looks in a pixel, by the distance of the pixel from its centre.
// In: an exposed disc. Out: rings, and what they make of a background.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "draw/extent.hpp"
#include "draw/light.hpp"

namespace piblocks {

/// Steps in which an edge fades, from a pixel that is just outside to one that is just inside.
inline constexpr int kEdgeSteps = 4;

/// Red, green and blue.
using Rgb = std::array<double, 3>;

inline Rgb samples_of(std::uint32_t pixel) {
  return {double(pixel >> 16 & 0xFF), double(pixel >> 8 & 0xFF), double(pixel & 0xFF)};
}
inline Rgb samples_of(const Color& color) {
  return {double(color.red), double(color.green), double(color.blue)};
}

inline Rgb light_of(const Rgb& samples, const Light& light) {
  return {light.of(samples[0]), light.of(samples[1]), light.of(samples[2])};
}

/// How much of a pixel a disc covers.
struct DiscCover {
  double fill = 0;
  double rim = 0;
};

/// A circle: what is nearer to the disc's centre looks like this, up to the next smaller circle.
struct Ring {
  double radius = 0;
  DiscCover cover;
};

/// How a disc looks, and what light it leaves of the background that was asked for last.
class DiscLook {
 public:
  DiscLook(const ExposedDisc& disc, std::size_t place)
      : place_(place),
        fill_(samples_of(disc.fill)),
        rim_(samples_of(disc.rim)),
        // A disc thinner than a pixel is as wide as one, and fainter.
        opacity_(std::min(1.0, disc.radius * disc.radius / (kLeast_px * kLeast_px))),
        outer_(radius_of_edge(std::max(disc.radius, kLeast_px))),
        inner_(disc.rim_px > 0 ? radius_of_edge(std::max(disc.radius, kLeast_px) - disc.rim_px)
                               : outer_) {
    if (inner_ < outer_) add_rings(outer_);
    add_rings(inner_);
  }

  std::size_t place() const { return place_; }  ///< in the item
  /// From the outside to the middle.
  std::span<const Ring> rings() const { return {rings_.data(), ring_count_}; }

  /// What it covers of a pixel so far from its centre: its edges fade evenly.
  DiscCover cover_at(double distance) const {
    const double outer = inside(outer_, distance);
    const double inner = inside(inner_, distance);
    return {opacity_ * inner, opacity_ * (outer - inner)};
  }
  Rgb over(const Rgb& behind, const DiscCover& cover) const {
    Rgb samples = behind;
    for (std::size_t i = 0; i < 3; ++i) {
      samples[i] += cover.fill * (fill_[i] - behind[i]) + cover.rim * (rim_[i] - behind[i]);
    }
    return samples;
  }
  /// The light of each ring over a background.
  std::span<const Rgb> lights(std::uint32_t background, const Light& light) {
    if (background != background_) {
      background_ = background;
      for (std::size_t ring = 0; ring < ring_count_; ++ring) {
        lights_[ring] = light_of(over(samples_of(background), rings_[ring].cover), light);
      }
    }
    return {lights_.data(), ring_count_};
  }

 private:
  static constexpr double kLeast_px = 0.5;

  /// An edge that fades on both sides of a circle covers pi (r^2 + 1/3 of the square of how far it
  /// reaches): this is the middle of one that covers as much as the circle.
  static double radius_of_edge(double radius) {
    if (radius <= 0) return -2 * kSoftEdge_px;  // nothing is inside
    return std::sqrt(std::max(0.0, radius * radius - kSoftEdge_px * kSoftEdge_px / 3));
  }
  static double inside(double radius, double distance) {
    return std::clamp((radius + kSoftEdge_px - distance) / (2 * kSoftEdge_px), 0.0, 1.0);
  }

  void add_rings(double edge) {
    for (int step = 0; step < kEdgeSteps; ++step) {
      const double radius = edge + kSoftEdge_px - 2 * kSoftEdge_px * (step + 0.5) / kEdgeSteps;
      if (radius <= 0) return;
      // Seen as it is half a step farther inside.
      rings_[ring_count_++] = {radius, cover_at(radius - kSoftEdge_px / kEdgeSteps)};
    }
  }

  std::size_t place_;
  Rgb fill_;
  Rgb rim_;
  double opacity_;
  double outer_;  // the middle of the outer edge
  double inner_;  // of the rim's inner edge
  std::size_t ring_count_ = 0;
  std::array<Ring, 2 * kEdgeSteps> rings_{};
  std::uint32_t background_ = std::numeric_limits<std::uint32_t>::max();  // none yet
  std::array<Rgb, 2 * kEdgeSteps> lights_{};
};

}  // namespace piblocks
