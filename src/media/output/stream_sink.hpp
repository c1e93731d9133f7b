// Outputs that are the packets' bytes one after another.
// In: chunks in order. Out: one file, or standard output.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/output_file.hpp"
#include "media/output/output_request.hpp"

namespace piblocks {

class StreamSink final : public FrameSink {
 public:
  /// @param trailer  what comes behind the last packet.
  /// @throws UsageError if the file cannot be opened.
  explicit StreamSink(const std::string& name, std::vector<std::uint8_t> trailer = {})
      : file_(name), trailer_(std::move(trailer)) {}

  void append(const EncodedChunk& chunk) override;
  void finish() override;

 private:
  FrameCounter counter_;
  OutputFile file_;
  std::vector<std::uint8_t> trailer_;
};

/// @tparam Encoder  a ChunkEncoder, made from the format.
template <typename Encoder>
class StreamOutput final : public Output {
 public:
  StreamOutput(OutputRequest request, std::int64_t frames_per_chunk, std::string signature,
               std::vector<std::uint8_t> trailer = {})
      : request_(std::move(request)),
        frames_per_chunk_(frames_per_chunk),
        signature_(std::move(signature)),
        trailer_(std::move(trailer)) {}

  std::int64_t frames_per_chunk() const override { return frames_per_chunk_; }
  std::unique_ptr<ChunkEncoder> make_encoder() const override {
    return std::make_unique<Encoder>(request_.format);
  }
  std::string signature() const override { return signature_; }
  std::unique_ptr<FrameSink> open() const override {
    return std::make_unique<StreamSink>(request_.name, trailer_);
  }

 private:
  OutputRequest request_;
  std::int64_t frames_per_chunk_;
  std::string signature_;
  std::vector<std::uint8_t> trailer_;
};

}  // namespace piblocks
