// What PNG files are made of: chunks (PNG specification, section 5.3), deflate streams, and the
// mark by which piblocks knows its own files. In: data. Out: chunks, appended to a file in memory;
// compressed bytes.
#pragma once

#include <piblocks/image.hpp>
#include <zlib.h>

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string_view>

#include "media/output/bytes.hpp"
#include "media/pixels/rgb24.hpp"

namespace piblocks {

/// How a PNG file begins.
inline constexpr std::string_view kPngSignature = "\x89PNG\r\n\x1a\n";

/// The byte before each row by filter Up (PNG specification, section 9.2).
inline constexpr std::uint8_t kPngFilterUp = 2;

/// Begins a chunk. What is appended before end_png_chunk() is its data.
/// @return where the chunk starts, for end_png_chunk().
std::size_t begin_png_chunk(Bytes& png, std::string_view type);
void end_png_chunk(Bytes& png, std::size_t start);
/// A whole chunk.
void append_png_chunk(Bytes& png, std::string_view type, ByteSpan data = {});

/// What samples are (PNG specification, table 11.1).
enum class PngColors : std::uint8_t { rgb = 2, palette = 3, rgba = 6 };

/// Signature and header of a picture. @param bits  of a sample: 8 or 16
void append_png_header(Bytes& png, int width_px, int height_px, PngColors colors,
                       std::uint8_t bits = 8);
/// The chunk that says that colours are sRGB.
void append_png_srgb(Bytes& png);

/// Appends rows by filter Up, the difference from the row above, which leaves zeros wherever a row
/// equals it. @param pack_row  writes row i, from 0, as bytes.
template <typename PackRow>
void append_up_filtered(Bytes& rows, int count, std::size_t row_bytes, const PackRow& pack_row) {
  Bytes above(row_bytes);
  Bytes current(row_bytes);
  for (int i = 0; i < count; ++i) {
    pack_row(i, current.data());
    rows.push_back(kPngFilterUp);
    rows.resize(rows.size() + row_bytes);
    subtract_bytes(current.data(), above.data(), row_bytes, &rows.back() + 1 - row_bytes);
    current.swap(above);
  }
}

/// Encodes a picture as read_png_samples() returns it, with straight alpha; without alpha if all of
/// it is opaque. @throws MediaError as encode_png()
Bytes encode_png_samples(const Image& picture);
/// The same with 16 bits a sample and with alpha in any case. @param picture  up to 65535
Bytes encode_png_samples(const DeepImage& picture);

/// Encodes a picture of at most 256 colours, which are words 0xRRGGBB.
/// @param pack_row  writes the indices of the colours of a row, from 0
/// @throws MediaError as encode_png()
Bytes encode_png_palette(int width_px, int height_px, std::span<const std::uint32_t> palette,
                         const std::function<void(int row, std::uint8_t* indices)>& pack_row);

/// What a picture belongs to, which a chunk of text at a fixed place says. A command replaces and
/// removes only pictures of its own kind.
enum class PngMark {
  sequence,   ///< frames of `render -o %06d.png`
  difference  ///< `compare --diff`
};

/// @param png  with a header as append_png_header() makes it
Bytes with_png_mark(ByteSpan png, PngMark mark);

/// Whether this is a file, not a symbolic link, that with_png_mark() made. False if this user may
/// not read it. @throws IoError if reading fails.
bool has_png_mark(const std::filesystem::path& path, PngMark mark);

/// Whether this is a file, not a symbolic link, with these bytes at a place of it.
/// @throws IoError if reading fails.
bool has_bytes(const std::filesystem::path& path, std::size_t at, ByteSpan expected);

/// Fast, and for runs of equal bytes, which filter Up leaves of flat shapes: chosen from the table
/// in tests/benchmark/encoders.md. Used by one thread at a time.
class Deflater {
 public:
  enum class Form {
    whole,  ///< a zlib stream (RFC 1950)
    piece   ///< blocks up to a whole byte, which other pieces may follow
  };

  /// @throws MediaError if memory runs out.
  explicit Deflater(Form form);

  /// The result stays until the next call. It depends on `bytes` alone. @throws MediaError
  ByteSpan compress(ByteSpan bytes);

 private:
  Form form_;
  std::unique_ptr<z_stream, void (*)(z_stream*)> stream_;
  Bytes compressed_;
};

}  // namespace piblocks
