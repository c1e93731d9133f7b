#include "media/alpha_packet.hpp"

#include <piblocks/error.hpp>

namespace piblocks {
namespace {

/// The picture, its alpha, then the length of the alpha in little-endian order.
constexpr std::size_t kLength_bytes = 4;

}  // namespace

std::vector<std::uint8_t> with_alpha(std::span<const std::uint8_t> picture,
                                     std::span<const std::uint8_t> alpha) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(picture.size() + alpha.size() + kLength_bytes);
  bytes.insert(bytes.end(), picture.begin(), picture.end());
  bytes.insert(bytes.end(), alpha.begin(), alpha.end());
  for (std::size_t i = 0; i < kLength_bytes; ++i) {
    bytes.push_back(static_cast<std::uint8_t>(alpha.size() >> (8 * i)));
  }
  return bytes;
}

PictureAndAlpha without_alpha(std::span<const std::uint8_t> bytes) {
  std::size_t length = 0;
  if (bytes.size() >= kLength_bytes) {
    const auto last = bytes.last(kLength_bytes);
    for (std::size_t i = 0; i < kLength_bytes; ++i) length |= std::size_t{last[i]} << (8 * i);
  }
  if (bytes.size() < kLength_bytes || length > bytes.size() - kLength_bytes) {
    throw MediaError("video: a packet is cut off where its transparency should be");
  }
  const std::size_t picture = bytes.size() - kLength_bytes - length;
  return {bytes.first(picture), bytes.subspan(picture, length)};
}

}  // namespace piblocks
