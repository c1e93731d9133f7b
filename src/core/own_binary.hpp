// Where the program lies: the file that this code was linked into; and what is installed with it.
// In: nothing, or a file's name. Out: a path. own_binary_linux.cpp asks the dynamic linker of the
// GNU C library, own_binary_posix.cpp any system's; the build takes one of them.
#pragma once

#include <filesystem>
#include <system_error>
#include <vector>

namespace piblocks {

/// The program or shared library that this code is part of; empty if the system does not say.
std::filesystem::path own_binary();

/// Where a file that is installed with the program may be, best first. Never in the working folder,
/// and beside the program only where CMake builds: in any other folder, such as one for downloads,
/// files may be anybody's.
/// @param installed   below the prefix. @param from_build  from the folder of the build
inline std::vector<std::filesystem::path> places_of_installed(
    const std::filesystem::path& prefix, const std::filesystem::path& installed,
    const std::filesystem::path& from_build) {
  std::vector<std::filesystem::path> places;
  const std::filesystem::path home = own_binary().parent_path();
  if (home.is_absolute()) {
    std::error_code unknown;
    places.push_back(home / ".." / installed);
    if (exists(home / "CMakeCache.txt", unknown)) places.push_back(home / from_build);
  }
  places.push_back(prefix / installed);
  return places;
}

}  // namespace piblocks
