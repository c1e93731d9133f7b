// Files that appear under their names only when they are complete.
// In: bytes, in order. Out: the file, synced and renamed by finish(), or no trace of it.
#pragma once

#include <piblocks/error.hpp>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/descriptor.hpp"

namespace piblocks {

/// @throws IoError "output: cannot OPERATION 'NAME': REASON".
[[noreturn]] void fail_output(const char* operation, const std::string& name,
                              const std::string& reason);
[[noreturn]] void fail_output(const char* operation, const std::string& name, int error_number);

/// A file or folder under a temporary name, NAME.unfinished-CODE beside the final one. The
/// destructor removes it unless it has been renamed.
///
/// CODE is ten random letters or digits and six that are computed from NAME and these ten, so no
/// other program makes such a name. The file or folder is locked (flock) as long as it is written.
/// A killed process leaves it without a lock, and the next run for the same NAME by the same user
/// removes it. On file systems without locks it stays.
class Unfinished {
 public:
  enum class Kind { file, folder };
  /// Whether several processes may write for the same name at the same time.
  enum class Sharing { shared, exclusive };
  /// Saves complete files from a folder that a killed process left.
  /// @return whether the rest may be removed.
  using Rescue = std::function<bool(const std::filesystem::path& folder)>;

  /// @throws UsageError if it cannot be made, or another process is writing for an exclusive name;
  ///         IoError if the disk is full or broken.
  Unfinished(const std::filesystem::path& final_path, Kind kind, Sharing sharing = Sharing::shared,
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

/// Folders that had to be made for an output; removed again, if empty, unless kept.
class MadeFolders {
 public:
  MadeFolders() = default;
  /// Makes `folder` and its missing parents.
  /// @throws UsageError if one cannot be made.
  explicit MadeFolders(const std::filesystem::path& folder);
  ~MadeFolders();
  MadeFolders(const MadeFolders&) = delete;
  MadeFolders& operator=(const MadeFolders&) = delete;
  void keep() noexcept { made_.clear(); }

 private:
  std::vector<std::filesystem::path> made_;  // outermost first
};

/// Follows symbolic links, also to a file that does not exist yet.
/// @throws UsageError if they go in a circle, or the system does not let this user follow them.
std::filesystem::path follow_links(const std::filesystem::path& path);

/// Why a file may not be written under this name: a folder, a device, or a file that this user may
/// not write to; empty if it may.
std::string problem_of_replacing(const std::filesystem::path& path);

/// Gives an open file the permissions of the file that it will replace, if there is one, and its
/// owner, as far as this user may.
/// @throws IoError if it cannot have the permissions.
void take_permissions(int descriptor, const std::filesystem::path& replaced);

/// A file that is written under a temporary name beside `final_path`. Destroying it before commit()
/// removes the file. It replaces what a symbolic link points to, and has the permissions of the
/// file that it replaces.
class TemporaryFile {
 public:
  /// Makes an empty file that only this process knows; makes missing folders.
  /// @throws UsageError if final_path is a folder, a device or a file that this user may not write
  ///         to, or a file cannot be made there; IoError if the disk is full.
  explicit TemporaryFile(std::filesystem::path final_path);

  std::filesystem::path path() const { return file_->path(); }
  /// Syncs the file to its device and renames it to its final name. @throws IoError
  void commit();

 private:
  std::filesystem::path final_path_;
  std::optional<MadeFolders> folders_;
  std::optional<Unfinished> file_;
};

/// The reader of standard output has closed it, as `head` does once it has read enough.
struct ReaderGone : Error {
  using Error::Error;
};

/// Bytes to a file (through a TemporaryFile) or, for the name "-", to standard output.
class OutputFile {
 public:
  /// A reader may take the beginning of a text and go; the beginning of other bytes is of no use.
  enum class Contents { bytes, text };

  explicit OutputFile(const std::string& name, Contents contents = Contents::bytes);

  /// @throws IoError on a full disk, a closed pipe and the like; ReaderGone if text is written to a
  ///         closed pipe.
  void write(std::span<const std::uint8_t> bytes);
  void write(std::string_view text);
  /// Writes to another place, from this position of the file on; write() goes on where it was. Not
  /// on standard output. @throws IoError
  void write_at(std::uint64_t position, std::span<const std::uint8_t> bytes);
  /// Closes, syncs and renames. @throws IoError
  void finish();

 private:
  std::string name_;
  Contents contents_;
  std::unique_ptr<TemporaryFile> temporary_;  // none for standard output
  Descriptor descriptor_;
};

/// Files of one folder that take their names together, replacing older ones, or none of them does.
class FileSet {
 public:
  /// Makes missing folders. If a process was killed while the files of such a set took their names,
  /// the others of these files take theirs now: they are complete.
  /// @param label    tells which files belong together: as Unfinished's name.
  /// @param sharing  whether another set with this label may be written at the same time.
  /// @throws UsageError, IoError as Unfinished.
  FileSet(const std::filesystem::path& folder, const std::string& label,
          Unfinished::Sharing sharing = Unfinished::Sharing::exclusive);

  /// A folder for intermediate files; removed with everything in it.
  std::filesystem::path temporary_folder() const { return temporary_.path(); }
  /// One more file.
  /// @return where it is to be written.
  /// @throws IoError if no file can replace what has this name: a folder, a symbolic link, a file
  ///         without the right to write to it.
  std::filesystem::path add(const std::string& name);
  /// The same with its contents. @throws IoError also if it cannot be written.
  void add(const std::string& name, std::span<const std::uint8_t> bytes);
  /// Removes a file when the others take their names. @throws IoError as add().
  void remove(const std::string& name);
  /// Syncs all files and gives them their names.
  /// @throws IoError if that fails. Every name then has the file it had before, unless all names
  ///         had the new files already and only removing or syncing the rest failed.
  void commit();

 private:
  void check_destination(const std::string& name) const;
  void prepare() const;
  void move_into_place() const;
  /// Of a folder that a killed process left.
  bool finish_commit(const std::filesystem::path& folder) const;

  std::filesystem::path folder_;
  MadeFolders made_folders_;
  Unfinished temporary_;            // holds the files until they take their names
  std::vector<std::string> names_;  // of the files
  std::vector<std::string> removed_;
};

}  // namespace piblocks
