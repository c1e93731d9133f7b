#include "media/png/png_encoder.hpp"

#include <piblocks/encode.hpp>

#include <algorithm>
#include <cstring>

#include "media/pixels/rgb24.hpp"
#include "media/png/png_chunk.hpp"
#include "media/png/png_encoder.hpp"

namespace piblocks {
namespace {

using Bytes = std::vector<std::uint8_t>;
using ByteSpan = std::span<const std::uint8_t>;

/// Chosen from the table in tests/benchmark/encoders.md.
constexpr int kStripRows = 8;

}  // namespace

void PngEncoder::filter(const ImageView& image, std::span<const PixelRect> changed) {
  const PixelRect whole{0, 0, image.width_px, image.height_px};
  if (image.width_px != width_px_ || image.height_px != height_px_ ||
      image.has_alpha != has_alpha_) {
    resize(image);
    changed = {&whole, 1};
  }
  for (const PixelRect& rect : changed) filter_rect(image, rect);
}

Bytes PngEncoder::compress() {
  for (std::size_t i = 0; i < strips_.size(); ++i) {
    if (strips_[i].stale) compress_strip(i);
  }
  return assemble();
}

void PngEncoder::resize(const ImageView& image) {
  constexpr std::uint8_t kUp = 2;
  width_px_ = image.width_px;
  height_px_ = image.height_px;
  has_alpha_ = image.has_alpha;
  row_bytes_ = static_cast<std::size_t>(width_px_) * packed_bytes(has_alpha_) + 1;
  rows_.assign(row_bytes_ * static_cast<std::size_t>(height_px_), 0);
  for (std::size_t at = 0; at < rows_.size(); at += row_bytes_) rows_[at] = kUp;
  strips_.assign(static_cast<std::size_t>((height_px_ + kStripRows - 1) / kStripRows), {});
}

/// Up is the difference from the row above, so the row below the rectangle changes too. Above the
/// first row all is zero.
void PngEncoder::filter_rect(const ImageView& image, const PixelRect& rect) {
  const std::size_t bytes = static_cast<std::size_t>(rect.width_px) * packed_bytes(has_alpha_);
  Bytes above(bytes);
  Bytes current(bytes);
  if (rect.y_px > 0) pack_row(image, rect, rect.y_px - 1, above.data());
  const int end = std::min(rect.y_px + rect.height_px + 1, height_px_);
  for (int y = rect.y_px; y < end; ++y) {
    pack_row(image, rect, y, current.data());
    filter_row(y, rect.x_px, current, above);
    current.swap(above);
  }
}

void PngEncoder::filter_row(int y, int x, ByteSpan row, ByteSpan above) {
  std::uint8_t* const filtered = rows_.data() + static_cast<std::size_t>(y) * row_bytes_ + 1 +
                                 static_cast<std::size_t>(x) * packed_bytes(has_alpha_);
  difference_.resize(row.size());
  subtract_bytes(row.data(), above.data(), row.size(), difference_.data());
  if (std::memcmp(difference_.data(), filtered, row.size()) == 0) return;
  std::memcpy(filtered, difference_.data(), row.size());
  strips_[static_cast<std::size_t>(y / kStripRows)].stale = true;
}

ByteSpan PngEncoder::rows_of(std::size_t strip) const {
  const std::size_t bytes = kStripRows * row_bytes_;
  const std::size_t begin = strip * bytes;
  return {rows_.data() + begin, std::min(bytes, rows_.size() - begin)};
}

/// The pieces of all strips make one zlib stream, whose header the first strip has.
void PngEncoder::compress_strip(std::size_t index) {
  const ByteSpan rows = rows_of(index);
  const ByteSpan compressed = deflater_.compress(rows);
  Strip& strip = strips_[index];
  strip.chunk.clear();
  const std::size_t start = begin_png_chunk(strip.chunk, "IDAT");
  if (index == 0) append_text(strip.chunk, "\x78\x01");  // compressed fast (RFC 1950)
  strip.chunk.insert(strip.chunk.end(), compressed.begin(), compressed.end());
  end_png_chunk(strip.chunk, start);
  strip.checksum = static_cast<std::uint32_t>(adler32_z(1, rows.data(), rows.size()));
  strip.stale = false;
}

Bytes PngEncoder::assemble() const {
  std::size_t size = 128;
  for (const Strip& strip : strips_) size += strip.chunk.size();
  Bytes png;
  png.reserve(size);
  append_png_header(png, width_px_, height_px_, has_alpha_);
  append_png_srgb(png);
  uLong checksum = 1;
  for (std::size_t i = 0; i < strips_.size(); ++i) {
    png.insert(png.end(), strips_[i].chunk.begin(), strips_[i].chunk.end());
    checksum =
        adler32_combine(checksum, strips_[i].checksum, static_cast<z_off_t>(rows_of(i).size()));
  }
  const std::size_t last = begin_png_chunk(png, "IDAT");
  append_text(png, {"\x03\x00", 2});  // an empty last block (RFC 1951, 3.2.6)
  append_u32(png, static_cast<std::uint32_t>(checksum));
  end_png_chunk(png, last);
  end_png_chunk(png, begin_png_chunk(png, "IEND"));
  return png;
}

std::vector<std::uint8_t> encode_png(const ImageView& image) {
  PngEncoder encoder;
  encoder.filter(image, {});
  return encoder.compress();
}

}  // namespace piblocks
