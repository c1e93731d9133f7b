// Files that are read.
#pragma once

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

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

}  // namespace piblocks
