// How piblocks knows its own PNG files: by a chunk of text at a fixed place.
// In: a PNG file without the mark. Out: the same picture with it; whether a file has it.
#pragma once

#include <filesystem>

#include "media/output/bytes.hpp"

namespace piblocks {

/// What a picture belongs to. A command replaces and removes only pictures of its own kind.
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

}  // namespace piblocks
