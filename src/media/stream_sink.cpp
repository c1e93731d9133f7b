#include "media/stream_sink.hpp"

#include <utility>

namespace piblocks {

StreamSink::StreamSink(const SinkRequest& request, std::int64_t frames_per_chunk,
                       EncodeFrame encode)
    : format_(request.format),
      frames_per_chunk_(frames_per_chunk),
      encode_(std::move(encode)),
      file_(request.output) {}

std::unique_ptr<ChunkEncoder> StreamSink::begin_chunk(std::int64_t first_frame) const {
  return std::make_unique<IntraChunkEncoder>(format_, first_frame, encode_);
}

void StreamSink::append(const EncodedChunk& chunk) {
  counter_.take(chunk);
  for (const Packet& packet : chunk) file_.write(packet.bytes);
}

void StreamSink::finish() { file_.finish(); }

}  // namespace piblocks
