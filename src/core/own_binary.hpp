// Where the program lies: the file that this code was linked into.
// In: nothing. Out: its path. own_binary_linux.cpp asks the dynamic linker of the GNU C library,
// own_binary_posix.cpp any system's; the build takes one of them.
#pragma once

#include <filesystem>

namespace piblocks {

/// The program or shared library that this code is part of; empty if the system does not say.
std::filesystem::path own_binary();

}  // namespace piblocks
