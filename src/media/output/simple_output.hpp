// Outputs that need no container: one packet a frame, one packet after another.
// In: how a frame is encoded, and where the packets go. Out: an Output.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "core/output_file.hpp"
#include "media/output/output_kinds.hpp"

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
  virtual Bytes encode_picture(std::int64_t number, bool is_first) = 0;

  std::int64_t next_frame_ = 0;
  EncodedChunk chunk_;
};

/// The bytes of all packets, in one file or on standard output.
class StreamSink final : public FrameSink {
 public:
  /// Writes the end of a file of so many frames.
  using WriteTrailer = std::function<void(OutputFile& file, std::int64_t frames)>;

  /// @throws UsageError if the file cannot be opened.
  explicit StreamSink(const std::string& name, WriteTrailer write_trailer = {})
      : file_(name), write_trailer_(std::move(write_trailer)) {}

  void append(const EncodedChunk& chunk) override;
  void finish() override;

 private:
  FrameCounter counter_;
  OutputFile file_;
  WriteTrailer write_trailer_;
};

/// An output whose Encoder is made from the format, into a StreamSink.
template <typename Encoder>
Output stream_output(const OutputRequest& request, std::int64_t frames_per_chunk,
                     std::string signature, StreamSink::WriteTrailer write_trailer = {}) {
  return {.frames_per_chunk = frames_per_chunk,
          .signature = std::move(signature),
          .make_encoder = [format = request.format] { return std::make_unique<Encoder>(format); },
          .open = [name = request.name,
                   write_trailer] { return std::make_unique<StreamSink>(name, write_trailer); }};
}

}  // namespace piblocks
