// The pictures that a name on the command line stands for, found without reading one.
// In: a PNG file, a folder, or a pattern such as frames/%06d.png. Out: the paths of the pictures;
// the pairs of two such lists.
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
  std::string problem = {};  ///< why a folder cannot be read, which then stands here; else empty
};

struct PictureList {
  bool is_one_file = false;                  ///< whether the name is that of one existing file
  std::vector<ListedPicture> pictures = {};  ///< by the numbers in their names
  std::string problem = {};                  ///< why there is none
  std::optional<FramePattern> pattern = {};
};

/// Whether the name is a pattern for PNG files. A file may have a percent sign in its name.
bool is_picture_pattern(const std::string& name);

/// A folder that cannot be read is listed with the reason. Files are not opened.
/// @param is_recursive  whether the folders in a folder are searched too
/// @throws UsageError if a pattern is not valid.
PictureList list_pictures(const std::string& name, bool is_recursive);

/// Two pictures to compare, or one that has no partner, as indices.
struct PicturePair {
  std::optional<std::size_t> reference;
  std::optional<std::size_t> actual;
};

/// Pairs two lists: by number if one is a pattern, else by name. Leaves out a picture whose partner
/// may be in a folder that cannot be read: the other list has that folder, with the reason.
std::vector<PicturePair> paired(const PictureList& reference, const PictureList& actual);

/// Enters the files that the name stands for as files that are read.
/// @param what  their role in the comparison, for messages
void claim_pictures(OverwriteCheck& check, const std::string& what, const std::string& name,
                    bool is_recursive);

}  // namespace piblocks
