// Whether two pictures show the same, painted by different programs.
// In: two PNG files of one size. Out: where they differ by more than antialiasing and the places of
// glyphs explain.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace piblocks::testing_support {

/// Samples of red, green and blue, 0 … 255.
struct Samples {
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint8_t> rgb = {};

  std::uint8_t at(int x, int y, int channel) const {
    return rgb[3 * (std::size_t(y) * std::size_t(width_px) + std::size_t(x)) +
               std::size_t(channel)];
  }
};

/// Decoded by Cairo, in front of a grey.
/// @throws std::runtime_error if it is no PNG.
Samples read_samples(const std::filesystem::path& path, std::uint8_t grey);

/// The worst of two pictures, in steps of a sample.
struct Unlikeness {
  /// Of a pixel, where one picture is even within two pixels around: what one shows and the other
  /// does not, such as a stray line, a missing label or another colour.
  int beside_nothing = 0;
  /// Of the mean of 8x8 pixels, wherever these are moved by up to two pixels in either direction:
  /// what one shows more of than the other.
  double of_window = 0;
  std::string where = {};  ///< of both, for people
};

/// Both of one size.
Unlikeness unlikeness(const Samples& a, const Samples& b);

}  // namespace piblocks::testing_support
