#include <bit>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>

#include "media/libav/av.hpp"

namespace piblocks {
namespace fs = std::filesystem;
namespace {

constexpr std::uint32_t kSegment = 0x18538067;

/// The next number of EBML (RFC 8794, 4). Its first byte's leading zeros count the bytes after it.
/// @param with_mark  whether the bit behind the zeros belongs to the number, as in an element's ID.
/// @return nothing at the end of the file, and for an unknown size.
std::optional<std::uint64_t> ebml_number(std::istream& file, bool with_mark) {
  const int first = file.get();
  if (first <= 0) return std::nullopt;
  const int others = std::countl_zero(std::uint8_t(first));
  const auto mark = std::uint64_t(0x80 >> others);
  std::uint64_t number = std::uint64_t(first) & (with_mark ? 0xff : mark - 1);
  for (int i = 0; i < others; ++i) number = number << 8 | std::uint8_t(file.get());
  const std::uint64_t unknown = (std::uint64_t{1} << (7 * (others + 1))) - 1;
  if (!file || (!with_mark && number == unknown)) return std::nullopt;
  return number;
}

/// One element, the segment, holds all of a Matroska or WebM file.
bool is_cut_matroska(std::istream& file, std::uint64_t file_bytes) {
  while (true) {
    const auto id = ebml_number(file, true);
    const auto bytes = ebml_number(file, false);
    const std::int64_t begin = file.tellg();
    if (!id || !bytes || begin < 0) return false;
    const bool goes_on = *bytes > file_bytes - std::uint64_t(begin);
    if (goes_on || *id == kSegment) return goes_on;
    file.seekg(std::int64_t(*bytes), std::ios::cur);
  }
}

}  // namespace

bool is_cut_off(const std::string& path) {
  std::error_code no_file;
  if (!fs::is_regular_file(path, no_file)) return false;
  const std::uintmax_t bytes = fs::file_size(path, no_file);
  std::ifstream file(path, std::ios::binary);
  std::string start(4, '\0');
  if (no_file || !file.read(start.data(), static_cast<std::streamsize>(start.size()))) return false;
  file.seekg(0);
  return start == "\x1a\x45\xdf\xa3" && is_cut_matroska(file, bytes);
}

}  // namespace piblocks
