// Keeps a command from writing over what it reads, and over its own outputs.
// In: the files that it reads, and those that it is going to write. Out: nothing, or a UsageError
// that names both.
//
// Files are compared by device and inode, so symbolic links, hard links and different paths do not
// matter. A file that does not exist yet is compared by its folder and name.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace piblocks {

using FileId = std::pair<dev_t, ino_t>;
/// A folder: the nearest one that exists, and the rest of the path.
using FilePlace = std::pair<FileId, std::string>;
/// Whether a name is one of those that are read or written.
using FileNames = std::function<bool(const std::string& name)>;

/// A file, or a folder with names in it.
struct FileClaim {
  std::string what;
  std::string path;
  std::vector<FileId> files = {};        ///< those that exist, sorted
  std::optional<FilePlace> folder = {};  ///< in which the file is, or whose names are claimed
  std::optional<std::string> name = {};  ///< of the file
  FileNames names = {};                  ///< in the folder; all if empty
  FileNames names_below = {};            ///< in its subfolders; none if empty
  std::vector<FileId> around = {};       ///< the folder and those around it, as far as they exist
};

class OverwriteCheck {
 public:
  /// @param what  the role of the file, for messages: "the scene file".
  void reads(const std::string& what, const std::filesystem::path& file);
  /// Reads the files of a folder that have these names; without names all, so that nothing may be
  /// written into the folder.
  void reads_folder(const std::string& what, const std::filesystem::path& folder,
                    FileNames names = {});
  /// Reads a folder with its subfolders. Nothing may be written into the folder itself, and no file
  /// of these names into a subfolder.
  /// @param files  all that are read, including those behind links
  void reads_tree(const std::string& what, const std::filesystem::path& folder,
                  const std::vector<std::filesystem::path>& files, FileNames names);

  void writes(const std::string& what, const std::filesystem::path& file);
  /// Writes files of a folder, with some of these names.
  /// @param name   of all of them, for messages: "frames/%06d.png".
  /// @param below  files in subfolders that are replaced or removed
  void writes_some_of(const std::string& what, const std::string& name,
                      const std::filesystem::path& folder, FileNames names,
                      const std::vector<std::filesystem::path>& below = {});
  /// Writes to standard output, which may have been redirected to a file.
  void writes_standard_output();

  /// @throws UsageError that lists all outputs which would replace an input or another output.
  void check() const;

 private:
  std::vector<FileClaim> inputs_;
  std::vector<FileClaim> outputs_;
};

}  // namespace piblocks
