#include "core/overwrite_check.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <iterator>
#include <system_error>

#include "core/output_file.hpp"

namespace piblocks {
namespace fs = std::filesystem;
namespace {

/// A path whose links cannot be followed stays as it is: opening it reports the error.
fs::path target_of(const fs::path& path) {
  try {
    return follow_links(path);
  } catch (const UsageError&) {
    return path;
  }
}

std::string quoted(const std::string& what, const std::string& path) {
  return path.empty() ? what : fmt::format("{} '{}'", what, path);
}

std::optional<FileId> id_of(const fs::path& path, mode_t type) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0 || (status.st_mode & S_IFMT) != type) return std::nullopt;
  return FileId(status.st_dev, status.st_ino);
}

std::optional<FilePlace> place_of(const fs::path& folder) {
  fs::path rest;
  for (fs::path at = folder;; at = at.parent_path()) {
    if (const auto id = id_of(at.empty() ? "." : at, S_IFDIR)) {
      return FilePlace(*id, rest.lexically_normal());
    }
    if (at.empty() || at == at.parent_path()) return std::nullopt;
    if (at.has_filename()) rest = rest.empty() ? at.filename() : at.filename() / rest;
  }
}

/// This folder and those around it up to the root, as far as they exist.
std::vector<FileId> folders_around(const fs::path& folder) {
  std::vector<FileId> ids;
  std::error_code unknown;
  fs::path at = fs::weakly_canonical(fs::absolute(folder, unknown), unknown);
  while (!at.empty()) {
    if (const auto id = id_of(at, S_IFDIR)) ids.push_back(*id);
    if (at == at.parent_path()) break;
    at = at.parent_path();
  }
  return ids;
}

void add_files(FileClaim& claim, const std::vector<fs::path>& files) {
  for (const fs::path& file : files) {
    if (const auto id = id_of(file, S_IFREG)) claim.files.push_back(*id);
  }
  std::ranges::sort(claim.files);
}

FileClaim file_claim(const std::string& what, const fs::path& file) {
  FileClaim claim{what, file.string()};
  add_files(claim, {file});
  const fs::path target = target_of(file);
  claim.folder = place_of(target.parent_path());
  claim.around = folders_around(target.parent_path());
  claim.name = target.filename();
  return claim;
}

FileClaim folder_claim(const std::string& what, const fs::path& folder, FileNames names) {
  const fs::path path = folder.empty() ? "." : folder;
  FileClaim claim{what, path.string()};
  claim.folder = place_of(path);
  claim.around = folders_around(path);
  std::error_code error;
  std::vector<fs::path> files = entries_of(path, error);
  std::erase_if(files, [&](const fs::path& file) { return names && !names(file.filename()); });
  add_files(claim, files);
  claim.names = std::move(names);
  return claim;
}

/// Whether an output is in a folder that is read with its subfolders, or below it.
bool is_below(const FileClaim& output, const FileClaim& input) {
  const bool is_inside =
      input.names_below && input.folder && input.folder->second.empty() &&
      std::ranges::find(output.around, input.folder->first) != output.around.end();
  return is_inside && (!output.name || input.names_below(*output.name));
}

bool meet(const FileClaim& one, const FileClaim& other) {
  std::vector<FileId> both;
  std::ranges::set_intersection(one.files, other.files, std::back_inserter(both));
  if (!both.empty()) return true;
  if (!one.folder || one.folder != other.folder) return false;
  if (one.name && other.name) return one.name == other.name;
  if (one.name) return !other.names || other.names(*one.name);
  if (other.name) return !one.names || one.names(*other.name);
  return !one.names || !other.names;
}

}  // namespace

void OverwriteCheck::reads(const std::string& what, const fs::path& file) {
  inputs_.push_back(file_claim(what, file));
}

void OverwriteCheck::reads_folder(const std::string& what, const fs::path& folder,
                                  FileNames names) {
  inputs_.push_back(folder_claim(what, folder, std::move(names)));
}

void OverwriteCheck::reads_tree(const std::string& what, const fs::path& folder,
                                const std::vector<fs::path>& files, FileNames names) {
  reads_folder(what, folder);
  add_files(inputs_.back(), files);
  inputs_.back().names_below = std::move(names);
}

void OverwriteCheck::writes(const std::string& what, const fs::path& file) {
  outputs_.push_back(file_claim(what, file));
}

void OverwriteCheck::writes_some_of(const std::string& what, const std::string& name,
                                    const fs::path& folder, FileNames names,
                                    const std::vector<fs::path>& below) {
  outputs_.push_back(folder_claim(what, folder, std::move(names)));
  outputs_.back().path = name;
  add_files(outputs_.back(), below);
}

void OverwriteCheck::writes_standard_output() {
  struct stat status {};
  if (::fstat(STDOUT_FILENO, &status) != 0 || !S_ISREG(status.st_mode)) return;
  outputs_.push_back({"standard output", "", {FileId(status.st_dev, status.st_ino)}});
}

void OverwriteCheck::check() const {
  std::vector<std::string> problems;
  for (auto output = outputs_.begin(); output != outputs_.end(); ++output) {
    for (const FileClaim& input : inputs_) {
      if (!meet(*output, input) && !is_below(*output, input)) continue;
      problems.push_back(fmt::format("{}: would write {} {}; choose another name",
                                     quoted(output->what, output->path),
                                     input.name ? "over" : "into", quoted(input.what, input.path)));
    }
    for (auto other = outputs_.begin(); other != output; ++other) {
      if (!meet(*output, *other)) continue;
      problems.push_back(fmt::format("{}: would write over {}; choose another name",
                                     quoted(output->what, output->path),
                                     quoted(other->what, other->path)));
    }
  }
  if (!problems.empty()) throw UsageError(std::move(problems));
}

}  // namespace piblocks
