// Where the program lies: the file that this code was linked into.
// In: nothing. Out: its path. own_binary_linux.cpp asks the dynamic linker of the GNU C library,
// own_binary_posix.cpp any system's; the build takes one of them.
#pragma once

#include <filesystem>
#include <system_error>

namespace piblocks {

/// The program or shared library that this code is part of; empty if the system does not say.
std::filesystem::path own_binary();

/// Whether CMake builds in this folder. Only there may a binary load files from beside it: in any
/// other folder, such as one for downloads, they may be anybody's.
inline bool is_build_folder(const std::filesystem::path& folder) {
  std::error_code unknown;
  return std::filesystem::exists(folder / "CMakeCache.txt", unknown);
}

}  // namespace piblocks
