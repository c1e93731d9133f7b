// What tests of compare() share.
// In: colours. Out: small images, and what compare() finds about two of them.
#pragma once

#include <gtest/gtest.h>
#include <piblocks/compare.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "support/property.hpp"

namespace piblocks {

inline Image flat(int width_px, int height_px, std::uint32_t word) {
  return {width_px, height_px,
          std::vector<std::uint32_t>(std::size_t(width_px) * std::size_t(height_px), word)};
}

inline std::uint32_t& at(Image& image, int x, int y) {
  return image.words.at(std::size_t(y) * std::size_t(image.width_px) + std::size_t(x));
}

inline std::uint32_t at(const Image& image, int x, int y) {
  return image.words.at(std::size_t(y) * std::size_t(image.width_px) + std::size_t(x));
}

inline Difference compared(const Image& a, const Image& b, const Tolerance& tolerance = {},
                           const std::vector<PixelRect>& masks = {}) {
  return compare(a.view(), b.view(), tolerance, masks);
}

/// Of the words given, each as likely as the others.
inline Image random_image(Random& random, int width_px, int height_px,
                          const std::vector<std::uint32_t>& words) {
  Image image = flat(width_px, height_px, 0);
  for (std::uint32_t& word : image.words) {
    word = words.at(std::size_t(random.integer(0, std::int64_t(words.size()) - 1)));
  }
  return image;
}

/// Any colour and alpha; one in four is opaque, and one in four transparent.
inline std::uint32_t random_word(Random& random) {
  const auto color = std::uint32_t(random.integer(0, 0xffffff));
  const std::int64_t kind = random.integer(0, 3);
  const auto alpha = std::uint32_t(kind == 0 ? 255 : kind == 1 ? 0 : random.integer(1, 254));
  return alpha << 24 | color;
}

inline Image random_image(Random& random, int width_px, int height_px) {
  Image image = flat(width_px, height_px, 0);
  for (std::uint32_t& word : image.words) word = random_word(random);
  return image;
}

/// The same picture with some other pixels.
inline Image changed(Random& random, Image image, std::int64_t changes) {
  for (; changes > 0; --changes) {
    const auto last = std::int64_t(image.words.size()) - 1;
    image.words.at(std::size_t(random.integer(0, last))) = random_word(random);
  }
  return image;
}

inline int random_side(Random& random) { return int(random.integer(1, 12)); }

/// All that compare() says.
inline void expect_same(const Difference& found, const Difference& expected) {
  EXPECT_EQ(found.different_pixels, expected.different_pixels);
  EXPECT_EQ(found.off_pixels, expected.off_pixels);
  EXPECT_EQ(found.largest_delta, expected.largest_delta);
  EXPECT_EQ(found.max_level, expected.max_level);
  EXPECT_EQ(found.first, expected.first);
  EXPECT_EQ(found.densest, expected.densest);
  EXPECT_EQ(found.densest_off, expected.densest_off);
  EXPECT_EQ(found.masked_pixels, expected.masked_pixels);
  EXPECT_EQ(found.is_accepted, expected.is_accepted);
}

}  // namespace piblocks
