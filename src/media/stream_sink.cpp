#include "media/stream_sink.hpp"

namespace piblocks {

void StreamSink::append(const EncodedChunk& chunk) {
  counter_.take(chunk);
  for (const Packet& packet : chunk) file_.write(packet.bytes);
}

}  // namespace piblocks
