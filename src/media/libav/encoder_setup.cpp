#include "media/libav/encoder_setup.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include "core/nearest_name.hpp"
#include "media/libav/av.hpp"
#include "media/libav/sound_stream.hpp"
#include "media/mp4/h264_chunk.hpp"

extern "C" {
#include <libavutil/opt.h>
}

namespace piblocks {
namespace {

// ---- H.264

// Chosen from the table in tests/benchmark/encoders.md.
constexpr const char* kX264Preset = "ultrafast";
constexpr const char* kX264Qp = "14";
/// For a preset without a quality: slower presets need the rate factor's analysis.
constexpr double kX264Crf = 21;

/// For encoders without constant quality: generous for flat shapes.
constexpr double kBitsPerPixel = 0.1;

bool is_software_h264(const AVCodec& codec) {
  constexpr int kHardware = AV_CODEC_CAP_HARDWARE | AV_CODEC_CAP_HYBRID;
  return av_codec_is_encoder(&codec) != 0 && codec.id == AV_CODEC_ID_H264 &&
         (codec.capabilities & kHardware) == 0 &&
         std::ranges::count(pixel_formats_of(codec), AV_PIX_FMT_YUV420P) > 0;
}

/// libavcodec's, the default first.
std::vector<std::string> software_encoders() {
  std::vector<std::string> names;
  void* position = nullptr;
  while (const AVCodec* codec = av_codec_iterate(&position)) {
    if (!is_software_h264(*codec) || !can_be_opened(*codec)) continue;
    names.insert(codec->name == kX264 ? names.begin() : names.end(), codec->name);
  }
  return names;
}

/// libavcodec's encoder of that name, or its default.
/// @param kinds  of the encoders that may be asked for. An encoder that nobody knows how to set up
///               may never end, as libsvtav1 does.
/// @throws UsageError if there is none, or another is asked for.
const AVCodec& find_encoder(const std::optional<std::string>& name,
                            const std::vector<EncoderKind>& kinds) {
  const AVCodec* const x264 = avcodec_find_encoder_by_name(kX264.data());
  if (x264 != nullptr && (!name || name == kX264)) return *x264;  // without opening every encoder
  if (!name) {
    const std::vector<std::string> found = software_encoders();
    if (!found.empty()) return *avcodec_find_encoder_by_name(found.front().c_str());
    throw UsageError(
        "video: cannot find an H.264 encoder in libavcodec; install Debian's package libavcodec59 "
        "(or libavcodec-extra), which brings libx264, or write *.y4m or *.png");
  }
  const std::vector<std::string> usable = usable_encoders(kinds);
  if (std::ranges::count(usable, *name) > 0) return *avcodec_find_encoder_by_name(name->c_str());
  throw UsageError(fmt::format("video: cannot use encoder '{}'; use one of: {}{}", *name,
                               fmt::join(usable, ", "), did_you_mean(*name, usable)));
}

std::string crf_problem(const AVCodec& codec, double crf) {
  // Below 1 libx264 encodes without loss, in High 4:4:4 Predictive, which hardly any player knows.
  constexpr double kMinCrf = 1;
  constexpr double kMaxCrf = 51;
  if (!has_option(codec, "crf")) return no_crf(codec.name);
  if (crf >= kMinCrf && crf <= kMaxCrf) return {};
  return fmt::format("video: crf {} is out of range; use {} (best) to {}", crf, kMinCrf, kMaxCrf);
}

std::string preset_problem(const AVCodec& codec, const std::string& preset) {
  static const std::vector<std::string> presets = {"ultrafast", "superfast", "veryfast", "faster",
                                                   "fast",      "medium",    "slow",     "slower",
                                                   "veryslow",  "placebo"};
  if (!has_option(codec, "preset")) return no_preset(codec.name);
  // When it is opened, libx264 rejects an unknown preset without naming the reason.
  if (codec.name != kX264 || std::ranges::count(presets, preset) > 0) return {};
  return fmt::format("video: encoder '{}' has no preset '{}'; use one of: {}{}", codec.name, preset,
                     fmt::join(presets, ", "), did_you_mean(preset, presets));
}

/// A chunk is one group of pictures: only its first picture is a key frame, however much a picture
/// differs from the last. And the bytes depend on the frames alone.
void make_chunks_reproducible(AVCodecContext& context, const AVCodec& codec) {
  const auto set_if_known = [&](const char* name, const char* value) {
    if (has_option(codec, name)) set_option(context, name, value);
  };
  // Never: 0 for libx264, the largest value for libavcodec's own encoders.
  set_if_known("sc_threshold", codec.name == kX264 ? "0" : "1000000000");
  // With libx264 r3095's macroblock tree, equal frames of 64x48 gave up to three different chunks,
  // depending on what memory held before (not without its vector code).
  set_if_known("mbtree", "0");
  // Otherwise libx264 analyses pictures differently on processors without SSSE3.
  set_if_known("x264-params", "cpu-independent=1");
  set_if_known("forced-idr", "1");
}

void set_up(AVCodecContext& context, const AVCodec& codec, const EncoderSettings& settings) {
  const bool is_x264 = codec.name == kX264;
  if (settings.crf) {
    set_option(context, "crf", fmt::format("{}", *settings.crf));
  } else if (is_x264 && settings.preset) {
    set_option(context, "crf", fmt::format("{}", kX264Crf));
  } else if (is_x264) {
    // Without rate control libx264 does not analyse a small copy of every frame first.
    set_option(context, "qp", kX264Qp);
  }
  if (settings.preset || is_x264) {
    set_option(context, "preset", settings.preset.value_or(kX264Preset));
  }
  if (!has_option(codec, "crf")) {
    context.bit_rate =
        std::int64_t(kBitsPerPixel * context.width * context.height * av_q2d(context.framerate));
  }
  make_chunks_reproducible(context, codec);
}

// ---- ProRes

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

// ---- WebM

using Option = std::pair<const char*, const char*>;

/// An encoder whose stream WebM can hold.
struct WebmEncoder {
  std::string_view name;  ///< libavcodec's
  std::string_view short_name;
  bool has_alpha;
  double crf;  ///< chosen, as the other options, from tests/benchmark/encoders.md
  std::span<const Option> options;
};

// Neither looks ahead nor makes hidden pictures: a packet is a frame.
constexpr std::array<Option, 6> kVp9Options = {{{"deadline", "realtime"},
                                                {"cpu-used", "6"},
                                                {"lag-in-frames", "0"},
                                                {"auto-alt-ref", "0"},
                                                {"row-mt", "0"},
                                                {"tune-content", "screen"}}};
constexpr std::array<Option, 4> kAomOptions = {
    {{"usage", "realtime"}, {"cpu-used", "6"}, {"lag-in-frames", "0"}, {"row-mt", "0"}}};

/// The default first.
constexpr std::array kEncoders = {WebmEncoder{"libvpx-vp9", "vp9", true, 10, kVp9Options},
                                  WebmEncoder{"libaom-av1", "av1", false, 5, kAomOptions}};

const AVCodec* codec_of(const WebmEncoder& encoder) {
  return avcodec_find_encoder_by_name(encoder.name.data());
}

/// The first with this name, long or short, that libavcodec has.
const WebmEncoder* find(const std::optional<std::string>& name) {
  for (const WebmEncoder& encoder : kEncoders) {
    const bool is_meant = !name || *name == encoder.name || *name == encoder.short_name;
    if (is_meant && codec_of(encoder) != nullptr) return &encoder;
  }
  return nullptr;
}

std::string crf_problem(double crf) {
  constexpr double kMaxCrf = 63;
  if (!(crf >= 0 && crf <= kMaxCrf)) {
    return fmt::format("video: crf {} is out of range of *.webm; use 0 (best) to {}", crf, kMaxCrf);
  }
  if (crf == std::floor(crf)) return {};
  return fmt::format("video: crf {} is no whole number, as *.webm needs; use {} or {}", crf,
                     std::floor(crf), std::ceil(crf));
}

std::string missing_encoder(const std::optional<std::string>& name) {
  const std::vector<std::string> usable = usable_encoders(EncoderKind::webm);
  const std::string wanted = name.value_or("vp9");
  return fmt::format("video: cannot find encoder '{}' for *.webm; use one of: {}{}", wanted,
                     fmt::join(usable, ", "), did_you_mean(wanted, usable));
}

void set_up(AVCodecContext& context, const WebmEncoder& encoder, const EncoderSettings& settings) {
  context.bit_rate = 0;  // constant quality
  set_option(context, "crf", fmt::format("{:.0f}", settings.crf.value_or(encoder.crf)));
  for (const auto& [name, value] : encoder.options) set_option(context, name, value);
  if (settings.preset) set_option(context, "preset", *settings.preset);
}

}  // namespace

std::vector<std::string> usable_encoders(EncoderKind kind) {
  std::vector<std::string> names;
  switch (kind) {
    case EncoderKind::h264:
      names = software_encoders();
      names.emplace(names.begin(), kBuiltin);
      break;
    case EncoderKind::webm:
      for (const WebmEncoder& encoder : kEncoders) {
        const auto set_up_default = [&](AVCodecContext& context) { set_up(context, encoder, {}); };
        const AVCodec* const codec = codec_of(encoder);
        if (codec == nullptr || !can_be_opened(*codec, set_up_default)) continue;
        names.emplace_back(encoder.name);
      }
      break;
    case EncoderKind::prores:
      if (avcodec_find_encoder_by_name(kProres.data()) != nullptr) names.emplace_back(kProres);
      break;
    case EncoderKind::sound:
      for (const SoundCodec& codec : {kAac, kOpus}) {
        if (avcodec_find_encoder_by_name(codec.name) != nullptr) names.emplace_back(codec.name);
      }
      break;
  }
  return names;
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

EncoderSetup h264_setup(const VideoFormat& format, const EncoderSettings& settings,
                        const std::vector<EncoderKind>& kinds) {
  const AVCodec* codec = nullptr;
  Problems problems;
  problems.add(odd_size_problem(format, "H.264 in 4:2:0"));
  problems.add(h264_level_problem(format));
  try {
    codec = &find_encoder(settings.encoder, kinds);
    if (settings.crf) problems.add(crf_problem(*codec, *settings.crf));
    if (settings.preset) problems.add(preset_problem(*codec, *settings.preset));
  } catch (const UsageError& error) {
    problems.add(error.what());
  }
  problems.check();
  return {
      .codec = codec,
      .pixel_format = AV_PIX_FMT_YUV420P,
      .frames_per_chunk = frames_in_a_second(format.frame_rate),
      .apply = [codec, settings](AVCodecContext& context) { set_up(context, *codec, settings); },
      .alternatives = kinds};
}

EncoderSetup webm_setup(const VideoFormat& format, const EncoderSettings& settings) {
  const WebmEncoder* const encoder = find(settings.encoder);
  Problems problems;
  problems.add(odd_size_problem(format, "WebM in 4:2:0"));
  if (settings.crf) problems.add(crf_problem(*settings.crf));
  if (encoder == nullptr) problems.add(missing_encoder(settings.encoder));
  if (encoder != nullptr && format.has_alpha && !encoder->has_alpha) {
    problems.add(
        fmt::format("video: encoder '{}' has no transparency; use vp9, or leave the encoder out",
                    encoder->name));
  }
  if (encoder != nullptr && settings.preset && !has_option(*codec_of(*encoder), "preset")) {
    problems.add(no_preset(encoder->name));
  }
  problems.check();
  // cppcheck-suppress nullPointerRedundantCheck ; without an encoder, check() throws
  return {.codec = codec_of(*encoder),
          .pixel_format = format.has_alpha ? AV_PIX_FMT_YUVA420P : AV_PIX_FMT_YUV420P,
          .frames_per_chunk = frames_in_a_second(format.frame_rate),
          .apply = [encoder,
                    settings](AVCodecContext& context) { set_up(context, *encoder, settings); },
          .alternatives = {EncoderKind::webm}};
}

}  // namespace piblocks
