#include "media/output/output_kinds.hpp"
#include "media/output/simple_output.hpp"

namespace piblocks {
namespace {

class NullEncoder final : public ChunkEncoder {
 public:
  using ChunkEncoder::ChunkEncoder;
  void begin(std::int64_t /*first_frame*/) override {}
  void encode() override {}
  EncodedChunk finish() override { return {}; }

 private:
  void convert(const ImageView& /*frame*/, std::span<const PixelRect> /*rects*/) override {}
};

class NullSink final : public FrameSink {
 public:
  void append(const EncodedChunk& /*chunk*/) override {}
  void finish() override {}
};

}  // namespace

std::unique_ptr<Output> null_output(const OutputRequest& request) {
  return std::make_unique<SimpleOutput>(SimpleOutput::Parts{
      .frames_per_chunk = 64,
      .signature = "null",
      .make_encoder = [format = request.format] { return std::make_unique<NullEncoder>(format); },
      .open = [] { return std::make_unique<NullSink>(); }});
}

}  // namespace piblocks
