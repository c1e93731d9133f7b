#include "media/output/outputs.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <zlib.h>

#include <array>
#include <limits>
#include <string_view>

#include "core/text.hpp"
#include "media/libav/av_module.hpp"
#include "media/output/frame_pattern.hpp"
#include "media/output/output_kinds.hpp"

namespace piblocks {
namespace {

using SetUp = std::unique_ptr<Output> (*)(const OutputRequest& request);

/// A function of the module that has libav.
template <auto AvModule::*SetUpInModule>
std::unique_ptr<Output> by_module(const OutputRequest& request) {
  return (av_module().*SetUpInModule)(request);
}

struct OutputKind {
  std::string_view name;    ///< as a message lists it
  std::string_view ending;  ///< of its files' names, or the whole name if that has no dot
  SetUp set_up;
  bool takes_encoder_settings = false;
  bool takes_alpha = false;
  bool takes_sound = false;
  bool keeps_pictures = true;
};

constexpr std::array kOutputKinds = {
    OutputKind{.name = "*.mp4",
               .ending = ".mp4",
               .set_up = by_module<&AvModule::mp4_output>,
               .takes_encoder_settings = true,
               .takes_sound = true},
    OutputKind{.name = "*.mov",
               .ending = ".mov",
               .set_up = by_module<&AvModule::mov_output>,
               .takes_encoder_settings = true,
               .takes_alpha = true,
               .takes_sound = true},
    OutputKind{.name = "*.webm",
               .ending = ".webm",
               .set_up = by_module<&AvModule::webm_output>,
               .takes_encoder_settings = true,
               .takes_alpha = true,
               .takes_sound = true},
    OutputKind{.name = "*.gif", .ending = ".gif", .set_up = by_module<&AvModule::gif_output>},
    OutputKind{.name = "*.apng", .ending = ".apng", .set_up = apng_output, .takes_alpha = true},
    OutputKind{.name = "*.png with a number field such as %06d",
               .ending = ".png",
               .set_up = png_output,
               .takes_alpha = true},
    OutputKind{.name = "*.y4m", .ending = ".y4m", .set_up = y4m_output},
    OutputKind{.name = "- (y4m on standard output)", .ending = "-", .set_up = y4m_output},
    OutputKind{.name = "*.framehash",
               .ending = ".framehash",
               .set_up = by_module<&AvModule::framehash_output>,
               .takes_alpha = true},
    OutputKind{.name = "null",
               .ending = "null",
               .set_up = null_output,
               .takes_alpha = true,
               .keeps_pictures = false},
    OutputKind{.name = "*.wav (sound alone)",
               .ending = ".wav",
               .set_up = wav_output,
               .takes_alpha = true,
               .takes_sound = true,
               .keeps_pictures = false},
};

/// Null if there is none.
const OutputKind* find_kind(std::string_view output) {
  for (const OutputKind& kind : kOutputKinds) {
    const bool is_file = kind.ending.starts_with('.');
    if (is_file ? has_ending(output, kind.ending) : output == kind.ending) return &kind;
  }
  return nullptr;
}

/// The kinds that have a property, as a message lists them.
std::string names(bool (*is_listed)(const OutputKind& kind)) {
  std::string names;
  for (const OutputKind& kind : kOutputKinds) {
    if (!is_listed(kind)) continue;
    if (!names.empty()) names += ", ";
    names += kind.name;
  }
  return names;
}

std::string size_problem(const VideoFormat& format) {
  const auto fits = [](int side) { return side >= 1 && side <= kMaxSide_px; };
  const std::int64_t pixels = std::int64_t{format.width_px} * format.height_px;
  if (fits(format.width_px) && fits(format.height_px) && pixels <= kMaxFrame_px) return {};
  return fmt::format(
      "output: size {}x{} is out of range: use sides of 1 to {} and at most {} pixels",
      format.width_px, format.height_px, kMaxSide_px, kMaxFrame_px);
}

std::string frame_rate_problem(const Rational& rate) {
  constexpr int kMaxTerm = std::numeric_limits<int>::max();  // of libav's rationals
  if (rate > 0 && rate.get_num() <= kMaxTerm && rate.get_den() <= kMaxTerm) return {};
  return fmt::format(
      "output: frame rate {} is out of range: use a number above 0 such as 60 or 30000/1001",
      rate.get_str());
}

/// What the kind of the output does not take.
void check_kind(const OutputKind& kind, const OutputRequest& request, Problems& problems) {
  const EncoderSettings& settings = request.settings;
  const bool has_settings = settings.crf || settings.preset || settings.encoder;
  if (has_settings && !kind.takes_encoder_settings) {
    problems.add(fmt::format(
        "output: '{}' has no use for crf, preset or encoder; leave them out or write one of: {}",
        request.name, names([](const OutputKind& any) { return any.takes_encoder_settings; })));
  }
  if (request.format.has_alpha && !kind.takes_alpha) {
    problems.add(fmt::format(
        "output: '{}' cannot be transparent; use an opaque background or write one of: {}",
        request.name,
        names([](const OutputKind& any) { return any.takes_alpha && any.keeps_pictures; })));
  }
  if (request.sound && !kind.takes_sound) {
    problems.add(fmt::format(
        "output: '{}' has no sound; write one of: {}, or leave the sound out (--no-sound)",
        request.name, names([](const OutputKind& any) { return any.takes_sound; })));
  }
}

}  // namespace

std::unique_ptr<Output> set_up_output(const std::string& name, const VideoFormat& format,
                                      const EncoderSettings& settings,
                                      const std::optional<SoundFormat>& sound) {
  const OutputRequest request = {name, format, settings, sound};
  Problems problems;
  const OutputKind* const kind = find_kind(name);
  if (kind != nullptr) {
    check_kind(*kind, request, problems);
  } else {
    // Of a page, render() sets up only the MP4 in it.
    problems.add(fmt::format(
        "output: cannot tell the kind of '{}' from its name; use one of: {}, *.html (a page)", name,
        names([](const OutputKind& /*kind*/) { return true; })));
  }
  problems.add(size_problem(format));
  problems.add(frame_rate_problem(format.frame_rate));
  problems.check();
  return kind->set_up(request);
}

bool is_sound_alone(const std::string& name) { return has_ending(name, ".wav"); }

void claim_output(OverwriteCheck& check, const std::string& what, const std::string& name) {
  if (name == "null") return;
  if (name == "-") return check.writes_standard_output();
  if (has_ending(name, ".png")) {
    try {
      const FramePattern pattern(name);
      return check.writes_some_of(what, name, pattern.folder(), names_of_pattern(name));
    } catch (const UsageError&) {  // set_up_output() says what is wrong
    }
  }
  check.writes(what, name);
}

std::vector<std::string> media_library_versions() {
  std::vector<std::string> versions = av_module().library_versions();
  versions.push_back(std::string("zlib ") + zlibVersion());
  return versions;
}

}  // namespace piblocks
