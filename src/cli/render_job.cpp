#include "cli/render_job.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <string_view>
#include <utility>

#include "core/processors.hpp"
#include "core/text.hpp"
#include "media/output/output.hpp"
#include "render/renderings.hpp"

namespace piblocks::cli {
namespace {

/// The settings that suit a use of the video.
struct Destination {
  /// They win over the scene file.
  std::vector<SceneDefault> defaults;
  std::vector<std::string_view> endings;  ///< of the files that it takes
  /// Of *.mov, where it is not the usual one.
  std::optional<std::string> mov_encoder = {};
};

/// What --for names. src/media/README.md has the reasons.
const std::vector<std::pair<std::string, Destination>>& destinations() {
  static const std::vector<std::pair<std::string, Destination>> all = {
      {"powerpoint", {{{"view.size", "1920x1080"}, {"view.fps", "60"}}, {".mp4"}}},
      {"keynote", {{{"view.size", "1920x1080"}, {"view.fps", "60"}}, {".mp4", ".mov"}}},
      {"web",
       {{{"view.size", "1280x720"}, {"view.fps", "30"}},
        {".mp4", ".webm", ".gif", ".apng", ".webp", ".html"}}},
      {"editor",
       {{{"view.size", "1920x1080"}, {"view.fps", "60"}, {"view.background", "transparent"}},
        {".mov", ".png"},
        "prores_ks"}},
      {"shorts", {{{"view.size", "1080x1920"}, {"view.fps", "60"}}, {".mp4"}}},
      {"beamer", {{{"view.size", "1280x720"}, {"view.fps", "25"}}, {".mp4", ".pdf", ".png"}}}};
  return all;
}

/// Nothing if --for is not given. @throws UsageError if it does not suit the output.
std::optional<Destination> destination_of(const OptionTexts& options, const std::string& output) {
  auto found = options.value(
      "--for", [](const std::string& name) { return parse_choice(name, destinations()); });
  const auto is_ending = [&](std::string_view ending) { return has_ending(output, ending); };
  if (!found || std::ranges::any_of(found->endings, is_ending)) return found;
  throw UsageError(fmt::format("--for {}: cannot use '{}' there; write one of: *{}",
                               *options.text("--for"), output, fmt::join(found->endings, ", *")));
}

/// The whole numbers before and behind a separator; nothing for what is none.
std::array<std::optional<Integer>, 2> two_numbers(std::string_view text, char separator) {
  const std::size_t end = std::min(text.find(separator), text.size());
  return {whole_number(text.substr(0, end)),
          whole_number(text.substr(std::min(end + 1, text.size())))};
}

/// "2/3", the second of three.
Shard parse_part(const std::string& text) {
  const auto [number, count] = two_numbers(text, '/');
  const bool is_shard =
      number && count && *number >= 1 && *number <= *count && *count <= kMaxShards;
  if (is_shard) return {int(number->get_si()), int(count->get_si())};
  throw UsageError(
      fmt::format("must be I/N, such as 2/3: I from 1 to N, and N at most {}", kMaxShards));
}

/// "120-180"
FrameRange parse_frames(const std::string& text) {
  const auto [first, last] = two_numbers(text, '-');
  const bool is_range = first && last && *first <= *last && *last < to_integer(kMaxFrames);
  if (is_range) return {first->get_si(), last->get_si()};
  throw UsageError("must be A-B, such as 120-180: frames of the film, the first of which is 0");
}

double parse_crf(const std::string& text) { return to_double(parse_rational(text)); }

EncoderSettings settings_of(const OptionTexts& options) {
  EncoderSettings settings{.crf = options.value("--crf", parse_crf),
                           .preset = options.text("--preset"),
                           .encoder = options.text("--encoder"),
                           .start_number = options.whole("--start-number", 0, kMaxStartNumber),
                           .plays = options.whole("--plays", 1, kMaxPlays)};
  if (!options.is_given("--smallest")) return settings;
  for (const char* option : {"--crf", "--preset", "--encoder"}) {
    if (!options.is_given(option)) continue;
    throw UsageError(
        fmt::format("--smallest chooses the encoder and its settings; leave out {}", option));
  }
  // Under half the size, and many times the time (tests/benchmark/encoders.md).
  settings.crf = 18;
  settings.preset = "slower";
  settings.encoder = "libx264";
  return settings;
}

/// The one place that can be named.
bool parse_captions(const std::string& text) {
  if (text == "inside") return true;
  throw UsageError("must be inside; --bundle writes captions beside the video");
}

std::optional<Bundle> bundle_of(const OptionTexts& options) {
  const auto poster = options.value("--poster", parse_instant);
  if (const auto folder = options.text("--bundle")) return Bundle{*folder, poster};
  if (!poster) return std::nullopt;
  throw UsageError("--poster is for a bundle; add --bundle DIR or leave it out");
}

}  // namespace

RenderJob job_of(const OptionTexts& options, const std::string& output,
                 const MakeScript& make_script) {
  const std::optional<Destination> destination = destination_of(options, output);
  EncoderSettings settings = settings_of(options);
  Script script = destination
                      ? make_script(destination->defaults, "--for " + *options.text("--for"))
                      : make_script({}, {});
  if (destination && !settings.encoder && has_ending(output, ".mov")) {
    settings.encoder = destination->mov_encoder;
  }
  if (options.is_given("--no-sound") && is_sound_alone(output)) {
    throw UsageError(
        fmt::format("--no-sound: '{}' is the sound alone; leave one of them out", output));
  }
  if (options.is_given("--sound") && !takes_sound(output)) {
    throw UsageError("--sound: " + no_sound_in(output));
  }
  return {
      .script = std::move(script),
      .output = output,
      .encoder = std::move(settings),
      .jobs = options.whole("--jobs", 1, kMaxJobs).value_or(std::min(processor_count(), kMaxJobs)),
      .shard = options.value("--part", parse_part),
      .profile = options.is_given("--profile"),
      .bundle = bundle_of(options),
      .captions_inside = options.value("--captions", parse_captions).value_or(false),
      .max_flashes = options.whole("--max-flashes", 1, kMaxFlashes),
      .overwrite = options.is_given("--overwrite"),
      .resume = options.is_given("--resume"),
      .frames = options.value("--frames", parse_frames)};
}

std::string destination_names() {
  std::string names;
  for (const auto& [name, ignored] : destinations()) names += (names.empty() ? "" : ", ") + name;
  return names;
}

std::string name_of(const RenderJob& job) {
  if (job.bundle) return std::filesystem::path(job.bundle->folder) / job.output;
  return job.shard ? shard_name(job.output, *job.shard) : job.output;
}

void claim_outputs(OverwriteCheck& check, const RenderJob& job) {
  if (job.bundle) {
    for (const std::string& file : bundle_files(job)) {
      check.writes("--bundle", std::filesystem::path(job.bundle->folder) / file);
    }
  } else if (job.shard) {
    check.writes("--part", shard_name(job.output, *job.shard));
  } else {
    claim_output(check, "--output", job.output);
  }
}

}  // namespace piblocks::cli
