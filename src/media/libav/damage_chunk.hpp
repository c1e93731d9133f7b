// The chunks of a video, each coded from what changes in it.
// In: frames, and which rectangles of them have changed. Out: packets that fit the headers of the
// stream, made here or, where too much changes, by the stream's own encoder.
#pragma once

#include <optional>

#include "h264/macroblock_set.hpp"
#include "h264/picture.hpp"
#include "h264/picture_encoder.hpp"
#include "media/libav/video_chunk.hpp"
#include "media/libav/video_encoder.hpp"
#include "media/output/frame_sink.hpp"
#include "media/pixels/yuv420.hpp"

namespace piblocks {

/// To convert into.
YuvView view_of(h264::Picture& picture);

/// Whether a chunk that is mostly new is left to the stream's own encoder.
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
  /// Macroblocks of the chunk, but for its first picture, that had to be transformed.
  std::int64_t transformed_ = 0;
  bool is_left_ = false;
  bool is_behind_ = false;  // picture_, after frames that the stream's encoder alone has taken
  std::optional<VideoChunkEncoder> stream_encoder_;  // made when it is needed first
};

}  // namespace piblocks
