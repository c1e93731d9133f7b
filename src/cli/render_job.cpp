#include "cli/render_job.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <utility>

#include "cli/values.hpp"
#include "core/processors.hpp"
#include "core/text.hpp"
#include "media/output/output.hpp"
#include "render/renderings.hpp"

namespace piblocks::cli {
namespace {

int parse_jobs(const std::string& text) { return parse_int(text, 1, kMaxJobs); }

int parse_flashes(const std::string& text) { return parse_int(text, 1, kMaxFlashes); }

/// "2/3", the second of three.
Shard parse_part(const std::string& text) {
  const std::size_t slash = std::min(text.find('/'), text.size());
  const std::optional<Integer> number = whole_number(text.substr(0, slash));
  const std::optional<Integer> count = whole_number(text.substr(std::min(slash + 1, text.size())));
  const bool is_shard =
      number && count && *number >= 1 && *number <= *count && *count <= kMaxShards;
  if (is_shard) return {int(number->get_si()), int(count->get_si())};
  throw UsageError(
      fmt::format("must be I/N, such as 2/3: I from 1 to N, and N at most {}", kMaxShards));
}

/// "120-180"
FrameRange parse_frames(const std::string& text) {
  const std::size_t dash = std::min(text.find('-'), text.size());
  const std::optional<Integer> first = whole_number(text.substr(0, dash));
  const std::optional<Integer> last = whole_number(text.substr(std::min(dash + 1, text.size())));
  const bool is_range = first && last && *first <= *last && *last < to_integer(kMaxFrames);
  if (is_range) return {first->get_si(), last->get_si()};
  throw UsageError("must be A-B, such as 120-180: frames of the film, the first of which is 0");
}

double parse_crf(const std::string& text) { return to_double(parse_rational(text)); }

/// Under half the size, and many times the time (tests/benchmark/encoders.md).
void set_smallest(EncoderSettings& settings) {
  settings.crf = 18;
  settings.preset = "slower";
  settings.encoder = "libx264";
}

int parse_plays(const std::string& text) { return parse_int(text, 1, kMaxPlays); }
int parse_start(const std::string& text) { return parse_int(text, 0, kMaxStartNumber); }

EncoderSettings settings_of(const OptionTexts& options) {
  EncoderSettings settings{.crf = options.value("--crf", parse_crf),
                           .preset = options.text("--preset"),
                           .encoder = options.text("--encoder"),
                           .start_number = options.value("--start-number", parse_start),
                           .plays = options.value("--plays", parse_plays)};
  if (!options.is_given("--smallest")) return settings;
  for (const char* option : {"--crf", "--preset", "--encoder"}) {
    if (!options.is_given(option)) continue;
    throw UsageError(
        fmt::format("--smallest chooses the encoder and its settings; leave out {}", option));
  }
  set_smallest(settings);
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

/// What --for names; null if it is not given. @throws UsageError if it does not suit the output.
const Destination* destination_of(const OptionTexts& options, const std::string& output) {
  const auto found =
      options.value("--for", [](const std::string& name) { return &parse_destination(name); });
  if (!found) return nullptr;
  check_ending(**found, output);
  return *found;
}

}  // namespace

RenderJob job_of(const OptionTexts& options, const std::string& output,
                 const MakeScript& make_script) {
  const Destination* const destination = destination_of(options, output);
  EncoderSettings settings = settings_of(options);
  Script script = destination == nullptr ? make_script({}, {})
                                         : make_script(destination->defaults,
                                                       fmt::format("--for {}", destination->name));
  if (destination != nullptr && !settings.encoder && has_ending(output, ".mov")) {
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
      .jobs = options.value("--jobs", parse_jobs).value_or(std::min(processor_count(), kMaxJobs)),
      .shard = options.value("--part", parse_part),
      .profile = options.is_given("--profile"),
      .bundle = bundle_of(options),
      .captions_inside = options.value("--captions", parse_captions).value_or(false),
      .max_flashes = options.value("--max-flashes", parse_flashes),
      .overwrite = options.is_given("--overwrite"),
      .resume = options.is_given("--resume"),
      .frames = options.value("--frames", parse_frames)};
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
