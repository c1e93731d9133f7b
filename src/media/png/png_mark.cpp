#include "media/png/png_mark.hpp"

#include <piblocks/error.hpp>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>

#include "core/descriptor.hpp"
#include "media/png/png_chunk.hpp"

namespace piblocks {
namespace fs = std::filesystem;
namespace {

/// The offset of the first chunk after IHDR.
constexpr std::size_t kMark_at = 33;

/// A tEXt chunk (PNG specification, section 11.3.4.3): keyword, zero, text.
Bytes chunk_of(PngMark mark) {
  Bytes text;
  append(text, std::string_view("Software\0", 9));
  append(text, mark == PngMark::sequence ? "piblocks render" : "piblocks compare --diff");
  Bytes chunk;
  append_png_chunk(chunk, "tEXt", text);
  return chunk;
}

}  // namespace

Bytes with_png_mark(ByteSpan png, PngMark mark) {
  const Bytes chunk = chunk_of(mark);
  Bytes marked;
  marked.reserve(png.size() + chunk.size());
  append(marked, png.first(kMark_at));
  append(marked, chunk);
  append(marked, png.subspan(kMark_at));
  return marked;
}

bool has_png_mark(const fs::path& path, PngMark mark) {
  return has_bytes(path, kMark_at, chunk_of(mark));
}

bool has_bytes(const fs::path& path, std::size_t at, ByteSpan expected) {
  std::error_code unknown;
  if (!fs::is_regular_file(fs::symlink_status(path, unknown))) return false;
  std::string found(expected.size(), '\0');
  std::ifstream file(path, std::ios::binary);
  file.seekg(static_cast<std::streamoff>(at));
  file.read(found.data(), static_cast<std::streamsize>(found.size()));
  if (file.bad()) {
    throw IoError("output: cannot read '" + path.string() + "': " + error_text(errno));
  }
  return file && std::ranges::equal(found, expected, [](char a, std::uint8_t b) {
           return static_cast<std::uint8_t>(a) == b;
         });
}

}  // namespace piblocks
