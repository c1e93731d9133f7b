// The chunks of an H.264 video, coded from what changes in them.
// In: frames, and which rectangles of them have changed. Out: packets that fit the headers of the
// stream, made by src/h264 or, if too much changes, by libavcodec's encoder.
#pragma once

#include <optional>

#include "h264/picture.hpp"
#include "h264/picture_encoder.hpp"
#include "media/libav/video_encoder.hpp"
#include "media/output/output.hpp"
#include "media/pixels/yuv.hpp"

namespace piblocks {

YuvView<std::uint8_t> view_of(h264::Picture& picture);

class H264ChunkEncoder final : public ChunkEncoder {
 public:
  /// @param encoder        of the stream; it must outlive this.
  /// @param may_hand_over  whether it may take the rest of a chunk in which much changes.
  H264ChunkEncoder(const VideoEncoder& encoder, const h264::ParameterSets& sets, int qp,
                   bool may_hand_over);
  void begin(std::int64_t first_frame) override;
  void encode() override;
  EncodedChunk finish() override;
  std::string method() const override;

 private:
  void convert(const ImageView& frame, std::span<const PixelRect> rects) override;
  void convert_here(const ImageView& frame, std::span<const PixelRect> rects);
  void hand_over();
  bool changes_too_much() const;

  const VideoEncoder& encoder_;
  bool may_hand_over_;
  h264::Picture picture_;
  h264::MacroblockSet changed_;
  h264::PictureEncoder coder_;
  std::int64_t next_frame_ = 0;
  EncodedChunk chunk_;
  std::int64_t transformed_ = 0;  // macroblocks of the chunk's P pictures
  bool is_handed_over_ = false;   // to libavcodec's encoder
  bool is_behind_ = false;        // picture_ lacks frames that only libavcodec's encoder took
  std::optional<LibavChunkEncoder> libav_encoder_;  // made when it is first needed
};

}  // namespace piblocks
