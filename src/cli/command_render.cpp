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
#include "media/claim_output.hpp"
#include "render/bundle.hpp"

namespace piblocks::cli {
namespace {

struct RenderOptions {
  SceneOptions scene;
  const CLI::Option* output;
  const CLI::Option* destination;
  const CLI::Option* crf;
  const CLI::Option* preset;
  const CLI::Option* encoder;
  const CLI::Option* smallest;
  const CLI::Option* jobs;
  const CLI::Option* part;
  const CLI::Option* profile;
  const CLI::Option* quiet;
  const CLI::Option* bundle;
  const CLI::Option* poster;
  const CLI::Option* max_flashes;
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
  if (options.smallest->count() == 0) {
    return {value_of(*options.crf, parse_crf), text_of(*options.preset), text_of(*options.encoder)};
  }
  for (const CLI::Option* option : {options.crf, options.preset, options.encoder}) {
    if (option->count() == 0) continue;
    throw UsageError(fmt::format("--smallest chooses the encoder and its settings; leave out {}",
                                 option->get_name()));
  }
  return smallest_file();
}

std::optional<Bundle> bundle_of(const RenderOptions& options) {
  const auto poster = value_of(*options.poster, parse_instant);
  if (const auto folder = text_of(*options.bundle)) return Bundle{*folder, poster};
  if (!poster) return std::nullopt;
  throw UsageError("--poster is for a bundle; add --bundle DIR or leave it out");
}

const Destination* destination_of(const RenderOptions& options) {
  const auto found = value_of(*options.destination,
                              [](const std::string& name) { return &parse_destination(name); });
  if (!found) return nullptr;
  check_ending(**found, *text_of(*options.output));
  return *found;
}

/// With the settings that suit the destination.
RenderJob job_of(const RenderOptions& options) {
  const unsigned processors = std::max(1U, std::thread::hardware_concurrency());
  const Destination* const destination = destination_of(options);
  const std::string output = *text_of(*options.output);
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
          value_of(*options.jobs, parse_jobs).value_or(static_cast<int>(processors)),
          value_of(*options.part, parse_part),
          options.profile->count() > 0,
          bundle_of(options),
          value_of(*options.max_flashes, parse_flashes)};
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
  refuse_terminal(*options.output);
  options.scene.refuse_silence(*options.output);
  const RenderJob job = job_of(options);
  check_outputs(options, job);
  const bool quiet = options.quiet->count() > 0;
  const StopOnSignals signals;
  ProgressReport report(name_of(job), quiet);
  const Rendered rendered = render(
      job, [&](const Progress& progress) { report.update(progress); }, signals.token());
  report.finish();
  if (job.profile) print_profile(rendered);
  if (!quiet) note_convention(job.script);
}

RenderOptions add_options(CLI::App& command) {
  SceneOptions scene(command);
  const CLI::Option& output =
      *add_value_option(command, "-o,--output", "OUT",
                        "What to write: NAME.mp4, NAME.mov, NAME.webm, NAME.gif,\n"
                        "NAME.apng, FRAMES/%06d.png, NAME.y4m, - (y4m on standard\n"
                        "output), NAME.framehash, null, NAME.wav: the sound alone, or\n"
                        "NAME.html: a page to step through time and collisions")
           .required();
  const CLI::Option& destination =
      add_value_option(command, "--for", "WHERE",
                       "Size, rate and background that suit one of:\n" + destination_names());
  scene.add_picture();
  scene.add_show();
  scene.add_exposure();
  scene.add_timing();
  scene.add_sound();
  const CLI::Option& crf = add_value_option(
      command, "--crf", "Q", "Rate factor, 1 (best) to 51 (worst); 0 to 63 for WebM");
  const CLI::Option& preset =
      add_value_option(command, "--preset", "P", "The encoder's speed preset, such as veryfast");
  const CLI::Option& encoder =
      add_value_option(command, "--encoder", "NAME", "Video encoder; 'piblocks info' lists them");
  const CLI::Option& smallest =
      *command.add_flag("--smallest")
           ->description("Smallest MP4, by libx264: under half the size, and many\ntimes the time");
  const CLI::Option& jobs = add_value_option(
      command, "--jobs", "N", "Threads (default: one a processor); changes no byte of the output");
  const CLI::Option& part =
      add_value_option(command, "--part", "I/N",
                       "Render the I-th of N shares to OUT.part-I-of-N,\nfor 'piblocks join'");
  const CLI::Option& bundle =
      add_value_option(command, "--bundle", "DIR",
                       "Write OUT, an MP4, into DIR, with a poster, captions, alt text\n"
                       "and snippets for LaTeX beamer and reveal.js beside it");
  const CLI::Option& poster = add_value_option(
      command, "--poster", "T", "Instant that the poster shows (default: the last frame)");
  const CLI::Option& max_flashes =
      add_value_option(command, "--max-flashes", "N",
                       "Render nothing if the film would flash more than N times\n"
                       "within a second; 3 are held to be harmless (WCAG 2.3.1)");
  const CLI::Option& profile =
      *command.add_flag("--profile")->description("Print what each stage cost, on standard error");
  const CLI::Option& quiet = *command.add_flag("--quiet")->description("Print nothing but errors");
  return {scene, &output, &destination, &crf,   &preset, &encoder, &smallest,
          &jobs, &part,   &profile,     &quiet, &bundle, &poster,  &max_flashes};
}

}  // namespace

void add_render(CLI::App& app) {
  CLI::App* command = app.add_subcommand("render", "Render a video or a sequence of frames");
  const RenderOptions options = add_options(*command);
  command->footer(
      "Examples:\n"
      "  piblocks render -o pi.mp4\n"
      "  piblocks render --digits 5 --speed 1/2 --size 1280x720 -o frames/%06d.png\n"
      "  piblocks render scene.toml --to last+3 -o - | ffplay -");
  command->callback([options] { run(options); });
}

}  // namespace piblocks::cli
