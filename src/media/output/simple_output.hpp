// Outputs that need no container: one packet a frame, one packet after another.
// In: how a frame is encoded, and where the packets go. Out: an Output.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/output_file.hpp"
#include "media/output/output_request.hpp"

namespace piblocks {

/// Makes one packet of each frame.
class PacketPerFrameEncoder : public ChunkEncoder {
 public:
  using ChunkEncoder::ChunkEncoder;
  void begin(std::int64_t first_frame) final { next_frame_ = first_frame; }
  void encode() final;
  EncodedChunk finish() final { return std::exchange(chunk_, {}); }

 private:
  /// The bytes of a picture.
  /// @param number    of the frame, from 0.
  /// @param is_first  whether its chunk begins with it: it must not depend on those before it.
  virtual std::vector<std::uint8_t> encode_picture(std::int64_t number, bool is_first) = 0;

  std::int64_t next_frame_ = 0;
  EncodedChunk chunk_;
};

/// The bytes of all packets, in one file or on standard output.
class StreamSink final : public FrameSink {
 public:
  /// Completes a file of so many frames.
  using Ending = std::function<void(OutputFile& file, std::int64_t frames)>;

  /// @throws UsageError if the file cannot be opened.
  explicit StreamSink(const std::string& name, Ending ending = {})
      : file_(name), ending_(std::move(ending)) {}

  void append(const EncodedChunk& chunk) override;
  void finish() override;

 private:
  FrameCounter counter_;
  OutputFile file_;
  Ending ending_;
};

/// An output of pictures that is nothing but its parts.
class SimpleOutput final : public Output {
 public:
  struct Parts {
    std::int64_t frames_per_chunk;
    std::string signature;
    std::function<std::unique_ptr<ChunkEncoder>()> make_encoder;
    std::function<std::unique_ptr<FrameSink>()> open;
  };
  explicit SimpleOutput(Parts parts) : parts_(std::move(parts)) {}

  std::int64_t frames_per_chunk() const override { return parts_.frames_per_chunk; }
  std::string signature() const override { return parts_.signature; }
  std::unique_ptr<ChunkEncoder> make_encoder() const override { return parts_.make_encoder(); }
  std::unique_ptr<FrameSink> open() const override { return parts_.open(); }

 private:
  Parts parts_;
};

/// A SimpleOutput of an Encoder, which is made from the format, into a StreamSink.
template <typename Encoder>
std::unique_ptr<Output> stream_output(const OutputRequest& request, std::int64_t frames_per_chunk,
                                      std::string signature, StreamSink::Ending ending = {}) {
  return std::make_unique<SimpleOutput>(SimpleOutput::Parts{
      .frames_per_chunk = frames_per_chunk,
      .signature = std::move(signature),
      .make_encoder = [format = request.format] { return std::make_unique<Encoder>(format); },
      .open = [name = request.name,
               ending] { return std::make_unique<StreamSink>(name, ending); }});
}

}  // namespace piblocks
