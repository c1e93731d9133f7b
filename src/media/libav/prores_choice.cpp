#include <fmt/format.h>

#include "media/libav/codec_choice.hpp"

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

CodecChoice prores_choice(const VideoFormat& format, const EncoderSettings& settings) {
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
          .set_up = set_up_prores,
          .alternatives = {EncoderKind::prores}};
}

}  // namespace piblocks
