#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <zlib.h>

#include <array>
#include <limits>
#include <string_view>

#include "core/ending.hpp"
#include "media/libav/av_module.hpp"
#include "media/output/frame_sink.hpp"
#include "media/output/output_kinds.hpp"

namespace piblocks {
namespace {

/// A kind of output: a new one is one more entry of the table below.
struct OutputKind {
  std::string_view name;  // as a message lists it
  bool (*matches)(std::string_view output) = nullptr;
  std::unique_ptr<Output> (*set_up)(const OutputRequest& request) = nullptr;
  bool takes_encoder_settings = false;
  bool takes_alpha = false;
  bool takes_sound = false;
  bool keeps_pictures = true;
};

constexpr std::string_view kWav = "*.wav (sound alone)";

/// Made of an MP4 by render(), which comes here for the MP4 alone.
constexpr std::string_view kPage = ", *.html (a page)";

constexpr bool is_wav(std::string_view output) { return has_ending(output, ".wav"); }

constexpr std::array kOutputKinds = {
    OutputKind{
        .name = "*.mp4",
        .matches = [](std::string_view output) { return has_ending(output, ".mp4"); },
        .set_up = [](const OutputRequest& request) { return av_module().mp4_output(request); },
        .takes_encoder_settings = true,
        .takes_sound = true},
    OutputKind{
        .name = "*.mov",
        .matches = [](std::string_view output) { return has_ending(output, ".mov"); },
        .set_up = [](const OutputRequest& request) { return av_module().mov_output(request); },
        .takes_encoder_settings = true,
        .takes_alpha = true,
        .takes_sound = true},
    OutputKind{
        .name = "*.webm",
        .matches = [](std::string_view output) { return has_ending(output, ".webm"); },
        .set_up = [](const OutputRequest& request) { return av_module().webm_output(request); },
        .takes_encoder_settings = true,
        .takes_alpha = true,
        .takes_sound = true},
    OutputKind{
        .name = "*.gif",
        .matches = [](std::string_view output) { return has_ending(output, ".gif"); },
        .set_up = [](const OutputRequest& request) { return av_module().gif_output(request); }},
    OutputKind{.name = "*.apng",
               .matches = [](std::string_view output) { return has_ending(output, ".apng"); },
               .set_up = apng_output,
               .takes_alpha = true},
    OutputKind{.name = "*.png with a number field such as %06d",
               .matches = [](std::string_view output) { return has_ending(output, ".png"); },
               .set_up = png_output,
               .takes_alpha = true},
    OutputKind{.name = "*.y4m",
               .matches = [](std::string_view output) { return has_ending(output, ".y4m"); },
               .set_up = y4m_output},
    OutputKind{.name = "- (y4m on standard output)",
               .matches = [](std::string_view output) { return output == "-"; },
               .set_up = y4m_output},
    OutputKind{
        .name = "*.framehash",
        .matches = [](std::string_view output) { return has_ending(output, ".framehash"); },
        .set_up =
            [](const OutputRequest& request) { return av_module().framehash_output(request); },
        .takes_alpha = true},
    OutputKind{.name = "null",
               .matches = [](std::string_view output) { return output == "null"; },
               .set_up = null_output,
               .takes_alpha = true,
               .keeps_pictures = false},
    OutputKind{.name = kWav,
               .matches = is_wav,
               .set_up = wav_output,
               .takes_alpha = true,
               .takes_sound = true,
               .keeps_pictures = false},
};

const OutputKind* find_kind(std::string_view output) {
  for (const OutputKind& kind : kOutputKinds) {
    if (kind.matches(output)) return &kind;
  }
  return nullptr;
}

/// The kinds for which this holds, as a message lists them.
std::string names(bool (*is_listed)(const OutputKind& kind)) {
  std::string names;
  for (const OutputKind& kind : kOutputKinds) {
    if (!is_listed(kind)) continue;
    if (!names.empty()) names += ", ";
    names += kind.name;
  }
  return names;
}

std::string unknown_kind(const std::string& output) {
  return fmt::format("output: cannot tell the kind of '{}' from its name; use one of: {}", output,
                     names([](const OutputKind& /*kind*/) { return true; }) + std::string(kPage));
}

std::string settings_problem(const OutputKind& kind, const std::string& name,
                             const EncoderSettings& settings) {
  if (kind.takes_encoder_settings || (!settings.crf && !settings.preset && !settings.encoder)) {
    return {};
  }
  return fmt::format(
      "output: '{}' has no use for crf, preset or encoder; leave them out or write one of: {}",
      name, names([](const OutputKind& any) { return any.takes_encoder_settings; }));
}

std::string alpha_problem(const OutputKind& kind, const std::string& name, bool has_alpha) {
  if (kind.takes_alpha || !has_alpha) return {};
  return fmt::format(
      "output: '{}' cannot be transparent; use an opaque background or write one of: {}", name,
      names([](const OutputKind& any) { return any.takes_alpha && any.keeps_pictures; }));
}

std::string size_problem(const VideoFormat& format) {
  const auto fits = [](int side) { return side >= 1 && side <= kMaxSide_px; };
  const std::int64_t pixels = std::int64_t{format.width_px} * format.height_px;
  if (fits(format.width_px) && fits(format.height_px) && pixels <= kMaxFrame_px) return {};
  return fmt::format(
      "output: size {}x{} is out of range: use sides of 1 to {} and at most {} "
      "pixels",
      format.width_px, format.height_px, kMaxSide_px, kMaxFrame_px);
}

std::string frame_rate_problem(const Rational& rate) {
  // libav's rationals, and so its time stamps, have 32-bit terms.
  constexpr int kMaxTerm = std::numeric_limits<int>::max();
  if (rate > 0 && rate.get_num() <= kMaxTerm && rate.get_den() <= kMaxTerm) return {};
  return fmt::format(
      "output: frame rate {} is out of range: use a number above 0 such as 60 or "
      "30000/1001",
      rate.get_str());
}

std::string sound_problem(const OutputKind& kind, const std::string& name, bool has_sound) {
  if (kind.takes_sound || !has_sound) return {};
  return fmt::format(
      "output: '{}' has no sound; write one of: {}, or leave the sound out "
      "(--no-sound)",
      name, names([](const OutputKind& any) { return any.takes_sound; }));
}

}  // namespace

std::unique_ptr<Output> set_up_output(const std::string& name, const VideoFormat& format,
                                      const EncoderSettings& settings,
                                      const std::optional<SoundFormat>& sound) {
  std::vector<std::string> problems;
  const auto report = [&](std::string problem) {
    if (!problem.empty()) problems.push_back(std::move(problem));
  };
  const OutputKind* kind = find_kind(name);
  if (kind == nullptr) {
    report(unknown_kind(name));
  } else {
    report(settings_problem(*kind, name, settings));
    report(alpha_problem(*kind, name, format.has_alpha));
    report(sound_problem(*kind, name, sound.has_value()));
  }
  report(size_problem(format));
  report(frame_rate_problem(format.frame_rate));
  if (!problems.empty()) throw UsageError(std::move(problems));

  return kind->set_up({name, format, settings, sound});
}

bool is_sound_alone(const std::string& name) { return is_wav(name); }

std::vector<std::string> media_library_versions() {
  std::vector<std::string> versions = av_module().av_library_versions();
  versions.push_back(std::string("zlib ") + zlibVersion());
  return versions;
}

}  // namespace piblocks
