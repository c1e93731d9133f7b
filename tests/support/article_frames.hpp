// Frames like those of the animation, without the program that draws them.
// In: a size and an instant. Out: two sliding squares, a dashed wall, text-like bars, on white.
#pragma once

#include <piblocks/image.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace piblocks::testing_support {

/// An image that owns its pixels; white to begin with.
struct Pixels {
  Pixels(int width, int height)
      : width_px(width),
        height_px(height),
        words(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0xffffffff) {}

  std::uint32_t& at(int x, int y) {
    return words[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_px) +
                 static_cast<std::size_t>(x)];
  }
  std::uint32_t at(int x, int y) const { return const_cast<Pixels&>(*this).at(x, y); }
  ImageView view() const {
    return {reinterpret_cast<const std::uint8_t*>(words.data()), width_px, height_px,
            std::ptrdiff_t{4} * width_px};
  }

  int width_px;
  int height_px;
  std::vector<std::uint32_t> words;
};

/// The picture at an instant, in seconds; measures are those of 1080 lines, scaled to the height.
Pixels article_frame(int width_px, int height_px, double time_s);

/// Every pixel a colour of its own, always the same for a seed.
Pixels random_frame(int width_px, int height_px, std::uint32_t seed);

}  // namespace piblocks::testing_support
