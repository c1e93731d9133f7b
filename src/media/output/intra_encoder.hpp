// The chunk encoder of every output whose frames do not depend on each other.
// In: frames. Out: chunks with one packet a frame.
#pragma once

#include "media/output/frame_sink.hpp"

namespace piblocks {

class IntraEncoder : public ChunkEncoder {
 public:
  using ChunkEncoder::ChunkEncoder;
  void begin(std::int64_t first_frame) override { next_frame_ = first_frame; }
  void encode() override;
  EncodedChunk finish() override;

 private:
  /// The bytes of the picture, which depend on its pixels and the frame's number alone.
  virtual std::vector<std::uint8_t> encode_picture(std::int64_t number) = 0;

  std::int64_t next_frame_ = 0;
  EncodedChunk chunk_;
};

}  // namespace piblocks
