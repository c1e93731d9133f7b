// The chunk encoder of every output whose frames do not depend on each other.
// In: a function from one frame to its bytes. Out: a chunk with one packet a frame.
#pragma once

#include <piblocks/frame_sink.hpp>

#include <functional>

namespace piblocks {

/// The bytes of one frame, which depend on its pixels and number alone. What has changed since the
/// frame before can save work; for the first of a chunk it says nothing.
using EncodeFrame = std::function<std::vector<std::uint8_t>(
    const ImageView& frame, std::span<const PixelRect> changed, std::int64_t number)>;

class IntraChunkEncoder final : public ChunkEncoder {
 public:
  IntraChunkEncoder(VideoFormat format, std::int64_t first_frame, EncodeFrame encode);
  void add(const ImageView& frame, std::span<const PixelRect> changed) override;
  EncodedChunk finish() override;

 private:
  VideoFormat format_;
  std::int64_t next_frame_;
  EncodeFrame encode_;
  EncodedChunk chunk_;
};

}  // namespace piblocks
