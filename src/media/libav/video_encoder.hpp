// The encoders of one stream.
// In: the format of the output and the choice of the encoder. Out: any number of open one-thread
// encoders that make pieces of the same stream.
#pragma once

#include "media/libav/av.hpp"
#include "media/libav/codec_choice.hpp"
#include "media/output/frame_sink.hpp"

namespace piblocks {

/// Room for a picture of the stream, with the stream's tags.
AvFramePtr allocate_picture(const AVCodecParameters& stream);

/// An encoder that exists and opens with its settings.
class VideoEncoder {
 public:
  /// @throws UsageError if the encoder cannot be opened.
  VideoEncoder(const VideoFormat& format, CodecChoice choice);

  /// Usually those of a second. A chunk is one closed group of pictures: a second lets viewers
  /// seek, costs little, and spreads short videos over all workers.
  int frames_per_chunk() const noexcept { return choice_.frames_per_chunk; }
  const VideoFormat& format() const noexcept { return format_; }
  /// libavcodec's.
  const char* name() const noexcept { return choice_.codec->name; }
  AVRational frame_rate() const noexcept { return frame_rate_; }
  /// The stream's parameters, which are those of every encoder that open() returns.
  const AVCodecParameters& parameters() const noexcept { return *parameters_; }
  /// The encoder's name, libavcodec's version and, in hexadecimal digits, the encoder's own
  /// headers, such as the parameter sets of H.264.
  std::string signature() const;

  /// A fresh encoder for one chunk; time stamps are counted in frames. Thread-safe.
  /// @throws MediaError if it cannot be opened, or its headers differ from parameters().
  AvCodecContextPtr open() const;

 private:
  AvCodecContextPtr open_unchecked() const;
  void take_headers(AVCodecContext& context);

  VideoFormat format_;
  CodecChoice choice_;
  AVRational frame_rate_;
  AvParametersPtr parameters_;
};

}  // namespace piblocks
