#include "media/libav/video_chunk.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "media/libav/alpha_packet.hpp"
#include "media/pixels/yuv420.hpp"
#include "media/pixels/yuva.hpp"

namespace piblocks {
namespace {

using Bytes = std::span<const std::uint8_t>;
using ConvertRect = void (*)(const ImageView& frame, const PixelRect& rect, AVFrame& picture);

YuvView view_of(AVFrame& picture) {
  return {.y = picture.data[0],
          .cb = picture.data[1],
          .cr = picture.data[2],
          .y_stride_bytes = picture.linesize[0],
          .cb_stride_bytes = picture.linesize[1],
          .cr_stride_bytes = picture.linesize[2]};
}

void convert_yuv420(const ImageView& frame, const PixelRect& rect, AVFrame& picture) {
  convert_to_yuv420(frame, chroma_aligned(rect, frame), view_of(picture));
}

template <typename Sample>
PlaneView<Sample> plane_of(const AVFrame& picture, int plane) {
  return {reinterpret_cast<Sample*>(picture.data[plane]), picture.linesize[plane]};
}

void convert_yuva420(const ImageView& frame, const PixelRect& rect, AVFrame& picture) {
  convert_to_yuva420(frame, chroma_aligned(rect, frame),
                     {plane_of<std::uint8_t>(picture, 0), plane_of<std::uint8_t>(picture, 1),
                      plane_of<std::uint8_t>(picture, 2), plane_of<std::uint8_t>(picture, 3)});
}

void convert_yuva444(const ImageView& frame, const PixelRect& rect, AVFrame& picture) {
  convert_to_yuva444p10(frame, rect,
                        {plane_of<std::uint16_t>(picture, 0), plane_of<std::uint16_t>(picture, 1),
                         plane_of<std::uint16_t>(picture, 2), plane_of<std::uint16_t>(picture, 3)});
}

ConvertRect conversion_to(int pixel_format) {
  if (pixel_format == AV_PIX_FMT_YUV420P) return convert_yuv420;
  return pixel_format == AV_PIX_FMT_YUVA420P ? convert_yuva420 : convert_yuva444;
}

/// x264 signs the first picture of every encoder with 600 bytes on its version and options: a user
/// data SEI before the slice (H.264, annex D.1.6). One copy in the video is enough.
Bytes without_signature(Bytes access_unit) {
  constexpr std::array<std::uint8_t, 3> kStartCode = {0, 0, 1};
  constexpr std::uint8_t kSei = 6;
  constexpr std::uint8_t kUserData = 5;
  const auto next_unit = [&](Bytes::iterator from) {
    return std::search(from, access_unit.end(), kStartCode.begin(), kStartCode.end());
  };
  const auto first = next_unit(access_unit.begin());
  if (access_unit.end() - first < 5 || first[3] != kSei || first[4] != kUserData) {
    return access_unit;
  }
  const auto second = next_unit(first + 3);
  return second == access_unit.end() ? access_unit : Bytes(second, access_unit.end());
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
  // Still writable if the encoder has copied the last picture, as libx264 does: no new memory then.
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
  // These are what libx264 sets for a chunk with B-frames, unless the chunk is shorter than the
  // delay they cause: it then starts late, and the packet before it would seem to last for several
  // frames.
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

    Bytes bytes(packet_->data, static_cast<std::size_t>(packet_->size));
    const bool is_h264 = context_->codec_id == AV_CODEC_ID_H264;
    if (is_h264 && first_frame_ > 0 && chunk_.empty()) bytes = without_signature(bytes);
    chunk_.push_back({.bytes = packet_bytes(bytes),
                      .pts = first_frame_ + packet_->pts,
                      .key_frame = (packet_->flags & AV_PKT_FLAG_KEY) != 0});
    av_packet_unref(packet_.get());
  }
}

std::vector<std::uint8_t> VideoChunkEncoder::packet_bytes(Bytes bytes) const {
  if (picture_->format != AV_PIX_FMT_YUVA420P) return {bytes.begin(), bytes.end()};
  std::size_t size = 0;
  const std::uint8_t* const alpha =
      av_packet_get_side_data(packet_.get(), AV_PKT_DATA_MATROSKA_BLOCKADDITIONAL, &size);
  return with_alpha(bytes, {alpha, alpha == nullptr ? 0 : size});
}

}  // namespace piblocks
