#include <libdeflate.h>
#include <memory>
#include <string_view>

#include <piblocks/error.hpp>
#include <piblocks/png.hpp>

#include "media/rgb24.hpp"

namespace piblocks {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr int kCompressionLevel = 1;

struct CompressorDeleter {
  void operator()(libdeflate_compressor* compressor) const noexcept {
    libdeflate_free_compressor(compressor);
  }
};
using CompressorPtr = std::unique_ptr<libdeflate_compressor, CompressorDeleter>;

void put_u32(std::uint8_t* at, std::uint32_t value) {
  for (int i = 0; i < 4; ++i) at[i] = static_cast<std::uint8_t>(value >> (24 - 8 * i));
}

void append_u32(Bytes& png, std::uint32_t value) {
  png.resize(png.size() + 4);
  put_u32(png.data() + png.size() - 4, value);
}

void append(Bytes& png, std::string_view text) {
  for (const char c : text) png.push_back(static_cast<std::uint8_t>(c));
}

// A chunk is its length, type, data, and a CRC of type and data (PNG specification, section 5.3).

/// @return where the chunk starts, for end_chunk().
std::size_t begin_chunk(Bytes& png, std::string_view type) {
  const std::size_t start = png.size();
  append_u32(png, 0);
  append(png, type);
  return start;
}

void end_chunk(Bytes& png, std::size_t start) {
  const std::uint8_t* type = png.data() + start + 4;
  const std::size_t length = png.size() - start - 8;
  put_u32(png.data() + start, static_cast<std::uint32_t>(length));
  append_u32(png, libdeflate_crc32(0, type, length + 4));
}

void append_header(Bytes& png, const ImageView& image) {
  append(png, "\x89PNG\r\n\x1a\n");

  const std::size_t header = begin_chunk(png, "IHDR");
  append_u32(png, static_cast<std::uint32_t>(image.width_px));
  append_u32(png, static_cast<std::uint32_t>(image.height_px));
  append(png, {"\x08\x02\0\0\0", 5});  // 8 bits a sample, colour type 2 (RGB)
  end_chunk(png, header);

  const std::size_t colours = begin_chunk(png, "sRGB");
  png.push_back(0);  // perceptual intent
  end_chunk(png, colours);
}

/// The rows, each behind the number of its filter. Up (the difference from the row above) turns
/// flat and vertical shapes into zeros; the first row has nothing above it.
Bytes filtered_rows(const ImageView& image) {
  constexpr std::uint8_t kNone = 0;
  constexpr std::uint8_t kUp = 2;
  const std::size_t row_bytes = static_cast<std::size_t>(image.width_px) * 3;
  Bytes rows((row_bytes + 1) * static_cast<std::size_t>(image.height_px));
  Bytes above(row_bytes);
  Bytes current(row_bytes);

  std::uint8_t* out = rows.data();
  for (int y = 0; y < image.height_px; ++y) {
    pack_rgb24(image.row(y), image.width_px, current.data());
    *out++ = y == 0 ? kNone : kUp;
    subtract_bytes(current.data(), above.data(), row_bytes, out);
    out += row_bytes;
    current.swap(above);
  }
  return rows;
}

void append_compressed(Bytes& png, const Bytes& data) {
  const CompressorPtr compressor(libdeflate_alloc_compressor(kCompressionLevel));
  if (!compressor) throw MediaError("png: cannot compress image: out of memory");
  const std::size_t bound = libdeflate_zlib_compress_bound(compressor.get(), data.size());
  const std::size_t start = png.size();
  png.resize(start + bound);
  const std::size_t size = libdeflate_zlib_compress(compressor.get(), data.data(), data.size(),
                                                    png.data() + start, bound);
  png.resize(start + size);
}

}  // namespace

std::vector<std::uint8_t> encode_png(const ImageView& image) {
  Bytes png;
  append_header(png, image);
  const std::size_t pixels = begin_chunk(png, "IDAT");
  append_compressed(png, filtered_rows(image));
  end_chunk(png, pixels);
  end_chunk(png, begin_chunk(png, "IEND"));
  return png;
}

}  // namespace piblocks
