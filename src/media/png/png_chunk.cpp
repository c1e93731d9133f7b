#include "media/png/png_chunk.hpp"

#include <zlib.h>

namespace piblocks {
namespace {

using Bytes = std::vector<std::uint8_t>;

void put_u32(std::uint8_t* at, std::uint32_t value) {
  for (int i = 0; i < 4; ++i) at[i] = static_cast<std::uint8_t>(value >> (24 - 8 * i));
}

}  // namespace

void append_u16(Bytes& png, std::uint32_t value) {
  png.push_back(static_cast<std::uint8_t>(value >> 8));
  png.push_back(static_cast<std::uint8_t>(value));
}

void append_u32(Bytes& png, std::uint32_t value) {
  png.resize(png.size() + 4);
  put_u32(png.data() + png.size() - 4, value);
}

void append_text(Bytes& png, std::string_view text) {
  for (const char c : text) png.push_back(static_cast<std::uint8_t>(c));
}

std::size_t begin_png_chunk(Bytes& png, std::string_view type) {
  const std::size_t start = png.size();
  append_u32(png, 0);
  append_text(png, type);
  return start;
}

void end_png_chunk(Bytes& png, std::size_t start) {
  const std::uint8_t* type = png.data() + start + 4;
  const std::size_t length = png.size() - start - 8;
  put_u32(png.data() + start, static_cast<std::uint32_t>(length));
  append_u32(png, static_cast<std::uint32_t>(crc32_z(0, type, length + 4)));
}

void append_png_header(Bytes& png, int width_px, int height_px, bool has_alpha) {
  append_text(png, "\x89PNG\r\n\x1a\n");
  const std::size_t header = begin_png_chunk(png, "IHDR");
  append_u32(png, static_cast<std::uint32_t>(width_px));
  append_u32(png, static_cast<std::uint32_t>(height_px));
  // 8 bits a sample, colour type 2 (RGB) or 6 (RGB and alpha).
  append_text(png, {has_alpha ? "\x08\x06\0\0\0" : "\x08\x02\0\0\0", 5});
  end_png_chunk(png, header);
}

void append_png_srgb(Bytes& png) {
  const std::size_t colours = begin_png_chunk(png, "sRGB");
  png.push_back(0);  // perceptual intent
  end_png_chunk(png, colours);
}

}  // namespace piblocks
