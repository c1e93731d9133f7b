#include "media/libav/video_chunk.hpp"

#include <span>
#include <utility>

#include "h264/nal_unit.hpp"
#include "media/libav/alpha_packet.hpp"
#include "media/pixels/yuva.hpp"

namespace piblocks {
namespace {

using ConvertRect = void (*)(const ImageView& frame, const PixelRect& rect, AVFrame& picture);

template <typename Sample>
YuvView<Sample> view_of(const AVFrame& picture) {
  const auto plane = [&](int number) -> PlaneView<Sample> {
    return {reinterpret_cast<Sample*>(picture.data[number]), picture.linesize[number]};
  };
  return {plane(0), plane(1), plane(2), plane(3)};
}

ConvertRect conversion_to(int pixel_format) {
  if (pixel_format == AV_PIX_FMT_YUV420P) {
    return [](const ImageView& frame, const PixelRect& rect, AVFrame& picture) {
      convert_to_yuv420(frame, chroma_aligned(rect, frame), view_of<std::uint8_t>(picture));
    };
  }
  if (pixel_format == AV_PIX_FMT_YUVA420P) {
    return [](const ImageView& frame, const PixelRect& rect, AVFrame& picture) {
      convert_to_yuva420(frame, chroma_aligned(rect, frame), view_of<std::uint8_t>(picture));
    };
  }
  return [](const ImageView& frame, const PixelRect& rect, AVFrame& picture) {
    convert_to_yuva444p10(frame, rect, view_of<std::uint16_t>(picture));
  };
}

}  // namespace

VideoChunkEncoder::VideoChunkEncoder(const VideoEncoder& encoder)
    : ChunkEncoder(encoder.format()),
      encoder_(encoder),
      picture_(allocate_picture(encoder.parameters())),
      convert_rect_(conversion_to(picture_->format)),
      packet_(own_av<AvPacketPtr>(av_packet_alloc(), "packet")) {}

void VideoChunkEncoder::begin(std::int64_t first_frame) {
  context_ = encoder_.open();
  first_frame_ = first_frame;
  frames_ = 0;
}

void VideoChunkEncoder::convert(const ImageView& frame, std::span<const PixelRect> rects) {
  // Allocates only if the encoder still uses the last picture. libx264 copies it.
  check_av(av_frame_make_writable(picture_.get()), "refill", "picture");
  for (const PixelRect& rect : rects) convert_rect_(frame, rect, *picture_);
}

void VideoChunkEncoder::encode() {
  picture_->pict_type = frames_ == 0 ? AV_PICTURE_TYPE_I : AV_PICTURE_TYPE_NONE;
  picture_->pts = frames_++;
  send(picture_.get());
}

EncodedChunk VideoChunkEncoder::finish() {
  send(nullptr);
  // As libx264 sets them for B-frames. But if a chunk is shorter than the delay of these, libx264
  // starts it late, and the packet before it would seem to last for several frames.
  std::int64_t dts = first_frame_ - context_->has_b_frames;
  for (Packet& packet : chunk_) packet.dts = dts++;
  context_.reset();
  return std::exchange(chunk_, {});
}

void VideoChunkEncoder::send(const AVFrame* picture) {
  check_av(avcodec_send_frame(context_.get(), picture), "encode a frame with",
           context_->codec->name);
  take_packets();
}

void VideoChunkEncoder::take_packets() {
  while (true) {
    const int code = avcodec_receive_packet(context_.get(), packet_.get());
    if (code == AVERROR(EAGAIN) || code == AVERROR_EOF) return;
    check_av(code, "encode a frame with", context_->codec->name);

    std::span<const std::uint8_t> bytes(packet_->data, static_cast<std::size_t>(packet_->size));
    // libx264 signs the first picture of every encoder with 600 bytes. One copy in the video is
    // enough.
    const bool is_h264 = context_->codec_id == AV_CODEC_ID_H264;
    if (is_h264 && first_frame_ > 0 && chunk_.empty()) bytes = h264::without_user_data(bytes);
    chunk_.push_back({.bytes = {bytes.begin(), bytes.end()},
                      .pts = first_frame_ + packet_->pts,
                      .key_frame = (packet_->flags & AV_PKT_FLAG_KEY) != 0});
    if (picture_->format == AV_PIX_FMT_YUVA420P) {
      std::size_t size = 0;
      const std::uint8_t* const alpha =
          av_packet_get_side_data(packet_.get(), AV_PKT_DATA_MATROSKA_BLOCKADDITIONAL, &size);
      chunk_.back().bytes = with_alpha({bytes, {alpha, alpha == nullptr ? 0 : size}});
    }
    av_packet_unref(packet_.get());
  }
}

}  // namespace piblocks
