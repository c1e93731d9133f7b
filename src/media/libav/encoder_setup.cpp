#include "media/libav/encoder_setup.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>

extern "C" {
#include <libavutil/opt.h>
}

namespace piblocks {
namespace {

/// Chosen from the table in tests/benchmark/encoders.md.
constexpr int kQuantiser = 4;

void set_up_prores(AVCodecContext& context) {
  // Without a quantiser the encoder aims at a number of bits, and searches long for it.
  context.flags |= AV_CODEC_FLAG_QSCALE;
  context.global_quality = kQuantiser * FF_QP2LAMBDA;
  set_option(context, "profile", "4444");
  set_option(context, "vendor", "apl0");  // some programs take only files of a vendor they know
  set_option(context, "alpha_bits", context.pix_fmt == AV_PIX_FMT_YUVA444P10 ? "16" : "0");
}

}  // namespace

std::vector<std::string> usable_encoders(EncoderKind kind) {
  switch (kind) {
    case EncoderKind::h264:
      return usable_h264_encoders();
    case EncoderKind::webm:
      return usable_webm_encoders();
    case EncoderKind::prores:
      if (avcodec_find_encoder_by_name(kProres.data()) == nullptr) return {};
      return {std::string(kProres)};
    case EncoderKind::sound:
      return usable_sound_encoders();
  }
  return {};
}

std::vector<std::string> usable_encoders(std::span<const EncoderKind> kinds) {
  std::vector<std::string> names;
  for (const EncoderKind kind : kinds)
    std::ranges::move(usable_encoders(kind), std::back_inserter(names));
  return names;
}

bool has_option(const AVCodec& codec, const char* name) {
  if (codec.priv_class == nullptr) return false;
  const AVClass* options = codec.priv_class;
  return av_opt_find(&options, name, nullptr, 0, AV_OPT_SEARCH_FAKE_OBJ) != nullptr;
}

void set_option(AVCodecContext& context, const char* name, const std::string& value) {
  check_av(av_opt_set(context.priv_data, name, value.c_str(), 0),
           fmt::format("set {} {} of encoder", name, value), context.codec->name);
}

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

EncoderSetup prores_setup(const VideoFormat& format, const EncoderSettings& settings) {
  constexpr int kFramesPerChunk = 8;  // no picture depends on another; few wait to be written
  const AVCodec* const codec = avcodec_find_encoder_by_name(kProres.data());
  Problems problems;
  if (codec == nullptr) {
    problems.add(
        "video: cannot find encoder 'prores_ks' in libavcodec; write *.webm, *.apng or *.png");
  }
  if (settings.encoder && settings.encoder != kProres) {
    problems.add(
        fmt::format("video: encoder '{}' has no transparency in *.mov; use prores_ks, or leave the "
                    "encoder out",
                    *settings.encoder));
  }
  if (settings.crf) problems.add(no_crf(kProres));
  if (settings.preset) problems.add(no_preset(kProres));
  problems.check();
  return {.codec = codec,
          .pixel_format = format.has_alpha ? AV_PIX_FMT_YUVA444P10 : AV_PIX_FMT_YUV444P10,
          .frames_per_chunk = kFramesPerChunk,
          .apply = set_up_prores,
          .alternatives = {EncoderKind::prores}};
}

}  // namespace piblocks
