// An open file of the operating system.
// In: a descriptor. Out: an owner that closes it, also when an exception passes.
#pragma once

#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <span>
#include <utility>

namespace piblocks {

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
  /// What was open is closed in any case. @return 0, or an errno: a file of a network may say only
  /// now that it has no room.
  int close() noexcept { return is_open() && ::close(std::exchange(number_, -1)) != 0 ? errno : 0; }

 private:
  int number_ = -1;
};

}  // namespace piblocks
