#include "media/output/stream_sink.hpp"

namespace piblocks {

void StreamSink::append(const EncodedChunk& chunk) {
  counter_.take(chunk);
  for (const Packet& packet : chunk) file_.write(packet.bytes);
}

void StreamSink::finish() {
  file_.write(trailer_);
  file_.finish();
}

}  // namespace piblocks
