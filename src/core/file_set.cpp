#include "core/file_set.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

#include "core/input_file.hpp"

namespace piblocks {
namespace fs = std::filesystem;
namespace {

/// In the temporary folder: the new files, and the old ones that they replace. The folder of the
/// old ones is made before the first file moves.
constexpr const char* kNew = "new";
constexpr const char* kOld = "old";
constexpr const char* kJob = "job";

void make_folder(const fs::path& path) {
  if (::mkdir(path.c_str(), 0777) != 0) fail_output("make", path, errno);
}

/// @param final_path  for messages
void write_whole(const fs::path& path, std::span<const std::uint8_t> bytes,
                 const fs::path& final_path) {
  Descriptor file(::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
  if (!file.is_open()) fail_output("make", final_path, errno);
  if (const int error = file.write(bytes)) fail_output("write", final_path, error);
  if (const int error = file.close()) fail_output("close", final_path, error);
}

/// Moves files to their names, and old files out of the way, so that they can be moved back. Once
/// it has begun it needs no new memory.
class Renaming {
 public:
  Renaming(const fs::path& from, const fs::path& to, const fs::path& old)
      : from_(open_folder(from)), to_(open_folder(to)), old_(open_folder(old)) {}

  /// @return 0, or an errno, and the name is as it was.
  int place(const char* name) const noexcept {
    if (const int error = put_away(name)) return error;
    if (move(from_, to_, name) == 0) return 0;
    const int error = errno;
    put_back(name);
    return error;
  }
  void take_back(const char* name) const noexcept {
    move(to_, from_, name);
    put_back(name);
  }
  /// @return 0, or an errno, and the name is as it was.
  int put_away(const char* name) const noexcept {
    return move(to_, old_, name) != 0 && errno != ENOENT ? errno : 0;
  }
  void put_back(const char* name) const noexcept { move(old_, to_, name); }

 private:
  static Descriptor open_folder(const fs::path& path) {
    Descriptor folder = open_to_rename_in(path);
    if (!folder.is_open()) fail_output("open", path, errno);
    return folder;
  }
  static int move(const Descriptor& from, const Descriptor& to, const char* name) noexcept {
    return ::renameat(from.get(), name, to.get(), name);
  }

  Descriptor from_;
  Descriptor to_;
  Descriptor old_;
};

}  // namespace

FileSet::FileSet(const fs::path& folder, const std::string& label, Unfinished::Sharing sharing,
                 Resumption resumption)
    : folder_(folder.empty() ? "." : folder),
      label_(label),
      resumption_(std::move(resumption)),
      made_folders_(folder_),
      temporary_(folder_ / label, Unfinished::Kind::folder, sharing,
                 [this](const fs::path& left) { return fate_of(left); }) {
  std::error_code error;
  has_files_ = fs::exists(temporary_.path() / kNew, error);
  if (has_files_) return;
  make_folder(temporary_.path() / kNew);
  const auto* const job = reinterpret_cast<const std::uint8_t*>(resumption_.job.data());
  if (!resumption_.job.empty()) {
    write_whole(temporary_.path() / kJob, {job, resumption_.job.size()}, folder_ / label);
  }
}

FileSet::~FileSet() {
  if (resumption_.is_wanted && has_files_) temporary_.release();
}

Unfinished::Fate FileSet::fate_of(const fs::path& folder) const {
  std::error_code error;
  const bool has_moved_files = fs::exists(folder / kOld, error);
  if (error) return Unfinished::Fate::left;
  if (has_moved_files) {
    return finish_commit(folder) ? Unfinished::Fate::removed : Unfinished::Fate::left;
  }
  const bool has_files = !entries_of(folder / kNew, error).empty();
  if (!resumption_.is_wanted || !has_files) return Unfinished::Fate::removed;
  check_job(folder);
  return Unfinished::Fate::adopted;
}

bool FileSet::finish_commit(const fs::path& folder) const {
  std::error_code error;
  if (!fs::exists(folder / kNew, error)) return !error;  // everything has moved
  for (const fs::path& path : entries_of(folder / kNew, error)) {
    fs::rename(path, folder_ / path.filename(), error);
    if (error) return false;
  }
  return !error;
}

void FileSet::check_job(const fs::path& folder) const {
  const std::string& wanted = resumption_.job;
  constexpr std::size_t kMost_bytes = std::size_t{64} << 20;
  const std::vector<std::uint8_t> bytes = bytes_of_file(folder / kJob, kMost_bytes);
  const std::string left(bytes.begin(), bytes.end());
  if (left == wanted) return;
  const auto at = std::size_t(std::ranges::mismatch(wanted, left).in1 - wanted.begin());
  const std::size_t begin = at == 0 ? 0 : wanted.rfind('\n', at - 1) + 1;
  throw UsageError(fmt::format(
      "output: the unfinished files of '{}' are of another run: they differ in {}; give the same "
      "command, or leave --resume out to begin anew",
      (folder_ / label_).string(), wanted.substr(begin, wanted.find(": ", begin) - begin)));
}

fs::path FileSet::add(const std::string& name) {
  check_destination(name);
  names_.push_back(name);
  return temporary_.path() / kNew / name;
}

void FileSet::add(const std::string& name, std::span<const std::uint8_t> bytes) {
  const fs::path path = add(name);
  has_files_ = true;
  write_whole(path, bytes, folder_ / name);
}

void FileSet::drop(const std::string& name) {
  std::erase(names_, name);
  std::error_code ignored;  // it goes with the temporary folder
  fs::remove(temporary_.path() / kNew / name, ignored);
}

void FileSet::remove(const std::string& name) {
  check_destination(name);
  removed_.push_back(name);
}

void FileSet::commit() {
  if (!names_.empty() || !removed_.empty()) {
    prepare();
    if (const int error = sync_files(temporary_.path() / kNew, temporary_.descriptor())) {
      fail_output("sync", temporary_.path(), error);
    }
    move_into_place();
  }
  made_folders_.keep();
  std::error_code error;
  fs::remove_all(temporary_.path(), error);
  if (error) fail_output("remove", temporary_.path(), error.value());
  temporary_.release();
  sync_folder(folder_);
}

void FileSet::check_destination(const std::string& name) const {
  const fs::path to = folder_ / name;
  std::error_code none;
  if (fs::is_symlink(to, none)) {
    fail_output("replace", to, "a symbolic link; remove it or choose another name");
  }
  const std::string problem = problem_of_replacing(to);
  if (!problem.empty()) fail_output("replace", to, problem);
}

/// Finds what would make renaming fail, before the first file is renamed.
void FileSet::prepare() const {
  for (const std::string& name : names_) {
    check_destination(name);
    const fs::path to = folder_ / name;
    std::error_code none;
    if (!fs::exists(to, none)) continue;
    const fs::path from = temporary_.path() / kNew / name;
    const Descriptor file(::open(from.c_str(), O_RDONLY | O_CLOEXEC));
    if (!file.is_open()) fail_output("open", from, errno);
    take_permissions(file.get(), to);
  }
}

void FileSet::move_into_place() const {
  const fs::path old = temporary_.path() / kOld;
  make_folder(old);
  const Renaming renaming(temporary_.path() / kNew, folder_, old);
  std::size_t placed = 0;
  std::size_t removed = 0;
  int error = 0;
  while (error == 0 && placed < names_.size()) {
    error = renaming.place(names_[placed].c_str());
    if (error == 0) ++placed;
  }
  while (error == 0 && removed < removed_.size()) {
    error = renaming.put_away(removed_[removed].c_str());
    if (error == 0) ++removed;
  }
  if (error == 0) return;
  for (std::size_t i = 0; i < placed; ++i) renaming.take_back(names_[i].c_str());
  for (std::size_t i = 0; i < removed; ++i) renaming.put_back(removed_[i].c_str());
  ::rmdir(old.c_str());  // else the next run would take the set for one that is half in place
  if (placed < names_.size()) fail_output("rename to", folder_ / names_[placed], error);
  fail_output("remove", folder_ / removed_[removed], error);
}

}  // namespace piblocks
