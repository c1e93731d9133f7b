// Compresses one image after another, and of each only what differs from the one before.
// In: views of pixels. Out: the bytes of a PNG file each.
//
// A file is cut into strips of rows. Each is compressed by itself and stored as a chunk of its own,
// so that its bytes depend on its rows alone: strips that stay as they were are copied. Filter Up
// leaves of a shape that moves sideways only its upper and lower edge, so few strips change.
#pragma once

#include <piblocks/image.hpp>

#include <cstdint>
#include <span>
#include <vector>

#include "media/png/deflate.hpp"

namespace piblocks {

/// What encode_png() does, for sequences. The bytes depend on the image alone. Used by one thread
/// at a time.
class PngEncoder {
 public:
  /// @throws MediaError if memory for the compressor runs out.
  PngEncoder();

  /// Takes an image of the size of the last one and equal to it outside of `changed`. The first,
  /// or one of another size or with alpha after one without, is taken whole.
  void filter(const ImageView& image, std::span<const PixelRect> changed);
  /// The file of the image that was taken last.
  std::vector<std::uint8_t> compress();

 private:
  /// Some rows of a file, filtered and compressed.
  struct Strip {
    std::vector<std::uint8_t> chunk;
    std::uint32_t checksum = 0;  // Adler-32 of the filtered rows
    bool stale = true;
  };

  void resize(const ImageView& image);
  void filter_rect(const ImageView& image, const PixelRect& rect);
  void filter_row(int y, int x, std::span<const std::uint8_t> row,
                  std::span<const std::uint8_t> above);
  void compress_strip(std::size_t index);
  std::span<const std::uint8_t> rows_of(std::size_t strip) const;
  std::vector<std::uint8_t> assemble() const;

  DeflatePtr stream_;
  int width_px_ = 0;
  int height_px_ = 0;
  bool has_alpha_ = false;
  std::size_t pixel_bytes_ = 3;
  std::size_t row_bytes_ = 0;             // with the byte that names the filter
  std::vector<std::uint8_t> rows_;        // filtered
  std::vector<std::uint8_t> difference_;  // room for one row
  std::vector<std::uint8_t> compressed_;  // room for one strip
  std::vector<Strip> strips_;
};

}  // namespace piblocks
