// Tells a file that was cut off from a shorter one, where libavformat does not: GIF, Matroska,
// WebM. In: a file. Out: whether it says of itself that it goes on behind its end.
#pragma once

#include <string>

namespace piblocks {

/// False for a file of another kind, for one that does not know its size, as of a live stream, and
/// for a pipe.
bool is_cut_off(const std::string& path);

}  // namespace piblocks
