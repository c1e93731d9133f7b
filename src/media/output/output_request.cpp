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

void ChunkEncoder::take(const ImageView& frame, std::span<const PixelRect> changed) {
  if (frame.width_px != width_px_ || frame.height_px != height_px_) {
    throw MediaError(fmt::format("output: cannot take frame: it is {}x{}, the output {}x{}",
                                 frame.width_px, frame.height_px, width_px_, height_px_));
  }
  const PixelRect whole{0, 0, width_px_, height_px_};
  convert(frame, is_empty_ ? std::span(&whole, 1) : changed);
  is_empty_ = false;
}

void FrameSink::take_sound(PacketSource& /*sound*/) {
  throw MediaError("output: cannot take sound: it has no place for any");
}

std::unique_ptr<PacketSource> Output::encode_sound(SampleSource& /*samples*/) const {
  throw MediaError("output: cannot encode sound: it has no place for any");
}

void FrameCounter::take(const EncodedChunk& chunk) {
  if (!chunk.empty() && chunk.front().pts != next_frame_) {
    throw MediaError(fmt::format("output: cannot append the chunk of frame {}: frame {} is next",
                                 chunk.front().pts, next_frame_));
  }
  next_frame_ += static_cast<std::int64_t>(chunk.size());
}

}  // namespace piblocks
