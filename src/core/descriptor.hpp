// Open files of the operating system, its folders and its errors; how files get onto the disk.
// In: a descriptor, a folder or an errno. Out: an owner that closes the descriptor; what the folder
// holds; the text of the error.
#pragma once

#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace piblocks {

inline std::string error_text(int error_number) {
  return std::generic_category().message(error_number);
}

/// The paths of what a folder holds, in any order. Without memory this throws;
/// directory_iterator::increment(error_code) would end the process.
/// @param error  set if the folder cannot be read.
inline std::vector<std::filesystem::path> entries_of(const std::filesystem::path& folder,
                                                     std::error_code& error) {
  std::vector<std::filesystem::path> entries;
  error.clear();
  try {
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      entries.push_back(entry.path());
    }
  } catch (const std::filesystem::filesystem_error& failure) {
    error = failure.code();
  }
  return entries;
}

class Descriptor {
 public:
  Descriptor() = default;
  explicit Descriptor(int number) noexcept : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() { close(); }

  bool is_open() const noexcept { return number_ >= 0; }
  int get() const noexcept { return number_; }

  /// Writes all bytes. @return 0, or an errno.
  int write(std::span<const std::uint8_t> bytes) const noexcept {
    while (!bytes.empty()) {
      const ssize_t written = ::write(number_, bytes.data(), bytes.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) return errno;
      bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
    return 0;
  }
  /// Closes it in any case. @return 0, or an errno: a network file may report a full disk only now.
  int close() noexcept { return is_open() && ::close(std::exchange(number_, -1)) != 0 ? errno : 0; }

 private:
  int number_ = -1;
};

// What systems do differently to make files survive a power failure: durability_linux.cpp has the
// calls of Linux, durability_posix.cpp those of POSIX; the build takes one of them.

/// Syncs a file or a folder to its device. @return 0, or an errno.
int sync_file(int descriptor) noexcept;

/// Syncs all files of a folder. @param descriptor  any open file or folder of their file system.
/// @return 0, or an errno.
int sync_files(const std::filesystem::path& folder, int descriptor);

/// Opens a folder for renameat(). @return a closed one, with errno set, if it cannot be opened.
Descriptor open_to_rename_in(const std::filesystem::path& folder) noexcept;

}  // namespace piblocks
