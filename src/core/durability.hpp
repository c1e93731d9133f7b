// What systems do differently to make files survive a power failure.
// In: open files, folders. Out: 0, or an errno. durability_linux.cpp has the calls of Linux,
// durability_posix.cpp those of POSIX; the build takes one of them.
#pragma once

#include <filesystem>

#include "core/descriptor.hpp"

namespace piblocks {

/// Syncs a file or a folder to its device. @return 0, or an errno.
int sync_file(int descriptor) noexcept;

/// Syncs all files of a folder. @param descriptor  any open file or folder of their file system.
/// @return 0, or an errno.
int sync_files(const std::filesystem::path& folder, int descriptor);

/// Opens a folder for renameat(). @return a closed one, with errno set, if it cannot be opened.
Descriptor open_to_rename_in(const std::filesystem::path& folder) noexcept;

}  // namespace piblocks
