// PNG pictures.
#include <fmt/format.h>
#include <piblocks/encode.hpp>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <future>
#include <span>

#include "media/output/output_kinds.hpp"
#include "media/pixels/rgb24.hpp"
#include "media/png/png_chunk.hpp"

namespace piblocks {
namespace {

/// Compresses of each image only what differs from the one before. A file is cut into strips of
/// rows. Each strip has a chunk of its own, whose bytes depend on the strip's rows alone: strips
/// that have not changed are copied. Few strips change, since filter Up leaves only the upper and
/// lower edges of a shape that moves sideways.
class PngEncoder final : public PacketPerFrameEncoder {
 public:
  explicit PngEncoder(const VideoFormat& format)
      : PacketPerFrameEncoder(format),
        width_px_(format.width_px),
        height_px_(format.height_px),
        has_alpha_(format.has_alpha),
        row_bytes_(std::size_t(width_px_) * packed_bytes(has_alpha_) + 1),
        blank_(row_bytes_ * kStripRows),
        strips_(std::size_t((height_px_ + kStripRows - 1) / kStripRows)) {
    for (std::size_t at = 0; at < blank_.size(); at += row_bytes_) blank_[at] = kPngFilterUp;
  }

 private:
  /// Chosen from the table in tests/benchmark/encoders.md.
  static constexpr int kStripRows = 8;

  struct Strip {
    Bytes rows;  // filtered; none if they are blank_
    Bytes chunk;
    std::uint32_t checksum = 0;  // Adler-32 of the filtered rows
    bool stale = true;
  };

  void convert(const ImageView& frame, std::span<const PixelRect> rects) override {
    for (const PixelRect& rect : rects) filter_rect(frame, rect);
  }
  Bytes encode_picture(std::int64_t /*number*/) override {
    std::size_t size = 128;
    for (std::size_t i = 0; i < strips_.size(); ++i) {
      if (strips_[i].stale) compress_strip(i);
      size += strips_[i].chunk.size();
    }
    Bytes png;
    png.reserve(size);
    append_png_header(png, width_px_, height_px_, has_alpha_ ? PngColors::rgba : PngColors::rgb);
    append_png_srgb(png);
    uLong checksum = 1;
    for (std::size_t i = 0; i < strips_.size(); ++i) {
      append(png, strips_[i].chunk);
      checksum = adler32_combine(checksum, strips_[i].checksum, z_off_t(rows_of(i).size()));
    }
    const std::size_t last = begin_png_chunk(png, "IDAT");
    append(png, std::string_view("\x03\x00", 2));  // an empty last block (RFC 1951, 3.2.6)
    append_big_endian(png, checksum, 4);
    end_png_chunk(png, last);
    append_png_chunk(png, "IEND");
    return png;
  }
  /// Up is the difference from the row above, zero above the first: the row below changes too.
  void filter_rect(const ImageView& image, const PixelRect& rect) {
    const std::size_t bytes = std::size_t(rect.width_px) * packed_bytes(has_alpha_);
    Bytes above(bytes);
    Bytes current(bytes);
    if (rect.y_px > 0) pack_row(image, rect, rect.y_px - 1, above.data());
    const int end = std::min(rect.bottom_px() + 1, height_px_);
    const Bytes zeros(bytes);
    Bytes difference(bytes);
    for (int y = rect.y_px; y < end; ++y) {
      // So are most rows, and packing them costs more than all the rest.
      if (y > 0 && is_row_as_above(image, rect, y)) {
        set_filtered(y, rect.x_px, zeros);
        continue;
      }
      pack_row(image, rect, y, current.data());
      subtract_bytes(current.data(), above.data(), bytes, difference.data());
      set_filtered(y, rect.x_px, difference);
      current.swap(above);
    }
  }
  static bool is_row_as_above(const ImageView& image, const PixelRect& rect, int y) {
    const std::ptrdiff_t left = std::ptrdiff_t{4} * rect.x_px;
    return std::memcmp(image.row(y) + left, image.row(y - 1) + left,
                       4 * std::size_t(rect.width_px)) == 0;
  }
  void set_filtered(int y, int x, ByteSpan difference) {
    Strip& strip = strips_[std::size_t(y / kStripRows)];
    const std::size_t at =
        std::size_t(y % kStripRows) * row_bytes_ + 1 + std::size_t(x) * packed_bytes(has_alpha_);
    const Bytes& before = strip.rows.empty() ? blank_ : strip.rows;
    if (std::memcmp(difference.data(), before.data() + at, difference.size()) == 0) return;
    if (strip.rows.empty()) strip.rows = blank_;
    std::memcpy(strip.rows.data() + at, difference.data(), difference.size());
    strip.stale = true;
  }
  /// The pieces of all strips make one zlib stream, whose header the first strip has.
  void compress_strip(std::size_t index) {
    const ByteSpan rows = rows_of(index);
    Strip& strip = strips_[index];
    if (index > 1 && std::ranges::equal(rows, rows_of(index - 1))) {
      strip = strips_[index - 1];
      return;
    }
    strip.chunk.clear();
    const std::size_t start = begin_png_chunk(strip.chunk, "IDAT");
    if (index == 0) append(strip.chunk, "\x78\x01");  // compressed fast (RFC 1950)
    append(strip.chunk, deflater_.compress(rows));
    end_png_chunk(strip.chunk, start);
    strip.checksum = std::uint32_t(adler32_z(1, rows.data(), rows.size()));
    strip.stale = false;
  }
  ByteSpan rows_of(std::size_t index) const {
    const Bytes& rows = strips_[index].rows.empty() ? blank_ : strips_[index].rows;
    const std::size_t count = std::size_t(height_px_) - index * kStripRows;
    return ByteSpan(rows).first(std::min<std::size_t>(count, kStripRows) * row_bytes_);
  }

  Deflater deflater_{Deflater::Form::piece};
  int width_px_;
  int height_px_;
  bool has_alpha_;
  std::size_t row_bytes_;  // with the byte that names the filter
  Bytes blank_;            // the filtered rows of a strip that repeats the row above it
  std::vector<Strip> strips_;
};

/// A zlib stream (RFC 1950). Two threads compress a half each, which takes nearly all of the time.
Bytes compressed(ByteSpan rows) {
  const auto compress = [](ByteSpan piece) {
    Deflater deflater(Deflater::Form::piece);
    const ByteSpan bytes = deflater.compress(piece);
    return Bytes(bytes.begin(), bytes.end());
  };
  auto second = std::async(compress, rows.subspan(rows.size() / 2));
  Bytes stream = {0x78, 0x01};
  append(stream, compress(rows.first(rows.size() / 2)));
  append(stream, second.get());
  append(stream, std::string_view("\x03\x00", 2));  // an empty last block (RFC 1951, 3.2.6)
  append_big_endian(stream, adler32_z(1, rows.data(), rows.size()), 4);
  return stream;
}

/// A file of rows that are filtered. @param palette  none if empty
Bytes with_rows(int width_px, int height_px, PngColors colors, ByteSpan palette, ByteSpan rows,
                std::uint8_t bits = 8) {
  Bytes png;
  append_png_header(png, width_px, height_px, colors, bits);
  append_png_srgb(png);
  if (!palette.empty()) append_png_chunk(png, "PLTE", palette);
  append_png_chunk(png, "IDAT", compressed(rows));
  append_png_chunk(png, "IEND");
  return png;
}

/// @tparam kShifts  of the bytes of a pixel in its word, in order
template <int... kShifts, typename Picture>
Bytes encode_all_channels(const Picture& picture) {
  constexpr std::size_t kBytes = sizeof...(kShifts);
  Bytes rows;
  append_up_filtered(rows, picture.height_px, kBytes * std::size_t(picture.width_px),
                     [&](int row, std::uint8_t* to) {
                       const auto* const words =
                           picture.words.data() + std::ptrdiff_t{row} * picture.width_px;
                       for (const auto word : std::span(words, words + picture.width_px)) {
                         ((*to++ = std::uint8_t(word >> kShifts)), ...);
                       }
                     });
  return with_rows(picture.width_px, picture.height_px, PngColors::rgba, {}, rows, 2 * kBytes);
}

}  // namespace

Bytes encode_png(const ImageView& image) {
  PngEncoder encoder(
      {.width_px = image.width_px, .height_px = image.height_px, .has_alpha = image.has_alpha});
  encoder.begin(0);
  encoder.take(image);
  encoder.encode();
  return encoder.finish().front().bytes;
}

Bytes encode_png_samples(const Image& picture) {
  const auto is_opaque = [](std::uint32_t word) { return word >= 0xff000000; };
  if (std::ranges::all_of(picture.words, is_opaque)) return encode_png(picture.view());
  return encode_all_channels<16, 8, 0, 24>(picture);
}

Bytes encode_png_samples(const DeepImage& picture) {
  return encode_all_channels<40, 32, 24, 16, 8, 0, 56, 48>(picture);
}

Bytes encode_png_palette(int width_px, int height_px, std::span<const std::uint32_t> palette,
                         const std::function<void(int row, std::uint8_t* indices)>& pack_row) {
  Bytes rows;
  rows.reserve((std::size_t(width_px) + 1) * std::size_t(height_px));
  append_up_filtered(rows, height_px, std::size_t(width_px), pack_row);
  Bytes colors;
  for (const std::uint32_t color : palette) append_big_endian(colors, color, 3);
  return with_rows(width_px, height_px, PngColors::palette, colors, rows);
}

Output png_output(const OutputRequest& request) {
  const PictureKind kind = {
      [](ByteSpan png) { return with_png_mark(png, PngMark::sequence); },
      [](const std::filesystem::path& path) { return has_png_mark(path, PngMark::sequence); },
      std::string_view("\0\0\0\0IEND\xae\x42\x60\x82", 12)};
  return {
      .frames_per_chunk = 16,  // few wait to be written, and workers end nearly together
      .signature = fmt::format("png by zlib {}", zlibVersion()),
      .make_encoder = [format = request.format] { return std::make_unique<PngEncoder>(format); },
      .open = sequence_of(request, kind)};
}

}  // namespace piblocks
