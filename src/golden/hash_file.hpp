// Files of frame hashes, as FFmpeg's framehash and framemd5 muxers write them.
// In: a file. Out: its lines; or a row for every line of two files.
#pragma once

#include <string>
#include <vector>

#include "golden/rows.hpp"

namespace piblocks {

/// By the file extension.
bool is_framehash(const std::string& name);

struct FramehashFile {
  std::vector<std::string> header;  ///< its lines, without the one that names the software
  std::vector<std::string> frames;  ///< a line each, without blanks
};

/// @throws IoError if it cannot be read, is not such a file, or has more than kMaxHashes lines.
FramehashFile read_framehash(const std::string& path);

/// Compares line by line. @throws UsageError if one is no file of hashes, by its name, or the job
/// has a tolerance or masks.
void compare_hashes(const ComparisonJob& job, Rows& rows);

}  // namespace piblocks
