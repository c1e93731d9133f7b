// PNG files that no encoder of ours writes.
// In: samples of any depth and colour type. Out: the bytes of a file, with whatever chunks are
// asked for.
#pragma once

#include <zlib.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

namespace piblocks::testing_support {

/// ISO/IEC 15948, table 11.1.
enum class PngColour { grey = 0, rgb = 2, palette = 3, grey_alpha = 4, rgba = 6 };

inline int channels_of(PngColour colour) {
  constexpr int kChannels[] = {1, 0, 3, 1, 2, 0, 4};
  return kChannels[static_cast<int>(colour)];
}

struct HandMadePng {
  int width_px = 1;
  int height_px = 1;
  int bits = 8;
  PngColour colour = PngColour::rgb;
  std::vector<int> levels = {};  ///< row by row, the channels of a pixel after each other
  std::string chunks = {};       ///< that stand before the pixels
  bool is_interlaced = false;
  std::vector<int> filters = {};  ///< of the rows, in turn; without any, no row is filtered
  int compression = -1;           ///< of zlib, 0 to 9; -1 is its default
};

inline std::string big_endian(std::uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 0xff);
  return bytes;
}

inline std::string png_chunk(const std::string& type, const std::string& data) {
  const std::string body = type + data;
  const uLong crc = crc32(0, reinterpret_cast<const Bytef*>(body.data()), uInt(body.size()));
  return big_endian(static_cast<std::uint32_t>(data.size())) + body +
         big_endian(static_cast<std::uint32_t>(crc));
}

/// What a filter predicts of a byte from those left, above, and above left of it (ISO/IEC
/// 15948, 9.2).
inline int png_prediction(int filter, int left, int above, int above_left) {
  if (filter == 1) return left;
  if (filter == 2) return above;
  if (filter == 3) return (left + above) / 2;
  if (filter == 0) return 0;
  const int sum = left + above - above_left;
  const int from_left = std::abs(sum - left);
  const int from_above = std::abs(sum - above);
  const int from_above_left = std::abs(sum - above_left);
  if (from_left <= from_above && from_left <= from_above_left) return left;
  return from_above <= from_above_left ? above : above_left;
}

/// Filters rows that each stand behind a zero.
inline std::string png_filtered(const std::string& rows, std::size_t row_bytes,
                                std::size_t pixel_bytes, const std::vector<int>& filters) {
  std::string filtered = rows;
  for (std::size_t at = 0, y = 0; at < rows.size(); at += row_bytes + 1, ++y) {
    const int filter = filters[y % filters.size()];
    filtered[at] = static_cast<char>(filter);
    const auto byte = [&](std::size_t i, std::size_t back) {
      return back > i ? 0 : static_cast<int>(static_cast<std::uint8_t>(rows[i - back]));
    };
    for (std::size_t x = 0; x < row_bytes; ++x) {
      const std::size_t i = at + 1 + x;
      const bool has_left = x >= pixel_bytes;
      const int left = has_left ? byte(i, pixel_bytes) : 0;
      const int above = y > 0 ? byte(i, row_bytes + 1) : 0;
      const int above_left = y > 0 && has_left ? byte(i, row_bytes + 1 + pixel_bytes) : 0;
      filtered[i] = static_cast<char>(byte(i, 0) - png_prediction(filter, left, above, above_left));
    }
  }
  return filtered;
}

/// The pixels that start at (x, y), in steps of (dx, dy), as rows without a filter.
inline std::string png_rows(const HandMadePng& png, int x0, int y0, int dx, int dy) {
  std::string bytes;
  if (x0 >= png.width_px) return bytes;
  const int channels = channels_of(png.colour);
  for (int y = y0; y < png.height_px; y += dy) {
    bytes += '\0';
    unsigned bits = 0;
    int count = 0;
    for (int x = x0; x < png.width_px; x += dx) {
      for (int channel = 0; channel < channels; ++channel) {
        const int at = (y * png.width_px + x) * channels + channel;
        const auto level = static_cast<unsigned>(png.levels.at(static_cast<std::size_t>(at)));
        bits = bits << png.bits | level;
        for (count += png.bits; count >= 8; count -= 8) {
          bytes += static_cast<char>(bits >> (count - 8) & 0xff);
        }
      }
    }
    if (count > 0) bytes += static_cast<char>(bits << (8 - count) & 0xff);
  }
  return bytes;
}

inline std::string file_of(const HandMadePng& png) {
  std::string rows;
  if (png.is_interlaced) {
    constexpr int kAdam7[][4] = {{0, 0, 8, 8}, {4, 0, 8, 8}, {0, 4, 4, 8}, {2, 0, 4, 4},
                                 {0, 2, 2, 4}, {1, 0, 2, 2}, {0, 1, 1, 2}};
    for (const auto& [x, y, dx, dy] : kAdam7) rows += png_rows(png, x, y, dx, dy);
  } else {
    rows = png_rows(png, 0, 0, 1, 1);
  }
  if (!png.filters.empty()) {
    const auto row_bits =
        static_cast<std::size_t>(png.width_px * channels_of(png.colour) * png.bits);
    const auto pixel_bits = static_cast<std::size_t>(channels_of(png.colour) * png.bits);
    rows = png_filtered(rows, (row_bits + 7) / 8, (pixel_bits + 7) / 8, png.filters);
  }
  uLongf size = compressBound(rows.size());
  std::string compressed(size, '\0');
  compress2(reinterpret_cast<Bytef*>(compressed.data()), &size,
            reinterpret_cast<const Bytef*>(rows.data()), rows.size(), png.compression);
  compressed.resize(size);
  std::string header = big_endian(static_cast<std::uint32_t>(png.width_px)) +
                       big_endian(static_cast<std::uint32_t>(png.height_px));
  for (const int byte : {png.bits, static_cast<int>(png.colour), 0, 0, png.is_interlaced ? 1 : 0}) {
    header += static_cast<char>(byte);
  }
  return "\x89PNG\r\n\x1a\n" + png_chunk("IHDR", header) + png.chunks +
         png_chunk("IDAT", compressed) + png_chunk("IEND", "");
}

}  // namespace piblocks::testing_support
