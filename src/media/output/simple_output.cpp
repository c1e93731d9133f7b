#include "media/output/simple_output.hpp"

namespace piblocks {

void PacketPerFrameEncoder::encode() {
  const std::int64_t number = next_frame_++;
  chunk_.push_back({.bytes = encode_picture(number, chunk_.empty()), .pts = number, .dts = number});
}

void StreamSink::append(const EncodedChunk& chunk) {
  counter_.take(chunk);
  for (const Packet& packet : chunk) file_.write(packet.bytes);
}

void StreamSink::finish() {
  if (ending_) ending_(file_, counter_.frames());
  file_.finish();
}

}  // namespace piblocks
