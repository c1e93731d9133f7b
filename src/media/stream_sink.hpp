// A sink whose output is the packets' bytes one after another.
// In: how a frame becomes bytes; chunks in order. Out: one file, or standard output.
#pragma once

#include "core/output_file.hpp"
#include "media/intra_chunk.hpp"
#include "media/sink_request.hpp"

namespace piblocks {

class StreamSink final : public FrameSink {
 public:
  /// @throws UsageError if the file cannot be opened.
  StreamSink(const SinkRequest& request, std::int64_t frames_per_chunk, EncodeFrame encode);

  std::int64_t frames_per_chunk() const override { return frames_per_chunk_; }
  std::unique_ptr<ChunkEncoder> begin_chunk(std::int64_t first_frame) const override;
  void append(const EncodedChunk& chunk) override;
  void finish() override;

 private:
  VideoFormat format_;
  std::int64_t frames_per_chunk_;
  EncodeFrame encode_;
  FrameCounter counter_;
  OutputFile file_;
};

}  // namespace piblocks
