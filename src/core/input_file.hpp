// Files that are read.
#pragma once

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "core/large_pages.hpp"

namespace piblocks {

/// Opening a pipe would wait for a writer, perhaps for ever.
/// @throws IoError for a pipe, a socket or a device.
inline void refuse_pipe(const std::filesystem::path& path, std::string_view operation) {
  std::error_code unknown;
  if (!std::filesystem::is_other(std::filesystem::status(path, unknown))) return;
  throw IoError(
      fmt::format("{}: cannot read '{}': it is no regular file", operation, path.string()));
}

/// The first bytes of a regular file, with zeros behind its end; nothing if this is none.
inline std::optional<std::string> beginning_of(const std::filesystem::path& path,
                                               std::size_t count) {
  std::error_code unknown;
  if (!std::filesystem::is_regular_file(path, unknown)) return std::nullopt;
  std::string bytes(count, '\0');
  std::ifstream(path, std::ios::binary).read(bytes.data(), std::ssize(bytes));
  return bytes;
}

/// A regular file of at most `most_bytes`; empty if there is none, or if it cannot be read.
inline std::vector<std::uint8_t> bytes_of_file(const std::filesystem::path& path,
                                               std::size_t most_bytes) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return {};
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error || size > most_bytes) return {};
  std::vector<std::uint8_t> bytes;
  bytes.reserve(size);
  prefer_large_pages(bytes.data(), size);
  bytes.resize(size);
  std::ifstream file(path, std::ios::binary);
  file.read(reinterpret_cast<char*>(bytes.data()), std::ssize(bytes));
  return file.gcount() == std::ssize(bytes) ? bytes : std::vector<std::uint8_t>();
}

/// A regular file whole. @throws IoError if it is none, is empty, or cannot be read
inline std::vector<std::uint8_t> whole_file(const std::filesystem::path& path,
                                            std::string_view operation) {
  constexpr std::size_t kAny = std::size_t{1} << 40;
  std::vector<std::uint8_t> bytes = bytes_of_file(path, kAny);
  if (!bytes.empty()) return bytes;
  throw IoError(fmt::format("{}: cannot read '{}'", operation, path.string()));
}

/// The lines of a text file; none if it is not there. @throws IoError
inline std::vector<std::string> lines_of(const std::filesystem::path& path,
                                         std::string_view operation) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return {};
  refuse_pipe(path, operation);
  std::ifstream file(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) {
    if (line.ends_with('\r')) line.pop_back();  // written or checked out on Windows
    lines.push_back(line);
  }
  if (!file.bad() && file.eof()) return lines;
  throw IoError(fmt::format("{}: cannot read '{}'", operation, path.string()));
}

/// Whether the path is the folder or in it, links followed. Neither has to be there.
inline bool lies_in(const std::filesystem::path& path, const std::filesystem::path& folder) {
  std::error_code error;
  const std::filesystem::path relative = std::filesystem::relative(
      std::filesystem::absolute(path), std::filesystem::absolute(folder), error);
  return !error && !relative.empty() && *relative.begin() != "..";
}

}  // namespace piblocks
