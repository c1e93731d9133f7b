// Finds files that were cut off, where libavformat does not: GIF, Matroska, WebM.
// In: a file. Out: whether its own structure continues beyond its end.
#pragma once

#include <string>

namespace piblocks {

/// False for other kinds of files, for a file without its size, such as a live stream, and for a
/// pipe.
bool is_cut_off(const std::string& path);

}  // namespace piblocks
