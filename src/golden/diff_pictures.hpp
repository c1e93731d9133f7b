// Pictures of differences in a folder. Several comparisons may share it: the last one wins.
// In: PNG files with their names. Out: these files, instead of those of earlier comparisons.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/file_set.hpp"
#include "core/overwrite_check.hpp"
#include "media/output/bytes.hpp"

namespace piblocks {

class DiffPictures {
 public:
  /// Names of the pictures of frames, by number.
  static constexpr const char* kPattern = "%06d.png";

  enum class Making { at_once, when_needed };

  /// @param making  when the folder is made: `at_once`, so that a long comparison does not fail at
  ///                its end; or `when_needed`, so that one without differences leaves no folder.
  /// @throws UsageError if the folder cannot be made.
  DiffPictures(std::filesystem::path folder, Making making);

  /// @param png  a whole file, which gets a mark.
  void add(const std::string& name, ByteSpan png);
  std::size_t count() const noexcept { return pictures_.size(); }
  /// Writes the pictures, and removes those of earlier comparisons, which carry the mark. Waits
  /// while another comparison does the same.
  /// @param may_be_old  names that an earlier comparison may have used.
  /// @throws UsageError if a picture would replace a file that no comparison has written; IoError
  void finish(const FileNames& may_be_old);

 private:
  struct Picture {
    std::string name;
    Bytes bytes;
  };

  std::vector<std::string> old_pictures(const FileNames& may_be_old) const;
  void make_folder();

  std::filesystem::path folder_;
  std::optional<FileSet> files_;
  std::vector<Picture> pictures_;
};

}  // namespace piblocks
