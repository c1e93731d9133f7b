#include "media/gif/lzw.hpp"

#include <piblocks/error.hpp>

#include <algorithm>
#include <vector>

namespace piblocks {
namespace {

constexpr int kMaxWidth_bits = 12;
using LzwCode = std::uint16_t;
constexpr LzwCode kLzwClear = 256;

/// Which string is another one and a value behind it: a hash table.
class Strings {
 public:
  void clear() {
    std::ranges::fill(slots_, Slot{});
    last_ = kLzwClear;
  }
  /// The code of the longer string; 0 if there is none.
  LzwCode find(LzwCode code, std::uint8_t value) { return slot(code, value).code; }
  /// @return whether there is room, beside pixels of 8 bits, for one more.
  bool add(LzwCode code, std::uint8_t value) {
    constexpr LzwCode kLast = (1 << kMaxWidth_bits) - 2;
    slot(code, value) = {key_of(code, value), ++last_};
    return last_ < kLast;
  }

 private:
  struct Slot {
    std::uint32_t key = 0;
    LzwCode code = 0;  // of no string: the slot is empty
  };

  static std::uint32_t key_of(LzwCode code, std::uint8_t value) {
    return std::uint32_t{code} << 8 | value;
  }
  Slot& slot(LzwCode code, std::uint8_t value) {
    constexpr std::uint32_t kFactor = 2654435761;  // 2^32 by the golden ratio
    const std::uint32_t key = key_of(code, value);
    std::size_t at = key * kFactor >> 19;
    while (slots_[at].code != 0 && slots_[at].key != key) at = (at + 1) % slots_.size();
    return slots_[at];
  }

  std::vector<Slot> slots_ = std::vector<Slot>(1 << 13);
  LzwCode last_ = kLzwClear;
};

}  // namespace

void append_lzw_codes(Bytes& bytes, ByteSpan pixels) {
  Strings strings;
  const auto put = [&](LzwCode code) { append_little_endian(bytes, code, 2); };
  put(kLzwClear);
  LzwCode open = pixels.front();  // the string of the pixels since the last code
  for (const std::uint8_t value : pixels.subspan(1)) {
    const LzwCode longer = strings.find(open, value);
    if (longer == 0) {
      put(open);
      if (!strings.add(open, value)) {
        put(kLzwClear);
        strings.clear();
      }
    }
    open = longer != 0 ? longer : value;
  }
  put(open);
}

void append_lzw(Bytes& bytes, ByteSpan codes, const Bytes& indices, int bits) {
  const std::uint32_t clear = 1U << bits;
  Bytes data;
  std::uint32_t held = 0;
  int held_bits = 0;
  int width_bits = bits + 1;
  const auto put = [&](std::uint32_t code) {
    held |= code << held_bits;
    held_bits += width_bits;
    for (; held_bits >= 8; held_bits -= 8, held >>= 8) data.push_back(std::uint8_t(held));
  };
  std::uint32_t last_string = 0;  // the last one that a reader knows once it has the next code
  for (; codes.size() >= 2; codes = codes.subspan(2)) {
    const auto code = std::uint32_t(from_little_endian(codes.first(2)));
    if (code < kLzwClear && code >= indices.size()) throw MediaError("gif: an image is damaged");
    put(code < kLzwClear ? indices[code] : clear + code - kLzwClear + (code > kLzwClear ? 1 : 0));
    if (code == kLzwClear) {
      width_bits = bits + 1;
      last_string = clear + 1;
    } else if (++last_string == 1U << width_bits && width_bits < kMaxWidth_bits) {
      ++width_bits;
    }
  }
  put(clear + 1);  // the end
  data.push_back(std::uint8_t(held));
  bytes.push_back(std::uint8_t(bits));
  for (ByteSpan rest = data; !rest.empty();) {
    const ByteSpan block = rest.first(std::min<std::size_t>(255, rest.size()));
    bytes.push_back(std::uint8_t(block.size()));
    append(bytes, block);
    rest = rest.subspan(block.size());
  }
  bytes.push_back(0);
}

}  // namespace piblocks
