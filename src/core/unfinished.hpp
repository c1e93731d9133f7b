// Files and folders that have no final name yet. In: the final name. Out: a locked temporary file
// or folder beside it, removed unless it is renamed or left for another process.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "core/descriptor.hpp"

namespace piblocks {

/// A file or folder under a temporary name, NAME.unfinished-CODE beside the final one. The
/// destructor removes it unless it has been renamed or released.
///
/// CODE is ten random letters or digits and six that are computed from NAME and these ten, so no
/// other program makes such a name. The file or folder is locked (flock) as long as it is written.
/// A killed process leaves it without a lock, and the next run for the same NAME by the same user
/// removes it, or does what its judge says. On file systems without locks it stays.
class Unfinished {
 public:
  enum class Kind { file, folder };
  /// Whether several processes may write for the same name at the same time.
  enum class Sharing { shared, exclusive };
  /// What becomes of a folder that a killed process left.
  enum class Fate { removed, left, adopted };
  using Judge = std::function<Fate(const std::filesystem::path& folder)>;

  /// @param judge  decides about such folders, which are removed without it. It may save files. The
  ///               first folder to be adopted is used instead of a new one.
  /// @throws UsageError if it cannot be made, or another process is writing for an exclusive name;
  ///         IoError if the disk is full or broken; what judge throws.
  Unfinished(const std::filesystem::path& final_path, Kind kind, Sharing sharing = Sharing::shared,
             const Judge& judge = {});
  ~Unfinished();
  Unfinished(const Unfinished&) = delete;
  Unfinished& operator=(const Unfinished&) = delete;

  std::filesystem::path path() const { return path_; }
  /// Open as long as the object lives.
  int descriptor() const noexcept { return lock_.get(); }
  /// Leaves path() alone: nothing is there any more, or it is for a later process.
  void release() noexcept { path_.clear(); }

 private:
  bool take_abandoned(const std::filesystem::path& final_path, const Judge& judge);
  void make(const std::filesystem::path& final_path, Kind kind);
  void remove() noexcept;

  std::string path_;
  Descriptor lock_;
};

/// Holds the lock (flock) of an existing folder while the object lives. On a file system without
/// locks nobody waits.
class FolderLock {
 public:
  /// Waits until no other process has it. @throws Interrupted
  explicit FolderLock(const std::filesystem::path& folder);

 private:
  Descriptor lock_;
};

/// Syncs a folder to its device, so that not even a power failure undoes what was renamed in it.
/// @throws IoError
void sync_folder(const std::filesystem::path& folder);

}  // namespace piblocks
