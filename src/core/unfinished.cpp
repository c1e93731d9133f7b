#include "core/unfinished.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <new>
#include <string>
#include <string_view>
#include <system_error>

namespace piblocks {
namespace fs = std::filesystem;
namespace {

using Kind = Unfinished::Kind;

/// Never that of a part, "NAME.part-2-of-3".
constexpr std::string_view kMark = ".unfinished-";
constexpr std::string_view kRandom = "XXXXXX";

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : ".";
}

std::string reason(int error_number) { return std::generic_category().message(error_number); }

[[noreturn]] void fail(const fs::path& final_path, Kind kind, int error_number) {
  if (kind == Kind::folder) {
    throw UsageError(fmt::format("output: cannot write into '{}': {}",
                                 folder_of(final_path).string(), reason(error_number)));
  }
  throw UsageError(
      fmt::format("output: cannot open '{}': {}", final_path.string(), reason(error_number)));
}

bool take_lock(int descriptor) { return ::flock(descriptor, LOCK_EX | LOCK_NB) == 0; }

Descriptor open(const char* path, Kind kind) {
  const int access = kind == Kind::folder ? O_RDONLY | O_DIRECTORY : O_RDWR;
  return Descriptor(::open(path, access | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
}

void remove_if_abandoned(const fs::path& path) {
  Descriptor descriptor = open(path.c_str(), Kind::file);
  if (!descriptor.is_open()) descriptor = open(path.c_str(), Kind::folder);
  if (!descriptor.is_open() || !take_lock(descriptor.get())) return;
  std::error_code stays;  // the work does not depend on it
  fs::remove_all(path, stays);
}

void remove_abandoned(const fs::path& final_path) {
  const std::string start = final_path.filename().string() + std::string(kMark);
  std::error_code unreadable;
  fs::directory_iterator entry(folder_of(final_path), unreadable);
  for (; !unreadable && entry != fs::directory_iterator(); entry.increment(unreadable)) {
    const std::string name = entry->path().filename();
    const bool is_ours = name.starts_with(start) && name.size() == start.size() + kRandom.size();
    if (is_ours) remove_if_abandoned(entry->path());
  }
}

/// The permissions that a plain open() for writing would give.
mode_t default_permissions() {
  const mode_t mask = ::umask(0);
  ::umask(mask);
  return 0666 & ~mask;
}

/// Replaces the X at the end of `name`.
Descriptor make(std::string& name, Kind kind) {
  if (kind == Kind::folder) {
    if (::mkdtemp(name.data()) == nullptr) return {};
    Descriptor folder = open(name.c_str(), kind);
    if (!folder.is_open()) ::rmdir(name.c_str());
    return folder;
  }
  static const mode_t permissions = default_permissions();
  Descriptor file(::mkostemp(name.data(), O_CLOEXEC));
  if (file.is_open()) ::fchmod(file.get(), permissions);
  return file;
}

}  // namespace

Unfinished::Unfinished(const fs::path& final_path, Kind kind) {
  remove_abandoned(final_path);
  do {
    std::string name = final_path.string();
    name.append(kMark).append(kRandom);
    lock_ = make(name, kind);
    if (!lock_.is_open()) fail(final_path, kind, errno);
    path_ = std::move(name);
    // Before it was locked, another process could take it for abandoned.
  } while ((!take_lock(lock_.get()) && errno == EWOULDBLOCK) || ::access(path_.c_str(), F_OK) != 0);
}

/// A file goes without new memory, of which there may be none left.
Unfinished::~Unfinished() {
  if (path_.empty() || ::unlink(path_.c_str()) == 0) return;
  try {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  } catch (const std::bad_alloc&) {  // stays for the next owner
    return;
  }
}

void sync_folder(const fs::path& folder) {
  const fs::path path = folder.empty() ? "." : folder;
  const Descriptor descriptor(::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  // One may write into a folder without being allowed to read it; some file systems sync none.
  if (!descriptor.is_open() && errno == EACCES) return;
  if (descriptor.is_open() && (::fsync(descriptor.get()) == 0 || errno == EINVAL)) return;
  throw IoError(fmt::format("output: cannot sync folder '{}': {}", path.string(), reason(errno)));
}

}  // namespace piblocks
