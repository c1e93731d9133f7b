// Files of one folder that take their names together, or none of them does.
// In: names, and the files, written under temporary paths. Out: all of them under their names, in
// place of what had these, or no trace of them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/output_file.hpp"
#include "core/unfinished.hpp"

namespace piblocks {

class FileSet {
 public:
  /// Makes missing folders.
  /// @param label  what the temporary folder is called until all is done: LABEL.unfinished-XXXXXX
  /// @throws UsageError if one cannot write there.
  FileSet(const std::filesystem::path& folder, const std::string& label);

  /// A folder for what only helps to make the files; it goes when they are done.
  std::filesystem::path workshop() const { return temporary_.path(); }
  /// One more file.
  /// @return where it is to be written.
  std::filesystem::path add(const std::string& name);
  /// Syncs all files and gives them their names.
  /// @throws IoError if that fails. Every name has then what it had before, unless all had their
  ///         files already, and only removing or syncing what remains failed.
  void commit();

 private:
  void sync() const;
  void check_destinations() const;
  void move_into_place() const;

  std::filesystem::path folder_;
  MadeFolders made_folders_;
  Unfinished temporary_;  // holds the files until they take their names
  std::vector<std::string> names_;
};

}  // namespace piblocks
