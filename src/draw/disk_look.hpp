// How a disk that moves looks in a pixel, by the distance of the pixel from its centre.
// In: an exposed disk. Out: rings, and what they make of a background.
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

/// A circle: what is nearer to the disk's centre looks like this, up to the next smaller circle.
struct Ring {
  double radius = 0;
  double fill = 0;  ///< share of the pixel
  double rim = 0;
};

/// How a disk looks, and what light it leaves of the background that was asked for last.
class DiskLook {
 public:
  DiskLook(const ExposedDisk& disk, std::size_t place)
      : place_(place), fill_(samples_of(disk.fill)), rim_(samples_of(disk.rim)) {
    constexpr double kLeast_px = 0.5;
    // A disk thinner than a pixel is as wide as one, and fainter.
    const double radius = std::max(disk.radius, kLeast_px);
    const double opacity = std::min(1.0, disk.radius * disk.radius / (kLeast_px * kLeast_px));
    if (disk.rim_px > 0) add_edge(radius, 0, opacity, 0);
    add_edge(disk.rim_px > 0 ? radius - disk.rim_px : radius, opacity, 0,
             disk.rim_px > 0 ? opacity : 0);
  }

  std::size_t place() const { return place_; }  ///< in the item
  /// From the outside to the middle.
  std::span<const Ring> rings() const { return {rings_.data(), ring_count_}; }

  Rgb over(const Rgb& behind, std::size_t ring) const {
    Rgb samples = behind;
    for (std::size_t i = 0; i < 3; ++i) {
      samples[i] +=
          rings_[ring].fill * (fill_[i] - behind[i]) + rings_[ring].rim * (rim_[i] - behind[i]);
    }
    return samples;
  }
  /// The light of each ring over a background.
  std::span<const Rgb> lights(std::uint32_t background, const Light& light) {
    if (background != background_) {
      background_ = background;
      for (std::size_t ring = 0; ring < ring_count_; ++ring) {
        const Rgb samples = over(samples_of(background), ring);
        for (std::size_t i = 0; i < 3; ++i) lights_[ring][i] = light.of(samples[i]);
      }
    }
    return {lights_.data(), ring_count_};
  }

 private:
  void add_edge(double at, double fill, double rim, double share_before) {
    // An edge that fades on both sides of a circle covers more than the circle does:
    // pi (r^2 + the mean square of the steps' distances from it).
    constexpr double kSpread_px2 =
        4 * kSoftEdge_px * kSoftEdge_px * (1 - 1.0 / (kEdgeSteps * kEdgeSteps)) / 12;
    const double middle = std::sqrt(std::max(0.0, at * at - kSpread_px2));
    for (int step = 0; step < kEdgeSteps; ++step) {
      const double in = (step + 1.0) / kEdgeSteps;
      const double ring = middle + kSoftEdge_px - 2 * kSoftEdge_px * (step + 0.5) / kEdgeSteps;
      if (ring <= 0) return;
      rings_[ring_count_++] = {ring, fill * in, rim * in + share_before * (1 - in)};
    }
  }

  std::size_t place_;
  Rgb fill_;
  Rgb rim_;
  std::size_t ring_count_ = 0;
  std::array<Ring, 2 * kEdgeSteps> rings_{};
  std::uint32_t background_ = std::numeric_limits<std::uint32_t>::max();  // none yet
  std::array<Rgb, 2 * kEdgeSteps> lights_{};
};

}  // namespace piblocks
