// A packet that carries its picture's transparency, which VP9 codes as a video of its own.
// In: the two coded pictures. Out: one run of bytes, for chunks and part files, and from it the two
// again.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace piblocks {

/// @param alpha  as libavcodec's side data of a Matroska block has it; may be empty.
std::vector<std::uint8_t> with_alpha(std::span<const std::uint8_t> picture,
                                     std::span<const std::uint8_t> alpha);

struct PictureAndAlpha {
  std::span<const std::uint8_t> picture;
  std::span<const std::uint8_t> alpha;
};

/// Views of the bytes that with_alpha() gave.
/// @throws MediaError if they are none.
PictureAndAlpha without_alpha(std::span<const std::uint8_t> bytes);

}  // namespace piblocks
