#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "core/descriptor.hpp"

namespace piblocks {
namespace {

#ifdef O_SEARCH
// Needs no right to read the folder.
constexpr int kRename = O_SEARCH;
#else
constexpr int kRename = O_RDONLY;
#endif

}  // namespace

int sync_file(int descriptor) noexcept {
#ifdef F_FULLFSYNC
  // On macOS, fsync() leaves the bytes in the drive's memory. Some file systems have nothing
  // better.
  if (::fcntl(descriptor, F_FULLFSYNC) == 0) return 0;
#endif
  return ::fsync(descriptor) == 0 ? 0 : errno;
}

int sync_files(const std::filesystem::path& folder, int /*descriptor*/) {
  std::error_code unreadable;
  for (const std::filesystem::path& path : entries_of(folder, unreadable)) {
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    if (!file.is_open()) return errno;
    if (const int error = sync_file(file.get())) return error;
  }
  return unreadable.value();
}

Descriptor open_to_rename_in(const std::filesystem::path& folder) noexcept {
  return Descriptor(::open(folder.c_str(), kRename | O_DIRECTORY | O_CLOEXEC));
}

}  // namespace piblocks
