// One chunk of a video: a closed group of pictures from an encoder of its own.
// In: frames. Out: packets with the time stamps they have in the whole video.
#pragma once

#include <piblocks/frame_sink.hpp>

#include "media/video_encoder.hpp"

namespace piblocks {

class VideoChunkEncoder final : public ChunkEncoder {
 public:
  /// @throws MediaError if the encoder cannot be opened.
  VideoChunkEncoder(const VideoEncoder& encoder, std::int64_t first_frame);
  void add(const ImageView& frame, std::span<const PixelRect> changed) override;
  EncodedChunk finish() override;

 private:
  void send(const AVFrame* picture);
  void take_packets();

  VideoFormat format_;
  std::int64_t first_frame_;
  std::int64_t frames_ = 0;
  AvCodecContextPtr context_;
  AvFramePtr picture_;
  AvPacketPtr packet_;
  EncodedChunk chunk_;
};

}  // namespace piblocks
