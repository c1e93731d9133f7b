#include <fmt/format.h>
#include <piblocks/render.hpp>

#include <chrono>
#include <cstdio>
#include <memory>
#include <thread>

#include "cli/commands.hpp"
#include "cli/progress.hpp"
#include "cli/scene_options.hpp"

namespace piblocks::cli {
namespace {

struct RenderOptions {
  SceneOptions scene;
  std::string output;
  EncoderSettings encoder;
  int jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  bool quiet = false;
};

void add_encoder_options(CLI::App& command, EncoderSettings& encoder) {
  command.add_option("--crf", encoder.crf, "Video quality, 0 (lossless) to 51 (worst)")
      ->type_name("Q");
  command.add_option("--preset", encoder.preset, "The encoder's speed preset, such as veryfast")
      ->type_name("P");
  command.add_option("--encoder", encoder.encoder, "Video encoder; 'piblocks info' lists them")
      ->type_name("NAME");
}

void run(const RenderOptions& options, const std::stop_token& stop) {
  const RenderJob job{options.scene.scene(), options.output, options.encoder, options.jobs};
  ProgressReport report(options.output, options.quiet);
  render(
      job, [&](const Progress& progress) { report.update(progress); }, stop);
  report.finish();
}

}  // namespace

void add_render(CLI::App& app, const std::stop_token& stop) {
  CLI::App* command = app.add_subcommand("render", "Render a video or a sequence of frames");
  auto options = std::make_shared<RenderOptions>();
  options->scene.add_system(*command);
  command
      ->add_option("-o,--output", options->output,
                   "What to write: NAME.mp4, FRAMES/%06d.png, NAME.y4m, - (y4m on standard "
                   "output), NAME.framehash, or null")
      ->required()
      ->type_name("OUT");
  options->scene.add_size(*command);
  options->scene.add_timing(*command);
  add_encoder_options(*command, options->encoder);
  constexpr int kMaxJobs = 256;
  command->add_option("--jobs", options->jobs, "Threads (default: one a processor)")
      ->check(CLI::Range(1, kMaxJobs))
      ->type_name("N");
  command->add_flag("--quiet", options->quiet, "Print nothing but errors");
  command->callback([options, stop] { run(*options, stop); });
}

}  // namespace piblocks::cli
