#include "media/png/exif.hpp"

#include <array>
#include <cstddef>
#include <optional>

namespace piblocks {
namespace {

/// Mirrored from top to bottom, as libavcodec says it of JPEG.
constexpr std::array<const char*, 8> kTurns = {"",
                                               "mirrored and turned clockwise by 180 degrees",
                                               "turned clockwise by 180 degrees",
                                               "mirrored and turned clockwise by 0 degrees",
                                               "mirrored and turned clockwise by 90 degrees",
                                               "turned clockwise by 90 degrees",
                                               "mirrored and turned clockwise by 270 degrees",
                                               "turned clockwise by 270 degrees"};

/// Numbers of a TIFF structure, which says in which order it has their bytes.
class TiffNumbers {
 public:
  explicit TiffNumbers(ByteSpan bytes)
      : bytes_(bytes), is_big_(!bytes.empty() && bytes[0] == 'M') {}

  std::optional<std::uint64_t> at(std::size_t offset, std::size_t size_bytes) const {
    if (offset > bytes_.size() || size_bytes > bytes_.size() - offset) return std::nullopt;
    const ByteSpan number = bytes_.subspan(offset, size_bytes);
    return is_big_ ? from_big_endian(number) : from_little_endian(number);
  }

 private:
  ByteSpan bytes_;
  bool is_big_;
};

}  // namespace

std::string presentation_by_exif(ByteSpan exif) {
  constexpr std::uint64_t kOrientation = 0x112;
  constexpr std::size_t kEntry_bytes = 12;
  const TiffNumbers numbers(exif);
  const auto directory = numbers.at(4, 4);
  const auto count = directory ? numbers.at(*directory, 2) : std::nullopt;
  for (std::size_t i = 0; i < count.value_or(0); ++i) {
    const std::size_t entry = *directory + 2 + i * kEntry_bytes;
    if (numbers.at(entry, 2) != kOrientation) continue;
    const std::uint64_t value = numbers.at(entry + 8, 2).value_or(0);
    return 1 <= value && value <= kTurns.size() ? kTurns.at(value - 1) : "";
  }
  return {};
}

}  // namespace piblocks
