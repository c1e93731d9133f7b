// The pictures that a name on the command line stands for, found without reading one.
// In: a PNG file, a folder, or a pattern such as frames/%06d.png. Out: their paths, and which of
// one list belongs to which of another.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/overwrite_check.hpp"
#include "media/output/frame_pattern.hpp"

namespace piblocks {

struct ListedPicture {
  std::string name;                         ///< its path in the folder, or its file name
  std::filesystem::path path;               ///< to open it
  std::optional<std::int64_t> number = {};  ///< in a pattern
  std::string problem = {};  ///< of a folder that stands here because it cannot be read: why
};

struct PictureList {
  enum class Kind { file, folder, pattern };

  Kind kind = Kind::file;
  std::vector<ListedPicture> pictures = {};  ///< by the numbers in their names
  std::string problem = {};                  ///< why there is none
  std::optional<FramePattern> pattern = {};
};

/// Whether the name is a pattern for PNG files. A file may have a percent sign in its name.
bool is_picture_pattern(const std::string& name);

/// A folder or file that cannot be read is listed with the reason, or read in vain later.
/// @param is_recursive  whether the folders in a folder are searched too
/// @throws UsageError if a pattern is not valid.
PictureList list_pictures(const std::string& name, bool is_recursive);

/// Two pictures to compare, or one that has no partner, as indices.
struct PicturePair {
  std::optional<std::size_t> reference;
  std::optional<std::size_t> actual;
};

/// Pairs two lists: by number if one is a pattern, else by name. What has no partner because the
/// other list's folder cannot be read is left out: that folder is in the list.
std::vector<PicturePair> paired(const PictureList& reference, const PictureList& actual);

/// Enters the files that the name stands for as files that are read.
/// @param what  their role in the comparison, for messages
void claim_pictures(OverwriteCheck& check, const std::string& what, const std::string& name,
                    bool is_recursive);

}  // namespace piblocks
