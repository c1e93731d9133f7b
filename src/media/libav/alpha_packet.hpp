// A packet with the transparency of its picture, which VP9 codes as a video of its own.
// In: the two coded pictures. Out: one run of bytes for chunks and part files, and views of both.
#pragma once

#include <piblocks/error.hpp>

#include <cstdint>
#include <span>
#include <vector>

#include "media/output/little_endian.hpp"

namespace piblocks {

struct PictureAndAlpha {
  std::span<const std::uint8_t> picture;
  std::span<const std::uint8_t>
      alpha;  ///< libavcodec's side data of a Matroska block; may be empty
};

/// The picture, the alpha, and the length of the alpha in 4 bytes.
inline std::vector<std::uint8_t> with_alpha(const PictureAndAlpha& both) {
  std::vector<std::uint8_t> bytes(both.picture.begin(), both.picture.end());
  bytes.insert(bytes.end(), both.alpha.begin(), both.alpha.end());
  append_little_endian(bytes, both.alpha.size(), 4);
  return bytes;
}

/// Views of the bytes that with_alpha() gave.
/// @throws MediaError if they are cut off.
inline PictureAndAlpha without_alpha(std::span<const std::uint8_t> bytes) {
  const std::size_t coded = bytes.size() < 4 ? 0 : bytes.size() - 4;
  const std::size_t alpha = from_little_endian(bytes.subspan(coded));
  if (bytes.size() < 4 || alpha > coded) {
    throw MediaError("video: a packet is cut off where its transparency should be");
  }
  return {bytes.first(coded - alpha), bytes.subspan(coded - alpha, alpha)};
}

}  // namespace piblocks
