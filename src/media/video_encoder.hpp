// Which encoder makes an MP4, and how it is set up.
// In: the format of the output and what the user said to the encoder. Out: any number of open
// one-thread encoders that all make pieces of the same stream.
#pragma once

#include <piblocks/frame_sink.hpp>

#include "media/av.hpp"

namespace piblocks {

/// An encoder that is known to be there, to suit MP4, and to open with these settings.
class VideoEncoder {
 public:
  /// @throws UsageError listing everything that is wrong with the size and the settings, or that
  ///         no encoder is there.
  VideoEncoder(const VideoFormat& format, const EncoderSettings& settings);

  /// Frames in a second. A chunk is one closed group of pictures: a second lets a viewer jump about
  /// in the video, costs little, and spreads short videos over all workers.
  int frames_per_chunk() const noexcept { return frames_per_chunk_; }
  const VideoFormat& format() const noexcept { return format_; }
  /// libavcodec's.
  const char* name() const noexcept { return codec_->name; }
  AVRational frame_rate() const noexcept { return frame_rate_; }
  /// What the stream's header says; the same for every encoder that open() returns.
  const AVCodecParameters& parameters() const noexcept { return *parameters_; }
  /// The encoder's name, libavcodec's version and, in hexadecimal digits, what the encoder itself
  /// wrote into the header, such as the parameter sets of H.264.
  std::string signature() const;

  /// A fresh encoder for one chunk; time stamps are counted in frames. Thread-safe.
  /// @throws MediaError if it cannot be opened, or its headers differ from parameters().
  AvCodecContextPtr open() const;

 private:
  AvCodecContextPtr open_unchecked() const;
  void apply_settings(AVCodecContext& context) const;

  VideoFormat format_;
  EncoderSettings settings_;
  const AVCodec* codec_ = nullptr;
  AVRational frame_rate_;
  int frames_per_chunk_;
  AvParametersPtr parameters_;
};

}  // namespace piblocks
