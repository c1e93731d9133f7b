// A file or folder under a temporary name, for what is not complete yet.
// In: the final name. Out: NAME.unfinished-XXXXXX beside it, on the same device; goes with its
// owner unless that has renamed it.
//
// The owner holds a lock (flock) on it. One that nobody holds is what a process left that was
// killed; whoever works on the same name next removes it. File systems without locks keep it.
#pragma once

#include <filesystem>
#include <string>

#include "core/descriptor.hpp"

namespace piblocks {

class Unfinished {
 public:
  enum class Kind { file, folder };

  /// @throws UsageError if it cannot be made.
  Unfinished(const std::filesystem::path& final_path, Kind kind);
  ~Unfinished();
  Unfinished(const Unfinished&) = delete;
  Unfinished& operator=(const Unfinished&) = delete;

  std::filesystem::path path() const { return path_; }
  /// Open as long as the object lives.
  int descriptor() const noexcept { return lock_.get(); }
  /// Nothing is left under path(): it has been renamed.
  void release() noexcept { path_.clear(); }

 private:
  std::string path_;
  Descriptor lock_;
};

/// Syncs a folder to its device, so that not even a power failure undoes what was renamed in it.
/// @throws IoError
void sync_folder(const std::filesystem::path& folder);

}  // namespace piblocks
