#include "media/intra_chunk.hpp"

#include <utility>

#include "media/sink_request.hpp"

namespace piblocks {

IntraChunkEncoder::IntraChunkEncoder(VideoFormat format, std::int64_t first_frame,
                                     EncodeFrame encode)
    : format_(std::move(format)), next_frame_(first_frame), encode_(std::move(encode)) {}

void IntraChunkEncoder::add(const ImageView& frame, std::span<const PixelRect> changed) {
  check_frame_size(frame, format_);
  const std::int64_t number = next_frame_++;
  chunk_.push_back({.bytes = encode_(frame, changed, number), .pts = number, .dts = number});
}

EncodedChunk IntraChunkEncoder::finish() { return std::move(chunk_); }

}  // namespace piblocks
