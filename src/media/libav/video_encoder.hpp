// The encoders of one stream, and the chunks that they make: closed groups of pictures.
// In: the format of the output and libavcodec's encoder. Out: packets with the time stamps that
// they have in the whole video.
#pragma once

#include <memory>
#include <string>

#include "media/libav/av.hpp"
#include "media/libav/encoder_setup.hpp"
#include "media/output/output.hpp"

namespace piblocks {

/// A video stream, as a muxer describes it.
struct VideoStream {
  AVRational frame_rate;
  AvParametersPtr parameters;
};

/// An encoder that exists and opens with its settings.
class VideoEncoder {
 public:
  /// @throws UsageError if the encoder cannot be opened.
  VideoEncoder(const VideoFormat& format, EncoderSetup setup);

  /// Usually those of a second. A chunk is one closed group of pictures: a second lets viewers
  /// seek, costs little, and spreads short videos over all workers.
  int frames_per_chunk() const noexcept { return setup_.frames_per_chunk; }
  const VideoFormat& format() const noexcept { return format_; }
  /// libavcodec's.
  const char* name() const noexcept { return setup_.codec->name; }
  /// Its parameters are those of every encoder that open() returns.
  const VideoStream& stream() const noexcept { return stream_; }
  /// The encoder's name, libavcodec's version and, in hexadecimal digits, the encoder's own
  /// headers, such as the parameter sets of H.264.
  std::string signature() const;

  /// A fresh encoder for one chunk; time stamps are counted in frames. Thread-safe.
  /// @throws MediaError if it cannot be opened, or its headers differ from stream()'s.
  AvCodecContextPtr open() const;

 private:
  AvCodecContextPtr open_unchecked() const;
  void take_headers(AVCodecContext& context) const;

  VideoFormat format_;
  EncoderSetup setup_;
  VideoStream stream_;
};

/// Makes the chunks of a stream, each by an encoder of its own.
/// @param method  what ChunkEncoder::method() returns
std::unique_ptr<ChunkEncoder> libav_chunk_encoder(std::shared_ptr<const VideoEncoder> encoder,
                                                  std::string method = {});

/// The stream of H.264 that has these headers.
VideoStream h264_stream(const VideoFormat& format, ByteSpan headers, int level_idc);

/// A packet of a picture and of its transparency, which VP9 codes as a video of its own.
struct PictureAndAlpha {
  ByteSpan picture;
  /// libavcodec's side data of a Matroska block; may be empty.
  ByteSpan alpha;
};

/// The picture, the alpha, and the length of the alpha in 4 bytes.
Bytes with_alpha(const PictureAndAlpha& both);
/// Views of the bytes that with_alpha() gave. @throws MediaError if they are cut off.
PictureAndAlpha without_alpha(ByteSpan bytes);

}  // namespace piblocks
