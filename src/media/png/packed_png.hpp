// PNG files of 8 bits a sample, read fast and kept as they are stored.
// In: a file in memory. Out: its pixels, packed; or nothing, and png_reader.cpp reads the file by
// libpng, which knows every other kind and says what is wrong.
#pragma once

#include <piblocks/image.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "media/output/bytes.hpp"

namespace piblocks {

/// A page has no libdeflate.
#ifdef __EMSCRIPTEN__
inline constexpr bool kReadsPackedPng = false;
#else
inline constexpr bool kReadsPackedPng = true;
#endif

/// How the bytes of a pixel are to be understood: colour types of PNG.
enum class Packing : std::uint8_t { grey = 0, rgb = 2, palette = 3, grey_alpha = 4, rgba = 6 };

/// A picture of 8 bits a sample in the bytes of its file.
struct PackedImage {
  int width_px = 0;
  int height_px = 0;
  Packing packing = Packing::rgba;
  std::vector<std::uint32_t> palette = {};  ///< words 0xAARRGGBB, one for every index that occurs
  std::shared_ptr<const std::uint8_t> bytes = {};  ///< rows, each behind one byte of no meaning

  std::size_t pixel_bytes() const noexcept;
  std::size_t row_bytes() const noexcept { return pixel_bytes() * std::size_t(width_px); }
  const std::uint8_t* row(int y) const noexcept {
    return bytes.get() + (row_bytes() + 1) * std::size_t(y) + 1;
  }
  /// Whether equal bytes are equal pixels.
  bool is_packed_as(const PackedImage& other) const {
    return packing == other.packing && palette == other.palette;
  }
  /// Writes the pixels of a row as words of an Image.
  void unpack_row(int y, std::uint32_t* words) const;
};

Image unpacked(const PackedImage& packed);

/// Reads files with 8 bits a sample that are neither interlaced nor animated, as libpng does: every
/// checksum is verified. Nothing for any other file, whether it is valid or not.
/// @param file  is changed.
std::optional<PackedImage> read_packed_png(Bytes file);

/// Whether read_packed_png() would read the file, which takes half as long for most.
bool is_whole_png(Bytes file);

}  // namespace piblocks
