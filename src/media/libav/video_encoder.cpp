#include "media/libav/video_encoder.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <new>
#include <span>
#include <utility>

namespace piblocks {
namespace {

AVRational to_av(const Rational& value) {
  return {static_cast<int>(value.get_num().get_si()), static_cast<int>(value.get_den().get_si())};
}

void set_picture_format(AVCodecContext& context, const VideoFormat& format,
                        AVPixelFormat pixel_format) {
  context.width = format.width_px;
  context.height = format.height_px;
  context.pix_fmt = pixel_format;
  context.sample_aspect_ratio = {1, 1};
  context.colorspace = AVCOL_SPC_BT709;
  context.color_primaries = AVCOL_PRI_BT709;
  context.color_trc = AVCOL_TRC_BT709;
  context.color_range = AVCOL_RANGE_MPEG;
  context.chroma_sample_location = AVCHROMA_LOC_LEFT;
}

/// Of a context or of parameters.
std::span<const std::uint8_t> extradata(const auto& stream) {
  return {stream.extradata, static_cast<std::size_t>(stream.extradata_size)};
}

}  // namespace

AvFramePtr allocate_picture(const AVCodecParameters& stream) {
  auto picture = own_av<AvFramePtr>(av_frame_alloc(), "picture");
  picture->width = stream.width;
  picture->height = stream.height;
  picture->format = stream.format;
  picture->colorspace = stream.color_space;
  picture->color_primaries = stream.color_primaries;
  picture->color_trc = stream.color_trc;
  picture->color_range = stream.color_range;
  picture->chroma_location = stream.chroma_location;
  check_av(av_frame_get_buffer(picture.get(), 0), "allocate", "picture");
  return picture;
}

VideoEncoder::VideoEncoder(const VideoFormat& format, CodecChoice choice)
    : format_(format),
      choice_(std::move(choice)),
      frame_rate_(to_av(format.frame_rate)),
      parameters_(own_av<AvParametersPtr>(avcodec_parameters_alloc(), "stream parameters")) {
  try {
    const AvCodecContextPtr first = open_unchecked();
    check_av(avcodec_parameters_from_context(parameters_.get(), first.get()),
             "describe the stream of", name());
    if (first->codec_id == AV_CODEC_ID_AV1 && first->extradata_size == 0) take_headers(*first);
  } catch (const Error& error) {
    throw UsageError(
        fmt::format("{}; usable here: {}", error.what(), usable_encoders(choice_.alternatives)));
  }
}

/// libaom gives the stream's headers only beside its first packet.
void VideoEncoder::take_headers(AVCodecContext& context) {
  const AvFramePtr picture = allocate_picture(*parameters_);
  for (int plane = 0; plane < 3; ++plane) {
    const int rows = plane == 0 ? picture->height : picture->height / 2;
    std::fill_n(picture->data[plane], std::ptrdiff_t{rows} * picture->linesize[plane], 128);
  }
  picture->pts = 0;
  const auto packet = own_av<AvPacketPtr>(av_packet_alloc(), "packet");
  check_av(avcodec_send_frame(&context, picture.get()), "encode a frame with", name());
  check_av(avcodec_send_frame(&context, nullptr), "encode a frame with", name());
  check_av(avcodec_receive_packet(&context, packet.get()), "encode a frame with", name());
  std::size_t size = 0;
  const std::uint8_t* const headers =
      av_packet_get_side_data(packet.get(), AV_PKT_DATA_NEW_EXTRADATA, &size);
  if (headers == nullptr) {
    throw MediaError(fmt::format("video: encoder '{}' does not tell its headers", name()));
  }
  void* const copy = av_mallocz(size + AV_INPUT_BUFFER_PADDING_SIZE);
  if (copy == nullptr) throw std::bad_alloc();
  parameters_->extradata = static_cast<std::uint8_t*>(copy);
  parameters_->extradata_size = static_cast<int>(size);
  std::copy_n(headers, size, parameters_->extradata);
}

std::string VideoEncoder::signature() const {
  return fmt::format("{}, libavcodec {}, {:02x}", name(), version_text(avcodec_version()),
                     fmt::join(extradata(*parameters_), ""));
}

AvCodecContextPtr VideoEncoder::open() const {
  AvCodecContextPtr context = open_unchecked();
  if (context->extradata_size > 0 &&
      !std::ranges::equal(extradata(*context), extradata(*parameters_))) {
    throw MediaError(
        fmt::format("video: cannot join the chunks of encoder '{}': their headers differ", name()));
  }
  return context;
}

AvCodecContextPtr VideoEncoder::open_unchecked() const {
  auto context = own_av<AvCodecContextPtr>(avcodec_alloc_context3(choice_.codec), name());
  set_picture_format(*context, format_, choice_.pixel_format);
  context->framerate = frame_rate_;
  context->time_base = av_inv_q(frame_rate_);
  // Never reached: the last chunk of a video may be one and a half times as long as the others.
  context->gop_size = 2 * choice_.frames_per_chunk;
  // Threads inside an encoder may change its output. Chunks run in parallel instead.
  context->thread_count = 1;
  context->flags = static_cast<int>(AV_CODEC_FLAG_GLOBAL_HEADER | AV_CODEC_FLAG_CLOSED_GOP |
                                    AV_CODEC_FLAG_BITEXACT);
  choice_.set_up(*context);
  check_av(avcodec_open2(context.get(), choice_.codec, nullptr), "open encoder", name());
  return context;
}

}  // namespace piblocks
