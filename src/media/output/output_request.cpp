#include "media/output/output_request.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>

namespace piblocks {

std::string odd_size_problem(const VideoFormat& format, const std::string& what) {
  const int width = format.width_px;
  const int height = format.height_px;
  if (width % 2 == 0 && height % 2 == 0) return {};
  const auto even = [](int side) { return std::max(2, side - side % 2); };
  return fmt::format("output: size {}x{} is odd: {} needs even sides; use {}x{}", width, height,
                     what, even(width), even(height));
}

void FrameCounter::take(const EncodedChunk& chunk) {
  if (!chunk.empty() && chunk.front().pts != frames_) {
    throw MediaError(fmt::format("output: cannot append the chunk of frame {}: frame {} is next",
                                 chunk.front().pts, frames_));
  }
  frames_ += static_cast<std::int64_t>(chunk.size());
}

}  // namespace piblocks
