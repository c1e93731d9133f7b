#include "core/file_set.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "core/descriptor.hpp"

namespace piblocks {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void fail(const char* operation, const fs::path& path, int error_number) {
  throw IoError(fmt::format("output: cannot {} '{}': {}", operation, path.string(),
                            std::generic_category().message(error_number)));
}

/// All files take their names, or none does. What else has a name waits among the old ones until
/// all are done. Needs no new memory once it has begun.
class Renaming {
 public:
  Renaming(const fs::path& from, const fs::path& to, const fs::path& old)
      : from_(open_folder(from)), to_(open_folder(to)), old_(open_folder(old)) {}

  /// @return 0, or an errno, and the name is as it was.
  int place(const char* name) const noexcept {
    if (move(to_, old_, name) != 0 && errno != ENOENT) return errno;
    if (move(from_, to_, name) == 0) return 0;
    const int error = errno;
    move(old_, to_, name);
    return error;
  }
  void take_back(const char* name) const noexcept {
    move(to_, from_, name);
    move(old_, to_, name);
  }

 private:
  /// For naming files in it only: that needs no right to read it.
  static Descriptor open_folder(const fs::path& path) {
    Descriptor folder(::open(path.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
    if (!folder.is_open()) fail("open", path, errno);
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

FileSet::FileSet(const fs::path& folder, const std::string& label)
    : folder_(folder.empty() ? "." : folder),
      made_folders_(folder_),
      temporary_(folder_ / label, Unfinished::Kind::folder) {}

fs::path FileSet::add(const std::string& name) {
  names_.push_back(name);
  return temporary_.path() / name;
}

void FileSet::commit() {
  sync();
  check_destinations();
  move_into_place();
  made_folders_.keep();
  std::error_code error;
  fs::remove_all(temporary_.path(), error);
  if (error) fail("remove", temporary_.path(), error.value());
  temporary_.release();
  sync_folder(folder_);
}

/// One call for the whole file system: a sync for each of thousands of files takes far longer.
void FileSet::sync() const {
  if (::syncfs(temporary_.descriptor()) != 0) fail("sync", temporary_.path(), errno);
}

/// Finds what renaming would fail on before the first file is renamed.
void FileSet::check_destinations() const {
  for (const std::string& name : names_) {
    const fs::path to = folder_ / name;
    std::error_code none;
    if (fs::is_directory(fs::symlink_status(to, none))) fail("replace", to, EISDIR);
  }
}

void FileSet::move_into_place() const {
  const fs::path old = temporary_.path() / "old";
  if (::mkdir(old.c_str(), 0777) != 0) fail("make", old, errno);
  const Renaming renaming(temporary_.path(), folder_, old);
  for (std::size_t i = 0; i < names_.size(); ++i) {
    const int error = renaming.place(names_[i].c_str());
    if (error == 0) continue;
    for (std::size_t j = 0; j < i; ++j) renaming.take_back(names_[j].c_str());
    fail("rename to", folder_ / names_[i], error);
  }
}

}  // namespace piblocks
