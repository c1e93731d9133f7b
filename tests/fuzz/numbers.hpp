// Numbers from the bytes of an input.
// In: the bytes. Out: numbers of the ranges that are asked for; the least ones after the end.
#pragma once

#include <cstdint>
#include <span>

namespace piblocks::fuzz {

class Numbers {
 public:
  explicit Numbers(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  bool has_more() const { return !bytes_.empty(); }
  int integer(int first, int last) {
    if (bytes_.empty()) return first;
    const int byte = bytes_.front();
    bytes_ = bytes_.subspan(1);
    return first + byte % (last - first + 1);
  }

 private:
  std::span<const std::uint8_t> bytes_;
};

}  // namespace piblocks::fuzz
