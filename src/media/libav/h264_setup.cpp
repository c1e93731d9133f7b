#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <optional>

#include "core/nearest_name.hpp"
#include "media/libav/av_versions.hpp"
#include "media/libav/encoder_setup.hpp"
#include "media/mp4/h264_chunk.hpp"

namespace piblocks {
namespace {

// Chosen from the table in tests/benchmark/encoders.md.
constexpr const char* kX264Preset = "ultrafast";
constexpr const char* kX264Qp = "14";
/// For a preset without a quality: slower presets need the rate factor's analysis.
constexpr double kX264Crf = 21;

/// For encoders without constant quality: generous for flat shapes.
constexpr double kBitsPerPixel = 0.1;

bool takes_yuv420p(const AVCodec& codec) {
  return std::ranges::count(pixel_formats_of(codec), AV_PIX_FMT_YUV420P) > 0;
}

bool is_software_h264(const AVCodec& codec) {
  constexpr int kHardware = AV_CODEC_CAP_HARDWARE | AV_CODEC_CAP_HYBRID;
  return av_codec_is_encoder(&codec) != 0 && codec.id == AV_CODEC_ID_H264 &&
         (codec.capabilities & kHardware) == 0 && takes_yuv420p(codec);
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
  for (const EncoderKind kind : kinds) {
    if (std::ranges::count(usable_encoders(kind), *name) == 0) continue;
    return *avcodec_find_encoder_by_name(name->c_str());
  }
  const std::vector<std::string> usable = usable_encoders(kinds);
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

}  // namespace

std::vector<std::string> usable_h264_encoders() {
  std::vector<std::string> names = software_encoders();
  names.emplace(names.begin(), kBuiltin);
  return names;
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

}  // namespace piblocks
