#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/render.hpp>

#include <algorithm>
#include <filesystem>
#include <thread>
#include <utility>

#include "cli/commands.hpp"
#include "cli/convention_note.hpp"
#include "cli/destinations.hpp"
#include "cli/limits.hpp"
#include "cli/options.hpp"
#include "cli/profile_report.hpp"
#include "cli/progress.hpp"
#include "cli/refuse_terminal.hpp"
#include "cli/scene_options.hpp"
#include "cli/stop_on_signals.hpp"
#include "core/ending.hpp"
#include "core/overwrite_check.hpp"
#include "media/output/outputs.hpp"
#include "render/bundle.hpp"

namespace piblocks::cli {
namespace {

struct RenderOptions {
  SceneOptions scene;
  Option output;
  Option destination;
  Option crf;
  Option preset;
  Option encoder;
  Option smallest;
  Option jobs;
  Option part;
  Option profile;
  Option quiet;
  Option bundle;
  Option poster;
  Option max_flashes;
};

int parse_jobs(const std::string& text) {
  return static_cast<int>(parse_whole_number(text, 1, Integer(kMaxJobs)).get_si());
}

int parse_flashes(const std::string& text) {
  return static_cast<int>(parse_whole_number(text, 1, Integer(kMaxFlashes)).get_si());
}

/// "2/3", the second of three.
Part parse_part(const std::string& text) {
  const std::size_t slash = text.find('/');
  if (slash == std::string::npos) throw UsageError("must be I/N, such as 2/3");
  const Integer count = parse_whole_number(text.substr(slash + 1), 1, Integer(kMaxParts));
  const Integer number = parse_whole_number(text.substr(0, slash), 1, count);
  return {static_cast<int>(number.get_si()), static_cast<int>(count.get_si())};
}

double parse_crf(const std::string& text) { return to_double(parse_rational(text)); }

/// Under half the size, and many times the time (src/media/README.md).
EncoderSettings smallest_file() { return {.crf = 18, .preset = "slower", .encoder = "libx264"}; }

EncoderSettings settings_of(const RenderOptions& options) {
  if (!options.smallest.is_given()) {
    return {value_of(options.crf, parse_crf), options.preset.text(), options.encoder.text()};
  }
  for (const Option& option : {options.crf, options.preset, options.encoder}) {
    if (!option.is_given()) continue;
    throw UsageError(fmt::format("--smallest chooses the encoder and its settings; leave out {}",
                                 option.name()));
  }
  return smallest_file();
}

std::optional<Bundle> bundle_of(const RenderOptions& options) {
  const auto poster = value_of(options.poster, parse_instant);
  if (const auto folder = options.bundle.text()) return Bundle{*folder, poster};
  if (!poster) return std::nullopt;
  throw UsageError("--poster is for a bundle; add --bundle DIR or leave it out");
}

const Destination* destination_of(const RenderOptions& options) {
  const auto found = value_of(options.destination,
                              [](const std::string& name) { return &parse_destination(name); });
  if (!found) return nullptr;
  check_ending(**found, *options.output.text());
  return *found;
}

/// With the settings that suit the destination.
RenderJob job_of(const RenderOptions& options) {
  const unsigned processors = std::max(1U, std::thread::hardware_concurrency());
  const Destination* const destination = destination_of(options);
  const std::string output = *options.output.text();
  EncoderSettings settings = settings_of(options);
  Script script =
      destination == nullptr
          ? options.scene.script()
          : options.scene.script(destination->defaults, fmt::format("--for {}", destination->name));
  if (destination != nullptr && !settings.encoder && has_ending(output, ".mov")) {
    settings.encoder = destination->mov_encoder;
  }
  return {std::move(script),
          output,
          std::move(settings),
          value_of(options.jobs, parse_jobs).value_or(static_cast<int>(processors)),
          value_of(options.part, parse_part),
          options.profile.is_given(),
          bundle_of(options),
          value_of(options.max_flashes, parse_flashes)};
}

/// What is written, for messages.
std::string name_of(const RenderJob& job) {
  if (job.bundle) return std::filesystem::path(job.bundle->folder) / job.output;
  return job.part ? part_name(job.output, *job.part) : job.output;
}

/// @throws UsageError if the job would write over a file that it reads.
void check_outputs(const RenderOptions& options, const RenderJob& job) {
  OverwriteCheck check;
  options.scene.add_inputs(check, job.script);
  if (job.bundle) {
    for (const std::string& file : bundle_files(job)) {
      check.writes("--bundle", std::filesystem::path(job.bundle->folder) / file);
    }
  } else if (job.part) {
    check.writes("--part", part_name(job.output, *job.part));
  } else {
    claim_output(check, "--output", job.output);
  }
  check.check();
}

void run(const RenderOptions& options) {
  refuse_terminal(options.output);
  options.scene.refuse_silence(options.output);
  const RenderJob job = job_of(options);
  check_outputs(options, job);
  const bool quiet = options.quiet.is_given();
  const StopOnSignals signals;
  ProgressReport report(name_of(job), quiet);
  const Rendered rendered = render(
      job, [&](const Progress& progress) { report.update(progress); }, signals.token());
  report.finish();
  if (job.profile) print_profile(rendered);
  if (!quiet) note_convention(job.script);
}

RenderOptions add_options(Command& command) {
  SceneOptions scene(command);
  const Option output =
      command.add_required_value("-o,--output", "OUT",
                                 "What to write: NAME.mp4, NAME.mov, NAME.webm, NAME.gif,\n"
                                 "NAME.apng, FRAMES/%06d.png, NAME.y4m, - (y4m on standard\n"
                                 "output), NAME.framehash, null, NAME.wav: the sound alone, or\n"
                                 "NAME.html: a page to step through time and collisions");
  const Option destination = command.add_value(
      "--for", "WHERE", "Size, rate and background that suit one of:\n" + destination_names());
  scene.add_picture();
  scene.add_show();
  scene.add_exposure();
  scene.add_timing();
  scene.add_sound();
  const Option crf =
      command.add_value("--crf", "Q", "Rate factor, 1 (best) to 51 (worst); 0 to 63 for WebM");
  const Option preset =
      command.add_value("--preset", "P", "The encoder's speed preset, such as veryfast");
  const Option encoder =
      command.add_value("--encoder", "NAME", "Video encoder; 'piblocks info' lists them");
  const Option smallest = command.add_flag(
      "--smallest", "Smallest MP4, by libx264: under half the size, and many\ntimes the time");
  const Option jobs = command.add_value(
      "--jobs", "N", "Threads (default: one a processor); changes no byte of the output");
  const Option part = command.add_value(
      "--part", "I/N", "Render the I-th of N shares to OUT.part-I-of-N,\nfor 'piblocks join'");
  const Option bundle =
      command.add_value("--bundle", "DIR",
                        "Write OUT, an MP4, into DIR, with a poster, captions, alt text\n"
                        "and snippets for LaTeX beamer and reveal.js beside it");
  const Option poster =
      command.add_value("--poster", "T", "Instant that the poster shows (default: the last frame)");
  const Option max_flashes =
      command.add_value("--max-flashes", "N",
                        "Render nothing if the film would flash more than N times\n"
                        "within a second; 3 are held to be harmless (WCAG 2.3.1)");
  const Option profile =
      command.add_flag("--profile", "Print what each stage cost, on standard error");
  const Option quiet = command.add_flag("--quiet", "Print nothing but errors");
  return {.scene = scene,
          .output = output,
          .destination = destination,
          .crf = crf,
          .preset = preset,
          .encoder = encoder,
          .smallest = smallest,
          .jobs = jobs,
          .part = part,
          .profile = profile,
          .quiet = quiet,
          .bundle = bundle,
          .poster = poster,
          .max_flashes = max_flashes};
}

}  // namespace

void add_render(Command& app) {
  Command command = app.add_command("render", "Render a video or a sequence of frames");
  const RenderOptions options = add_options(command);
  command.set_footer(
      "Examples:\n"
      "  piblocks render -o pi.mp4\n"
      "  piblocks render --digits 5 --speed 1/2 --size 1280x720 -o frames/%06d.png\n"
      "  piblocks render scene.toml --to last+3 -o - | ffplay -");
  command.on_run([options] { run(options); });
}

}  // namespace piblocks::cli
