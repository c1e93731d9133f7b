// Frames like those of the animation, without the program that draws them.
// In: a size and an instant. Out: two sliding squares, a dashed wall, text-like bars, on white.
#pragma once

#include <piblocks/image.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace piblocks::testing_support {

/// White to begin with.
struct Pixels : Image {
  Pixels(int width, int height)
      : Image{width, height,
              std::vector<std::uint32_t>(std::size_t(width) * std::size_t(height), 0xffffffff)} {}

  std::uint32_t& at(int x, int y) {
    return words[std::size_t(y) * std::size_t(width_px) + std::size_t(x)];
  }
  std::uint32_t at(int x, int y) const { return const_cast<Pixels&>(*this).at(x, y); }
};

/// The picture at an instant, in seconds; measures are those of 1080 lines, scaled to the height.
Pixels article_frame(int width_px, int height_px, double time_s);

/// Every pixel a colour of its own, always the same for a seed.
Pixels random_frame(int width_px, int height_px, std::uint32_t seed);

/// The same with alpha; no colour is greater than it.
Pixels transparent_frame(int width_px, int height_px, std::uint32_t seed);

inline ImageView with_alpha(const Pixels& pixels) {
  ImageView view = pixels.view();
  view.has_alpha = true;
  return view;
}

}  // namespace piblocks::testing_support
