#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "core/nearest_name.hpp"
#include "media/libav/encoder_setup.hpp"

namespace piblocks {
namespace {

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
  const std::vector<std::string> usable = usable_webm_encoders();
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

std::vector<std::string> usable_webm_encoders() {
  std::vector<std::string> names;
  for (const WebmEncoder& encoder : kEncoders) {
    const auto set_up_default = [&](AVCodecContext& context) { set_up(context, encoder, {}); };
    const AVCodec* const codec = codec_of(encoder);
    if (codec != nullptr && can_be_opened(*codec, set_up_default)) names.emplace_back(encoder.name);
  }
  return names;
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
