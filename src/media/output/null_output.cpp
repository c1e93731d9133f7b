#include <utility>

#include "media/output/output_kinds.hpp"

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

class NullOutput final : public Output {
 public:
  explicit NullOutput(VideoFormat format) : format_(std::move(format)) {}
  std::int64_t frames_per_chunk() const override { return 64; }
  std::unique_ptr<ChunkEncoder> make_encoder() const override {
    return std::make_unique<NullEncoder>(format_);
  }
  std::string signature() const override { return "null"; }
  std::unique_ptr<FrameSink> open() const override { return std::make_unique<NullSink>(); }

 private:
  VideoFormat format_;
};

}  // namespace

std::unique_ptr<Output> null_output(const OutputRequest& request) {
  return std::make_unique<NullOutput>(request.format);
}

}  // namespace piblocks
