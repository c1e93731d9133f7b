// The chunks of a video, coded from what changes in them.
// In: frames, and which rectangles of them have changed. Out: packets that fit the headers of the
// stream, made here or, if too much changes, by the stream's own encoder.
#pragma once

#include <optional>

#include "h264/picture.hpp"
#include "h264/picture_encoder.hpp"
#include "media/libav/video_chunk.hpp"
#include "media/libav/video_encoder.hpp"
#include "media/output/frame_sink.hpp"
#include "media/pixels/yuv420.hpp"

namespace piblocks {

YuvView<std::uint8_t> view_of(h264::Picture& picture);

/// What happens to the rest of a chunk in which too much changes.
enum class WhenTooMuch { leave_to_stream_encoder, go_on };

class DamageChunkEncoder final : public ChunkEncoder {
 public:
  /// @param encoder  of the stream; it must outlive this.
  DamageChunkEncoder(const VideoEncoder& encoder, const h264::ParameterSets& sets, int qp,
                     WhenTooMuch when_too_much);
  void begin(std::int64_t first_frame) override;
  void encode() override;
  EncodedChunk finish() override;
  std::string method() const override;

 private:
  void convert(const ImageView& frame, std::span<const PixelRect> rects) override;
  void convert_here(const ImageView& frame, std::span<const PixelRect> rects);
  void leave();
  bool has_too_much() const;

  const VideoEncoder& encoder_;
  WhenTooMuch when_too_much_;
  h264::Picture picture_;
  h264::MacroblockSet changed_;
  h264::PictureEncoder coder_;
  std::int64_t next_frame_ = 0;
  EncodedChunk chunk_;
  std::int64_t transformed_ = 0;  // macroblocks of the chunk's P pictures
  bool is_left_ = false;          // to the stream's encoder
  bool is_behind_ = false;        // picture_ lacks frames that only the stream's encoder took
  std::optional<VideoChunkEncoder> stream_encoder_;  // made when it is first needed
};

}  // namespace piblocks
