#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "h264/level_limits.hpp"
#include "media/libav/codec_choice.hpp"
#include "media/libav/find_encoder.hpp"
#include "media/output/output_request.hpp"

extern "C" {
#include <libavutil/opt.h>
}

namespace piblocks {
namespace {

// Chosen from the table in src/media/README.md.
constexpr const char* kX264Preset = "ultrafast";
constexpr std::int64_t kX264Qp = 14;
/// Where a preset is given without a quality: slower presets need the rate factor's analysis
/// anyway.
constexpr double kX264Crf = 21;

/// Where an encoder knows no constant quality: bits per pixel of average video, generous for flat
/// shapes.
constexpr double kBitsPerPixel = 0.1;

/// Below 1 libx264 encodes without loss, in the profile High 4:4:4 Predictive, which hardly any
/// player knows.
constexpr double kMinCrf = 1;
constexpr double kMaxCrf = 51;

std::string level_problem(const VideoFormat& format) {
  const Rational& rate = format.frame_rate;
  const std::string problem = h264::level_problem(format.width_px, format.height_px,
                                                  rate.get_num().get_si(), rate.get_den().get_si());
  if (problem.empty()) return {};
  return fmt::format(
      "output: H.264 cannot hold this video: {}; make it smaller or slower, or write *.webm, "
      "*.apng or *.png",
      problem);
}

std::string crf_problem(const AVCodec& codec, double crf) {
  if (!has_option(codec, "crf")) {
    return fmt::format("video: encoder '{}' has no crf; leave it out", codec.name);
  }
  if (crf >= kMinCrf && crf <= kMaxCrf) return {};
  return fmt::format("video: crf {} is out of range; use {} (best) to {}", crf, kMinCrf, kMaxCrf);
}

std::string preset_problem(const AVCodec& codec, const std::string& preset) {
  constexpr std::array<std::string_view, 10> kX264Presets = {
      "ultrafast", "superfast", "veryfast", "faster",   "fast",
      "medium",    "slow",      "slower",   "veryslow", "placebo"};
  if (!has_option(codec, "preset")) {
    return fmt::format("video: encoder '{}' has no presets; leave the preset out", codec.name);
  }
  // libx264 takes any text here and refuses it only when it is opened, without a word on why.
  const bool is_unknown = codec.name == kX264 && std::find(kX264Presets.begin(), kX264Presets.end(),
                                                           preset) == kX264Presets.end();
  if (!is_unknown) return {};
  return fmt::format("video: encoder '{}' has no preset '{}'; use one of: {}", codec.name, preset,
                     fmt::join(kX264Presets, ", "));
}

/// Everything that is wrong, found before anything is opened. `codec` is set if there is one.
std::vector<std::string> problems_of(const VideoFormat& format, const EncoderSettings& settings,
                                     std::vector<std::string> (*usable)(), const AVCodec*& codec) {
  std::vector<std::string> problems;
  const auto report = [&](std::string problem) {
    if (!problem.empty()) problems.push_back(std::move(problem));
  };
  report(odd_size_problem(format, "H.264 in 4:2:0"));
  report(level_problem(format));
  try {
    codec = &find_encoder(settings.encoder, usable);
    if (settings.crf) report(crf_problem(*codec, *settings.crf));
    if (settings.preset) report(preset_problem(*codec, *settings.preset));
  } catch (const UsageError& error) {
    report(error.what());
  }
  return problems;
}

void apply_settings(AVCodecContext& context, const AVCodec& codec,
                    const EncoderSettings& settings) {
  const bool is_x264 = codec.name == kX264;
  std::optional<double> crf = settings.crf;
  std::optional<std::string> preset = settings.preset;
  const bool constant_quantiser = is_x264 && !crf && !preset;
  if (is_x264 && !crf && !constant_quantiser) crf = kX264Crf;
  if (is_x264 && !preset) preset = kX264Preset;

  void* options = context.priv_data;
  // Without a rate to control libx264 does not look at a small copy of every frame first.
  if (constant_quantiser) {
    check_av(av_opt_set_int(options, "qp", kX264Qp, 0), "set qp of encoder", codec.name);
  }
  if (crf) check_av(av_opt_set_double(options, "crf", *crf, 0), "set crf of encoder", codec.name);
  if (preset) {
    check_av(av_opt_set(options, "preset", preset->c_str(), 0),
             fmt::format("set preset '{}' of encoder", *preset), codec.name);
  }
  if (!has_option(codec, "crf")) {
    context.bit_rate = static_cast<std::int64_t>(kBitsPerPixel * context.width * context.height *
                                                 av_q2d(context.framerate));
  }
  // A chunk is one group of pictures: no key frame but the first, however much a picture differs
  // from the last. libx264 takes 0 for that, libavcodec's own encoders their largest value.
  if (has_option(codec, "sc_threshold")) {
    check_av(av_opt_set_int(options, "sc_threshold", is_x264 ? 0 : 1'000'000'000, 0),
             "set up encoder", codec.name);
  }
  // With libx264 r3095's macroblock tree, equal frames of 64x48 gave up to three different chunks,
  // depending on what memory held before (not without its vector code). Without the tree the bytes
  // depend on the frames alone; src/media/README.md has what it costs.
  if (has_option(codec, "mbtree")) {
    check_av(av_opt_set_int(options, "mbtree", 0, 0), "set up encoder", codec.name);
  }
  // Unless told not to, libx264 analyses a picture in another way where a processor lacks SSSE3.
  if (has_option(codec, "x264-params")) {
    check_av(av_opt_set(options, "x264-params", "cpu-independent=1", 0), "set up encoder",
             codec.name);
  }
  if (has_option(codec, "forced-idr")) {
    check_av(av_opt_set_int(options, "forced-idr", 1, 0), "set up encoder", codec.name);
  }
}

}  // namespace

CodecChoice h264_choice(const VideoFormat& format, const EncoderSettings& settings,
                        std::vector<std::string> (*usable)()) {
  const AVCodec* codec = nullptr;
  std::vector<std::string> problems = problems_of(format, settings, usable, codec);
  if (!problems.empty()) throw UsageError(std::move(problems));
  return {.codec = codec,
          .pixel_format = AV_PIX_FMT_YUV420P,
          .frames_per_chunk = frames_in_a_second(format.frame_rate),
          .set_up = [codec, settings](
                        AVCodecContext& context) { apply_settings(context, *codec, settings); },
          .usable = usable};
}

}  // namespace piblocks
