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

}  // namespace piblocks
