// What a name on the command line stands for.
// In: a file, a folder, or a pattern such as frames/%06d.png. Out: its frames, one after the other;
// or the hashes of frames, as FFmpeg's framehash and framemd5 muxers write them.
#pragma once

#include <memory>
#include <stop_token>
#include <string>
#include <vector>

#include "core/overwrite_check.hpp"
#include "media/pixels/frame_reader.hpp"

namespace piblocks {

/// A PNG file; the PNG files of a folder, in the order of the numbers in their names; those of a
/// pattern, from number 0 or 1 on; or else a video, which an animated PNG file is too.
/// @throws IoError, MediaError if it cannot be read; UsageError if the pattern is not valid.
std::unique_ptr<FrameReader> open_frames(const std::string& name, const std::stop_token& stop);

struct FramehashFile {
  std::vector<std::string> header;  ///< its lines, without the one that names the software
  std::vector<std::string> frames;  ///< a line each, without blanks
};

/// @throws IoError if it cannot be read or is not such a file.
FramehashFile read_framehash(const std::string& path);

/// Enters the files that the name stands for as files that are read.
/// @param what  their role in the comparison, for messages
void claim_frames(OverwriteCheck& check, const std::string& what, const std::string& name);

}  // namespace piblocks
