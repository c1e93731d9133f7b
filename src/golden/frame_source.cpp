#include "golden/frame_source.hpp"

#include <fmt/format.h>
#include <piblocks/compare.hpp>
#include <piblocks/error.hpp>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <optional>
#include <string_view>
#include <system_error>

#include "core/descriptor.hpp"
#include "core/text.hpp"
#include "media/libav/av_module.hpp"
#include "media/output/frame_pattern.hpp"
#include "media/png/png_reader.hpp"

namespace piblocks {
namespace fs = std::filesystem;
namespace {

/// True also if the system does not say, as in a folder that may not be searched: reading the
/// file reports that.
bool may_exist(const fs::path& path) {
  std::error_code unknown;
  return fs::status(path, unknown).type() != fs::file_type::not_found;
}

bool is_folder(const fs::path& path) {
  std::error_code unknown;
  return fs::is_directory(path, unknown);
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Removes the number that `text` begins with, and returns it without its leading zeros.
std::string_view take_number(std::string_view& text) {
  std::size_t end = 0;
  while (end < text.size() && is_digit(text[end])) ++end;
  std::string_view number = text.substr(0, end);
  text.remove_prefix(end);
  number.remove_prefix(std::min(number.find_first_not_of('0'), number.size()));
  return number;
}

/// By the numbers in names: frame2 comes before frame10.
bool comes_before(const fs::path& one, const fs::path& other) {
  const std::string one_name = one.filename();
  const std::string other_name = other.filename();
  std::string_view a = one_name;
  std::string_view b = other_name;
  while (!a.empty() && !b.empty()) {
    if (is_digit(a.front()) && is_digit(b.front())) {
      const std::string_view m = take_number(a);
      const std::string_view n = take_number(b);
      if (m.size() != n.size()) return m.size() < n.size();
      if (m != n) return m < n;
      continue;
    }
    if (a.front() != b.front()) return a.front() < b.front();
    a.remove_prefix(1);
    b.remove_prefix(1);
  }
  return a.size() != b.size() ? a.empty() : one_name < other_name;
}

std::vector<fs::path> png_files_in(const fs::path& folder) {
  std::vector<fs::path> paths;
  std::error_code error;
  for (const fs::path& path : entries_of(folder, error)) {
    if (has_ending(path.filename().native(), ".png")) paths.push_back(path);
  }
  if (error) {
    throw IoError(fmt::format("compare: cannot read '{}': {}", folder.string(), error.message()));
  }
  if (paths.empty()) {
    throw IoError(fmt::format("compare: there is no PNG file in '{}'", folder.string()));
  }
  std::ranges::sort(paths, comes_before);
  return paths;
}

fs::path numbered(const FramePattern& pattern, std::int64_t number) {
  return fs::path(pattern.folder()) / pattern.name(number);
}

/// FFmpeg counts from 0 or from 1.
std::optional<std::int64_t> first_number(const FramePattern& pattern) {
  for (const std::int64_t number : {0, 1}) {
    if (may_exist(numbered(pattern, number))) return number;
  }
  return std::nullopt;
}

/// Frames behind a gap would silently not be compared.
/// @param missing  the first frame that is not there.
void check_for_gap(const FramePattern& pattern, std::int64_t missing) {
  const fs::path folder = pattern.folder().empty() ? "." : pattern.folder();
  std::error_code error;
  for (const fs::path& path : entries_of(folder, error)) {
    const auto number = pattern.number_of(path.filename().native());
    if (!number || *number < missing) continue;
    throw IoError(fmt::format("compare: there is no '{}', but there is '{}' after it",
                              numbered(pattern, missing).string(), path.string()));
  }
}

std::vector<fs::path> png_files_of(const std::string& name) {
  const FramePattern pattern(name);
  std::vector<fs::path> paths;
  for (std::int64_t number = first_number(pattern).value_or(0);; ++number) {
    fs::path path = numbered(pattern, number);
    std::error_code error;
    const bool is_there = fs::exists(path, error);
    if (error) {
      throw IoError(fmt::format("compare: cannot read '{}': {}", path.string(), error.message()));
    }
    if (!is_there) {
      if (!paths.empty()) check_for_gap(pattern, number);
      break;
    }
    paths.push_back(std::move(path));
  }
  if (paths.empty()) throw IoError(fmt::format("compare: there is no file of '{}'", name));
  return paths;
}

/// A file may have a percent sign in its name.
bool is_pattern(const std::string& name) {
  return has_ending(name, ".png") && name.find('%') != std::string::npos && !may_exist(name);
}

/// Longer than a line with the longest hash.
constexpr std::size_t kMaxLine = 4096;

bool is_number(std::string_view text) {
  if (text.starts_with('-')) text.remove_prefix(1);
  return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}

/// Stream, dts, pts, duration, size: numbers; and a hash, which is letters and digits.
bool is_frame(std::string_view line) {
  constexpr int kNumbers = 5;
  for (int i = 0; i < kNumbers; ++i) {
    const std::size_t comma = line.find(',');
    if (comma == std::string_view::npos || !is_number(line.substr(0, comma))) return false;
    line.remove_prefix(comma + 1);
  }
  return !line.empty() && std::ranges::all_of(line, [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
  });
}

std::string without_blanks(std::string line) {
  std::erase_if(line, [](char c) { return c == ' ' || c == '\t' || c == '\r'; });
  return line;
}

}  // namespace

bool frames_exist(const std::string& name) {
  return is_pattern(name) ? first_number(FramePattern(name)).has_value() : may_exist(name);
}

void claim_frames(OverwriteCheck& check, const std::string& what, const std::string& name) {
  if (is_pattern(name)) {
    check.reads_folder(what, FramePattern(name).folder(), names_of_pattern(name));
  } else if (is_folder(name)) {
    check.reads_folder(what, name);
  } else {
    check.reads(what, name);
  }
}

std::unique_ptr<FrameReader> open_frames(const std::string& name, const std::stop_token& stop) {
  if (is_pattern(name)) return read_png_files(png_files_of(name));
  if (is_folder(name)) return read_png_files(png_files_in(name));
  if (has_ending(name, ".png") && !is_animated_png(name)) return read_png_files({name});
  return read_video(name, stop);
}

FramehashFile read_framehash(const std::string& path) {
  std::ifstream file(path);
  if (!file) {
    throw IoError(fmt::format("framehash: cannot read '{}': {}", path, error_text(errno)));
  }
  FramehashFile result;
  std::vector<char> line(kMaxLine);
  for (std::size_t number = 1; file.getline(line.data(), kMaxLine); ++number) {
    // gcount() counts the line's end, except at the end of the file. A line may have a zero in
    // it.
    const auto length = static_cast<std::size_t>(file.gcount()) - (file.eof() ? 0 : 1);
    const std::string text = without_blanks({line.data(), length});
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
