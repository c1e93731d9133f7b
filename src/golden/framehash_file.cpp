#include "golden/framehash_file.hpp"

#include <fmt/format.h>
#include <piblocks/compare_files.hpp>
#include <piblocks/error.hpp>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <system_error>

namespace piblocks {
namespace {

/// More than a line of the longest hash has.
constexpr std::size_t kMaxLine = 4096;

/// Stream, dts, pts, duration, size, hash.
bool is_frame(const std::string& line) {
  return std::ranges::count(line, ',') == 5 && line.find_first_of("0123456789") == 0;
}

std::string without_blanks(std::string line) {
  std::erase_if(line, [](char c) { return c == ' ' || c == '\t' || c == '\r'; });
  return line;
}

}  // namespace

FramehashFile read_framehash(const std::string& path) {
  std::ifstream file(path);
  if (!file) {
    throw IoError(fmt::format("framehash: cannot read '{}': {}", path,
                              std::generic_category().message(errno)));
  }
  FramehashFile result;
  std::vector<char> line(kMaxLine);
  for (std::size_t number = 1; file.getline(line.data(), kMaxLine); ++number) {
    const std::string text = without_blanks(line.data());
    if (text.starts_with("#software")) continue;
    const bool is_header = text.empty() || text.front() == '#';
    if (!is_header && !is_frame(text)) {
      throw IoError(fmt::format("framehash: '{}': line {} is no hash of a frame", path, number));
    }
    if (number > kMaxHashes) {
      throw IoError(fmt::format("framehash: '{}' has more than {} lines", path, kMaxHashes));
    }
    if (!text.empty()) (is_header ? result.header : result.frames).push_back(text);
  }
  if (!file.eof() || result.header.empty()) {
    throw IoError(fmt::format("framehash: '{}' is no file of hashes", path));
  }
  return result;
}

}  // namespace piblocks
