// The chunks of a PNG file (PNG specification, section 5.3).
// In: a type and data. Out: length, type, data and CRC, appended to a file in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace piblocks {

void append_u16(std::vector<std::uint8_t>& png, std::uint32_t value);
void append_u32(std::vector<std::uint8_t>& png, std::uint32_t value);
void append_text(std::vector<std::uint8_t>& png, std::string_view text);

/// Begins a chunk. What is appended before end_png_chunk() is its data.
/// @return where the chunk starts, for end_png_chunk().
std::size_t begin_png_chunk(std::vector<std::uint8_t>& png, std::string_view type);
void end_png_chunk(std::vector<std::uint8_t>& png, std::size_t start);

/// Signature and header of a picture with 8 bits a sample, RGB or RGBA.
void append_png_header(std::vector<std::uint8_t>& png, int width_px, int height_px, bool has_alpha);
/// The chunk that says that colours are sRGB.
void append_png_srgb(std::vector<std::uint8_t>& png);

}  // namespace piblocks
