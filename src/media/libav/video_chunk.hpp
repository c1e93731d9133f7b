// The chunks of a video: closed groups of pictures, each from an encoder of its own.
// In: frames. Out: packets with the time stamps they have in the whole video.
#pragma once

#include "media/libav/video_encoder.hpp"
#include "media/output/frame_sink.hpp"

namespace piblocks {

class VideoChunkEncoder final : public ChunkEncoder {
 public:
  explicit VideoChunkEncoder(const VideoEncoder& encoder);
  void begin(std::int64_t first_frame) override;
  void encode() override;
  EncodedChunk finish() override;

 private:
  void convert(const ImageView& frame, std::span<const PixelRect> rects) override;
  void send(const AVFrame* picture);
  void take_packets();

  const VideoEncoder& encoder_;
  AvFramePtr picture_;  // kept, since a frame changes little of it
  void (*convert_rect_)(const ImageView& frame, const PixelRect& rect, AVFrame& picture);
  AvCodecContextPtr context_;
  std::int64_t first_frame_ = 0;
  std::int64_t frames_ = 0;
  AvPacketPtr packet_;
  EncodedChunk chunk_;
};

}  // namespace piblocks
