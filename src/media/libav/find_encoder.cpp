#include "media/libav/find_encoder.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <iterator>

#include "media/output/frame_sink.hpp"

namespace piblocks {
namespace {

bool takes_yuv420p(const AVCodec& codec) {
  if (codec.pix_fmts == nullptr) return false;
  for (const AVPixelFormat* format = codec.pix_fmts; *format != AV_PIX_FMT_NONE; ++format) {
    if (*format == AV_PIX_FMT_YUV420P) return true;
  }
  return false;
}

bool is_software_h264(const AVCodec& codec) {
  constexpr int kHardware = AV_CODEC_CAP_HARDWARE | AV_CODEC_CAP_HYBRID;
  return av_codec_is_encoder(&codec) != 0 && codec.id == AV_CODEC_ID_H264 &&
         (codec.capabilities & kHardware) == 0 && takes_yuv420p(codec);
}

/// libavcodec's, the default first.
std::vector<std::string> software_h264_encoders() {
  std::vector<std::string> names;
  void* position = nullptr;
  while (const AVCodec* codec = av_codec_iterate(&position)) {
    if (!is_software_h264(*codec) || !can_be_opened(*codec)) continue;
    names.insert(codec->name == kX264 ? names.begin() : names.end(), codec->name);
  }
  return names;
}

const AVCodec& first_encoder() {
  const std::vector<std::string> found = software_h264_encoders();
  if (found.empty()) {
    throw UsageError(
        "video: cannot find an H.264 encoder in libavcodec; install Debian's package libavcodec59 "
        "(or libavcodec-extra), which brings libx264, or write *.y4m or *.png");
  }
  return *avcodec_find_encoder_by_name(found.front().c_str());
}

}  // namespace

bool can_be_opened(const AVCodec& codec, const std::function<void(AVCodecContext&)>& set_up) {
  const auto context = own_av<AvCodecContextPtr>(avcodec_alloc_context3(&codec), codec.name);
  context->width = 64;
  context->height = 64;
  context->pix_fmt = AV_PIX_FMT_YUV420P;
  context->time_base = {1, 60};
  context->thread_count = 1;
  if (set_up) set_up(*context);
  return avcodec_open2(context.get(), &codec, nullptr) >= 0;
}

std::vector<std::string> usable_h264_encoders() {
  std::vector<std::string> names = software_h264_encoders();
  if (std::ranges::count(names, kX264) > 0) names.emplace(names.begin(), kDamage);
  return names;
}

std::vector<std::string> usable_mov_encoders() {
  std::vector<std::string> names = usable_h264_encoders();
  std::ranges::move(usable_prores_encoders(), std::back_inserter(names));
  return names;
}

const AVCodec& find_encoder(const std::optional<std::string>& name,
                            std::vector<std::string> (*usable)()) {
  // The usual case does not open every encoder there is.
  if (!name || name == kX264) {
    if (const AVCodec* x264 = avcodec_find_encoder_by_name(kX264.data())) return *x264;
    if (!name) return first_encoder();
  }
  // An encoder of which nobody knows how it is set up may never end, as libsvtav1 does.
  const std::vector<std::string> names = usable();
  if (std::ranges::count(names, *name) == 0) {
    throw UsageError(fmt::format("video: cannot use encoder '{}'; use one of: {}", *name,
                                 fmt::join(names, ", ")));
  }
  return *avcodec_find_encoder_by_name(name->c_str());
}

}  // namespace piblocks
