// Files of one folder that take their names together.
// In: files by their names. Out: all of them, or the old ones.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/output_file.hpp"
#include "core/unfinished.hpp"

namespace piblocks {

/// How a set goes on where an earlier one has ended.
struct Resumption {
  std::string job = {};  ///< what the files depend on, in lines "NAME: VALUE"
  /// Whether to take over the files of a set for this job that a process has left, and to leave
  /// those of this one if it is not committed.
  bool is_wanted = false;
};

/// Files of one folder that take their names together, replacing older ones, or none of them does.
class FileSet {
 public:
  /// Makes missing folders. If a process was killed while the files of such a set took their names,
  /// the others of these files take theirs now: they are complete.
  /// @param label    tells which files belong together: as Unfinished's name.
  /// @param sharing  whether another set with this label may be written at the same time.
  /// @param resumption  a file that is taken over is where add() says.
  /// @throws UsageError, IoError as Unfinished; UsageError if files of another job would have to be
  ///         taken over.
  FileSet(const std::filesystem::path& folder, const std::string& label,
          Unfinished::Sharing sharing = Unfinished::Sharing::exclusive, Resumption resumption = {});
  ~FileSet();
  FileSet(const FileSet&) = delete;
  FileSet& operator=(const FileSet&) = delete;

  /// A folder for intermediate files; removed with everything in it.
  std::filesystem::path temporary_folder() const { return temporary_.path(); }
  /// One more file.
  /// @return where it is to be written.
  /// @throws IoError if no file can replace what has this name: a folder, a symbolic link, a file
  ///         without the right to write to it.
  std::filesystem::path add(const std::string& name);
  /// The same with its contents. @throws IoError also if it cannot be written.
  void add(const std::string& name, std::span<const std::uint8_t> bytes);
  /// Leaves out a file that has been added.
  void drop(const std::string& name);
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
  // Of a folder that a killed process left.
  Unfinished::Fate fate_of(const std::filesystem::path& folder) const;
  bool finish_commit(const std::filesystem::path& folder) const;
  void check_job(const std::filesystem::path& folder) const;

  std::filesystem::path folder_;
  std::string label_;
  Resumption resumption_;
  bool has_files_ = false;
  MadeFolders made_folders_;
  Unfinished temporary_;            // holds the files until they take their names
  std::vector<std::string> names_;  // of the files
  std::vector<std::string> removed_;
};

}  // namespace piblocks
