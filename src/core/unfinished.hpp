// A file or folder under a temporary name, for what is not complete yet.
// In: the final name. Out: NAME.unfinished-CODE beside it, on the same device; goes with its owner
// unless that has renamed it.
//
// CODE is ten random letters or digits and six that are computed from NAME and these ten: no other
// program makes such a name, and a copy under another name does not have it. The owner holds a
// lock (flock) on the file or folder. A killed process leaves it without a lock, and the next owner
// for the same NAME removes it, if it belongs to the same user. File systems without locks keep it.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "core/descriptor.hpp"

namespace piblocks {

class Unfinished {
 public:
  enum class Kind { file, folder };
  enum class Rivals { allowed, refused };
  /// Saves what is worth it in a folder that a killed process left.
  /// @return whether the rest may be removed.
  using Rescue = std::function<bool(const std::filesystem::path& folder)>;

  /// @param rivals  whether other processes may work for the same name at the same time.
  /// @throws UsageError if it cannot be made, or a rival that is not allowed is at work; IoError if
  ///         the disk is full or broken.
  Unfinished(const std::filesystem::path& final_path, Kind kind, Rivals rivals = Rivals::allowed,
             const Rescue& rescue = {});
  ~Unfinished();
  Unfinished(const Unfinished&) = delete;
  Unfinished& operator=(const Unfinished&) = delete;

  std::filesystem::path path() const { return path_; }
  /// Open as long as the object lives.
  int descriptor() const noexcept { return lock_.get(); }
  /// Nothing is left under path(): it has been renamed.
  void release() noexcept { path_.clear(); }

 private:
  void make(const std::filesystem::path& final_path, Kind kind);
  void remove() noexcept;

  std::string path_;
  Descriptor lock_;
};

/// Syncs a folder to its device, so that not even a power failure undoes what was renamed in it.
/// @throws IoError
void sync_folder(const std::filesystem::path& folder);

}  // namespace piblocks
