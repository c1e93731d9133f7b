#include "media/video_encoder.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
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

std::span<const std::uint8_t> extradata(const AVCodecContext& context) {
  return {context.extradata, static_cast<std::size_t>(context.extradata_size)};
}

std::span<const std::uint8_t> extradata(const AVCodecParameters& parameters) {
  return {parameters.extradata, static_cast<std::size_t>(parameters.extradata_size)};
}

}  // namespace

VideoEncoder::VideoEncoder(const VideoFormat& format, CodecChoice choice)
    : format_(format),
      choice_(std::move(choice)),
      frame_rate_(to_av(format.frame_rate)),
      parameters_(own_av<AvParametersPtr>(avcodec_parameters_alloc(), "stream parameters")) {
  try {
    const AvCodecContextPtr first = open_unchecked();
    check_av(avcodec_parameters_from_context(parameters_.get(), first.get()),
             "describe the stream of", name());
  } catch (const Error& error) {
    throw UsageError(
        fmt::format("{}; usable here: {}", error.what(), fmt::join(choice_.usable(), ", ")));
  }
}

std::string VideoEncoder::signature() const {
  return fmt::format("{}, libavcodec {}, {:02x}", name(), version_text(avcodec_version()),
                     fmt::join(extradata(*parameters_), ""));
}

AvCodecContextPtr VideoEncoder::open() const {
  AvCodecContextPtr context = open_unchecked();
  if (!std::ranges::equal(extradata(*context), extradata(*parameters_))) {
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
  // Never reached: the last chunk of a video may be half as long again as the others.
  context->gop_size = 2 * choice_.frames_per_chunk;
  // Threads inside an encoder may change its output; chunks are what runs in parallel.
  context->thread_count = 1;
  context->flags = static_cast<int>(AV_CODEC_FLAG_GLOBAL_HEADER | AV_CODEC_FLAG_CLOSED_GOP |
                                    AV_CODEC_FLAG_BITEXACT);
  choice_.set_up(*context);
  check_av(avcodec_open2(context.get(), choice_.codec, nullptr), "open encoder", name());
  return context;
}

}  // namespace piblocks
