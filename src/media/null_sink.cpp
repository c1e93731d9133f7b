#include "media/sink_kinds.hpp"

namespace piblocks {
namespace {

class NullChunkEncoder final : public ChunkEncoder {
 public:
  void add(const ImageView& /*frame*/, std::span<const PixelRect> /*changed*/) override {}
  EncodedChunk finish() override { return {}; }
};

class NullSink final : public FrameSink {
 public:
  std::int64_t frames_per_chunk() const override { return 64; }
  std::unique_ptr<ChunkEncoder> begin_chunk(std::int64_t /*first_frame*/) const override {
    return std::make_unique<NullChunkEncoder>();
  }
  void append(const EncodedChunk& /*chunk*/) override {}
  void finish() override {}
};

}  // namespace

std::unique_ptr<FrameSink> open_null(const SinkRequest& /*request*/) {
  return std::make_unique<NullSink>();
}

}  // namespace piblocks
