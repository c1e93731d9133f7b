#include <fmt/format.h>
#include <piblocks/error.hpp>

#include "media/libav/codec_choice.hpp"
#include "media/libav/find_encoder.hpp"

extern "C" {
#include <libavutil/opt.h>
}

namespace piblocks {
namespace {

constexpr const char* kProres = "prores_ks";
/// Chosen from the table in src/media/README.md.
constexpr int kQuantiser = 4;
/// No picture depends on another: few wait for their turn to be written.
constexpr int kProresFramesPerChunk = 8;

void set_up(AVCodecContext& context) {
  // Without a quantiser it aims at a number of bits, and searches long for it.
  context.flags |= AV_CODEC_FLAG_QSCALE;
  context.global_quality = kQuantiser * FF_QP2LAMBDA;
  check_av(av_opt_set(context.priv_data, "profile", "4444", 0), "set up encoder", kProres);
  // Some programs take the files of a vendor that they know only.
  check_av(av_opt_set(context.priv_data, "vendor", "apl0", 0), "set up encoder", kProres);
  check_av(av_opt_set_int(context.priv_data, "alpha_bits",
                          context.pix_fmt == AV_PIX_FMT_YUVA444P10 ? 16 : 0, 0),
           "set up encoder", kProres);
}

}  // namespace

std::vector<std::string> usable_prores_encoders() {
  if (avcodec_find_encoder_by_name(kProres) == nullptr) return {};
  return {kProres};
}

CodecChoice prores_choice(const VideoFormat& format, const EncoderSettings& settings) {
  std::vector<std::string> problems;
  const AVCodec* const codec = avcodec_find_encoder_by_name(kProres);
  if (codec == nullptr) {
    problems.emplace_back(
        "video: cannot find encoder 'prores_ks' in libavcodec; write *.webm, *.apng or *.png");
  }
  if (settings.encoder && settings.encoder != kProres) {
    problems.push_back(
        fmt::format("video: encoder '{}' has no transparency in *.mov; use prores_ks, or leave the "
                    "encoder out",
                    *settings.encoder));
  }
  if (settings.crf) problems.emplace_back("video: encoder 'prores_ks' has no crf; leave it out");
  if (settings.preset) {
    problems.emplace_back("video: encoder 'prores_ks' has no presets; leave the preset out");
  }
  if (!problems.empty()) throw UsageError(std::move(problems));
  return {.codec = codec,
          .pixel_format = format.has_alpha ? AV_PIX_FMT_YUVA444P10 : AV_PIX_FMT_YUV444P10,
          .frames_per_chunk = kProresFramesPerChunk,
          .set_up = set_up,
          .usable = usable_prores_encoders};
}

}  // namespace piblocks
