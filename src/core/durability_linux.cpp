#include <fcntl.h>
#include <unistd.h>

#include <cerrno>

#include "core/descriptor.hpp"

namespace piblocks {

int sync_file(int descriptor) noexcept { return ::fsync(descriptor) == 0 ? 0 : errno; }

/// One call for the whole file system: a sync of each of thousands of files takes far longer.
int sync_files(const std::filesystem::path& /*folder*/, int descriptor) {
  return ::syncfs(descriptor) == 0 ? 0 : errno;
}

/// O_PATH needs no right to read the folder.
Descriptor open_to_rename_in(const std::filesystem::path& folder) noexcept {
  return Descriptor(::open(folder.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
}

}  // namespace piblocks
