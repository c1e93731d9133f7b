#include "core/unfinished.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <climits>
#include <cstdint>
#include <new>
#include <random>
#include <string>
#include <string_view>
#include <system_error>

#include "core/output_file.hpp"

namespace piblocks {
namespace fs = std::filesystem;
namespace {

using Kind = Unfinished::Kind;

/// Parts have other names: "NAME.part-2-of-3".
constexpr std::string_view kMark = ".unfinished-";
constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyz234567";  // 5 bits each
constexpr std::size_t kRandom_letters = 10;
constexpr std::size_t kCheck_letters = 6;

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : ".";
}

[[noreturn]] void fail(const fs::path& final_path, Kind kind, int error_number) {
  const bool is_file = kind == Kind::file;
  const std::string message = fmt::format(
      "output: cannot {} '{}': {}", is_file ? "open" : "write into",
      (is_file ? final_path : folder_of(final_path)).string(), error_text(error_number));
  if (error_number == EIO || error_number == ENOSPC || error_number == EDQUOT) {
    throw IoError(message);
  }
  throw UsageError(message);
}

/// FNV-1a.
std::uint64_t hash_of(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  return hash;
}

std::string letters_of(std::uint64_t bits, std::size_t count) {
  std::string letters;
  for (; letters.size() < count; bits >>= 5) letters += kLetters[bits % kLetters.size()];
  return letters;
}

/// The beginning of the temporary name: as much of the final name as leaves room for the rest.
std::string_view start_of(const std::string& final_name) {
  constexpr std::size_t kRest = kMark.size() + kRandom_letters + kCheck_letters;
  return std::string_view(final_name).substr(0, NAME_MAX - kRest);
}

std::uint64_t random_bits() {
  try {
    std::random_device device;
    const std::uint64_t high = device();
    return high << 32 | device();
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw IoError(fmt::format("output: no random numbers: {}", error.what()));
  }
}

/// The part of the temporary name behind the random letters.
std::string check_letters(const std::string& final_name, std::string_view random) {
  const std::uint64_t hash = hash_of(final_name + '/' + std::string(random));
  return letters_of(hash ^ (hash >> 32), kCheck_letters);
}

std::string temporary_name(const std::string& final_name) {
  const std::string random = letters_of(random_bits(), kRandom_letters);
  return fmt::format("{}{}{}{}", start_of(final_name), kMark, random,
                     check_letters(final_name, random));
}

bool is_temporary_name(std::string_view name, const std::string& final_name) {
  const std::string start = std::string(start_of(final_name)) + std::string(kMark);
  if (!name.starts_with(start) || name.size() < start.size() + kRandom_letters) return false;
  name.remove_prefix(start.size());
  return name.substr(kRandom_letters) == check_letters(final_name, name.substr(0, kRandom_letters));
}

bool take_lock(int descriptor) { return ::flock(descriptor, LOCK_EX | LOCK_NB) == 0; }

Descriptor open(const fs::path& path, Kind kind) {
  const int access = kind == Kind::folder ? O_RDONLY | O_DIRECTORY : O_RDWR;
  return Descriptor(::open(path.c_str(), access | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
}

/// A regular file or a folder of this user.
bool is_own(int descriptor) {
  struct stat status {};
  if (::fstat(descriptor, &status) != 0) return false;
  return status.st_uid == ::geteuid() && (S_ISREG(status.st_mode) || S_ISDIR(status.st_mode));
}

/// @return a closed descriptor, with errno set, if that fails: EEXIST if another name may work.
Descriptor make_empty(const std::string& path, Kind kind) {
  if (kind == Kind::file) {
    return Descriptor(::open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
  }
  if (::mkdir(path.c_str(), 0700) != 0) return {};
  Descriptor folder = open(path, kind);
  if (folder.is_open()) return folder;
  // Another process may have taken it for abandoned already, and removed it.
  const int error = errno == ENOENT ? EEXIST : errno;
  ::rmdir(path.c_str());
  errno = error;
  return {};
}

}  // namespace

Unfinished::Unfinished(const fs::path& final_path, Kind kind, Sharing sharing, const Judge& judge) {
  take_abandoned(final_path, judge);
  const bool is_adopted = !path_.empty();
  if (!is_adopted) make(final_path, kind);
  if (sharing == Sharing::shared) return;
  // Two processes that start together see each other here, and neither goes on.
  if (!take_abandoned(final_path, [](const fs::path&) { return Fate::left; })) return;
  is_adopted ? release() : remove();
  throw UsageError(fmt::format(
      "output: cannot write '{}': another run is writing it; wait for that, or use another name",
      final_path.string()));
}

/// Removes or adopts what killed processes left for this name.
/// @return whether another process is writing for the same name.
bool Unfinished::take_abandoned(const fs::path& final_path, const Judge& judge) {
  const std::string final_name = final_path.filename();
  bool is_shared = false;
  std::error_code unreadable;
  for (const fs::path& path : entries_of(folder_of(final_path), unreadable)) {
    if (path == path_ || !is_temporary_name(path.filename().string(), final_name)) continue;
    Descriptor descriptor = open(path, Kind::folder);
    const bool is_folder = descriptor.is_open();
    if (!is_folder) descriptor = open(path, Kind::file);
    if (!descriptor.is_open() || !is_own(descriptor.get())) continue;
    if (!take_lock(descriptor.get())) {
      is_shared |= errno == EWOULDBLOCK;
      continue;
    }
    const Fate fate = is_folder && judge ? judge(path) : Fate::removed;
    if (fate == Fate::left) continue;
    if (fate == Fate::adopted && path_.empty()) {
      path_ = path;
      lock_ = std::move(descriptor);
      continue;
    }
    std::error_code ignored;  // the output does not depend on it
    fs::remove_all(path, ignored);
  }
  return is_shared;
}

void Unfinished::make(const fs::path& final_path, Kind kind) {
  do {
    path_ = final_path.parent_path() / temporary_name(final_path.filename());
    lock_ = make_empty(path_, kind);
    if (!lock_.is_open() && errno != EEXIST) fail(final_path, kind, errno);
    // Until it was locked, another process could take it for abandoned and remove it.
  } while (!lock_.is_open() || (!take_lock(lock_.get()) && errno == EWOULDBLOCK) ||
           ::access(path_.c_str(), F_OK) != 0);
}

Unfinished::~Unfinished() { remove(); }

/// Unlinking must not allocate: there may be no memory left.
void Unfinished::remove() noexcept {
  if (path_.empty() || ::unlink(path_.c_str()) == 0) return;
  try {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  } catch (const std::bad_alloc&) {  // the next run removes it
    return;
  }
}

FolderLock::FolderLock(const fs::path& folder)
    : lock_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  if (lock_.is_open() && ::flock(lock_.get(), LOCK_EX) != 0 && errno == EINTR) {
    throw Interrupted();
  }
}

void sync_folder(const fs::path& folder) {
  const fs::path path = folder.empty() ? "." : folder;
  const Descriptor descriptor(::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  // A folder may be writable but not readable; some file systems cannot sync folders.
  if (!descriptor.is_open() && errno == EACCES) return;
  const int error = descriptor.is_open() ? sync_file(descriptor.get()) : errno;
  if (error != 0 && !(descriptor.is_open() && error == EINVAL)) {
    fail_output("sync folder", path, error);
  }
}

}  // namespace piblocks
