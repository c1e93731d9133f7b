#include <piblocks/render.hpp>

#include <memory>

#include "cli/commands.hpp"
#include "cli/scene_options.hpp"

namespace piblocks::cli {
namespace {

struct StillOptions {
  SceneOptions scene;
  std::string instant;
  std::string output;
};

void run(const StillOptions& options) {
  const Instant instant = parse_option("--at", options.instant, parse_instant);
  render_still(options.scene.scene(), instant, options.output);
}

}  // namespace

void add_still(CLI::App& app) {
  CLI::App* command = app.add_subcommand("still", "Render one instant as a picture");
  auto options = std::make_shared<StillOptions>();
  options->scene.add_system(*command);
  command
      ->add_option("--at", options->instant,
                   "Instant: a time, 'last', or '#K', that of the K-th collision")
      ->required()
      ->type_name("S|last|#K");
  command
      ->add_option("-o,--output", options->output,
                   "NAME.png, NAME.svg, NAME.pdf, or - (PNG on standard output)")
      ->required()
      ->type_name("OUT");
  options->scene.add_size(*command);
  command->callback([options] { run(*options); });
}

}  // namespace piblocks::cli
