#include "media/output/intra_encoder.hpp"

#include <utility>

namespace piblocks {

void IntraEncoder::encode() {
  const std::int64_t number = next_frame_++;
  chunk_.push_back({.bytes = encode_picture(number), .pts = number, .dts = number});
}

EncodedChunk IntraEncoder::finish() { return std::exchange(chunk_, {}); }

}  // namespace piblocks
