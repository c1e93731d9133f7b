// Compresses one image after another, and of each only what differs from the one before.
// In: views of pixels. Out: the bytes of a PNG file for each.
//
// A file is cut into strips of rows. Each strip has a chunk of its own, whose bytes depend on the
// strip's rows alone: strips that have not changed are copied. Few strips change, since filter Up
// leaves only the upper and lower edges of a shape that moves sideways.
#pragma once

#include <piblocks/image.hpp>

#include <cstdint>
#include <span>

#include "media/png/png_chunk.hpp"

namespace piblocks {

/// encode_png() for sequences. The bytes depend on the image alone. Used by one thread at a time.
class PngEncoder {
 public:
  /// Takes an image that differs from the last one only in `changed`. The first image, and one of
  /// another size or form, is taken whole.
  void filter(const ImageView& image, std::span<const PixelRect> changed);
  /// The file of the last image.
  /// @throws MediaError if memory for the compressor runs out.
  Bytes compress();

 private:
  /// Some rows of a file, filtered and compressed.
  struct Strip {
    Bytes chunk;
    std::uint32_t checksum = 0;  // Adler-32 of the filtered rows
    bool stale = true;
  };

  void resize(const ImageView& image);
  void filter_rect(const ImageView& image, const PixelRect& rect);
  void filter_row(int y, int x, ByteSpan row, ByteSpan above);
  void compress_strip(std::size_t index);
  ByteSpan rows_of(std::size_t strip) const;

  Deflater deflater_{Deflater::Form::piece};
  int width_px_ = 0;
  int height_px_ = 0;
  bool has_alpha_ = false;
  std::size_t row_bytes_ = 0;  // with the byte that names the filter
  Bytes rows_;                 // filtered
  Bytes difference_;           // room for one row
  std::vector<Strip> strips_;
};

}  // namespace piblocks
