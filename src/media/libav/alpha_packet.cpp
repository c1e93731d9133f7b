#include "media/libav/alpha_packet.hpp"

#include <piblocks/error.hpp>

#include "media/output/little_endian.hpp"

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
  append_little_endian(bytes, alpha.size(), kLength_bytes);
  return bytes;
}

PictureAndAlpha without_alpha(std::span<const std::uint8_t> bytes) {
  std::size_t length = 0;
  if (bytes.size() >= kLength_bytes) {
    length = from_little_endian(bytes.last(kLength_bytes));
  }
  if (bytes.size() < kLength_bytes || length > bytes.size() - kLength_bytes) {
    throw MediaError("video: a packet is cut off where its transparency should be");
  }
  const std::size_t picture = bytes.size() - kLength_bytes - length;
  return {bytes.first(picture), bytes.subspan(picture, length)};
}

}  // namespace piblocks
