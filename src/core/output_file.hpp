// Files that appear under their names only when they are complete.
// In: bytes, in order. Out: the file, synced and renamed by finish(), or no trace of it.
#pragma once

#include <piblocks/error.hpp>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/descriptor.hpp"
#include "core/unfinished.hpp"

namespace piblocks {

/// @throws IoError "output: cannot OPERATION 'NAME': REASON".
[[noreturn]] void fail_output(const char* operation, const std::string& name,
                              const std::string& reason);
[[noreturn]] void fail_output(const char* operation, const std::string& name, int error_number);

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

/// Makes a file of these bytes. @throws as OutputFile
inline void write_file(const std::string& name, std::span<const std::uint8_t> bytes) {
  OutputFile file(name);
  file.write(bytes);
  file.finish();
}

}  // namespace piblocks
