// Hashes of frames, as FFmpeg's framehash and framemd5 muxers write them.
// In: a file. Out: its header, and a line for each frame.
#pragma once

#include <string>
#include <vector>

namespace piblocks {

struct FramehashFile {
  std::vector<std::string> header;  ///< its lines, without the one that names the software
  std::vector<std::string> frames;  ///< a line each, without blanks
};

/// @throws IoError if it cannot be read or is not such a file.
FramehashFile read_framehash(const std::string& path);

}  // namespace piblocks
