#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "media/libav/codec_choice.hpp"
#include "media/libav/find_encoder.hpp"
#include "media/output/output_request.hpp"

extern "C" {
#include <libavutil/opt.h>
}

namespace piblocks {
namespace {

using Option = std::pair<const char*, const char*>;

/// An encoder whose stream WebM can hold.
struct WebmEncoder {
  std::string_view name;  ///< libavcodec's
  std::string_view short_name;
  bool has_alpha;
  double crf;  ///< chosen, as the other options, from the table in src/media/README.md
  std::span<const Option> options;
};

// No look ahead and no pictures that are not shown: a packet is a frame.
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
constexpr double kMaxCrf = 63;

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

std::vector<std::string> problems_of(const VideoFormat& format, const EncoderSettings& settings,
                                     const WebmEncoder* encoder) {
  std::vector<std::string> problems;
  const auto report = [&](std::string problem) {
    if (!problem.empty()) problems.push_back(std::move(problem));
  };
  report(odd_size_problem(format, "WebM in 4:2:0"));
  if (settings.crf && !(*settings.crf >= 0 && *settings.crf <= kMaxCrf)) {
    report(fmt::format("video: crf {} is out of range of *.webm; use 0 (best) to {}", *settings.crf,
                       kMaxCrf));
  } else if (settings.crf && *settings.crf != std::floor(*settings.crf)) {
    report(fmt::format("video: crf {} is no whole number, as *.webm needs; use {} or {}",
                       *settings.crf, std::floor(*settings.crf), std::ceil(*settings.crf)));
  }
  if (encoder == nullptr) {
    report(fmt::format("video: cannot find encoder '{}' for *.webm; use one of: {}",
                       settings.encoder.value_or("vp9"), fmt::join(usable_webm_encoders(), ", ")));
    return problems;
  }
  if (format.has_alpha && !encoder->has_alpha) {
    report(fmt::format("video: encoder '{}' has no transparency; use vp9, or leave the encoder out",
                       encoder->name));
  }
  if (settings.preset && !has_option(*codec_of(*encoder), "preset")) {
    report(fmt::format("video: encoder '{}' has no presets; leave the preset out", encoder->name));
  }
  return problems;
}

void set_up(AVCodecContext& context, const WebmEncoder& encoder, const EncoderSettings& settings) {
  const auto set = [&](const char* name, const std::string& value) {
    check_av(av_opt_set(context.priv_data, name, value.c_str(), 0),
             fmt::format("set {} {} of encoder", name, value), encoder.name);
  };
  context.bit_rate = 0;  // of a constant quality
  set("crf", fmt::format("{:.0f}", settings.crf.value_or(encoder.crf)));
  for (const auto& [name, value] : encoder.options) set(name, value);
  if (settings.preset) set("preset", *settings.preset);
}

bool can_be_opened(const WebmEncoder& encoder) {
  const AVCodec* const codec = codec_of(encoder);
  return codec != nullptr && piblocks::can_be_opened(*codec, [&](AVCodecContext& context) {
           set_up(context, encoder, {});
         });
}

}  // namespace

std::vector<std::string> usable_webm_encoders() {
  std::vector<std::string> names;
  for (const WebmEncoder& encoder : kEncoders) {
    if (can_be_opened(encoder)) names.emplace_back(encoder.name);
  }
  return names;
}

CodecChoice webm_choice(const VideoFormat& format, const EncoderSettings& settings) {
  const WebmEncoder* const encoder = find(settings.encoder);
  std::vector<std::string> problems = problems_of(format, settings, encoder);
  if (!problems.empty()) throw UsageError(std::move(problems));
  return {.codec = codec_of(*encoder),
          .pixel_format = format.has_alpha ? AV_PIX_FMT_YUVA420P : AV_PIX_FMT_YUV420P,
          .frames_per_chunk = frames_in_a_second(format.frame_rate),
          .set_up = [encoder, settings](
                        AVCodecContext& context) { piblocks::set_up(context, *encoder, settings); },
          .usable = usable_webm_encoders};
}

}  // namespace piblocks
