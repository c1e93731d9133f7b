#include <fmt/format.h>

#include <memory>

#include "cli/commands.hpp"
#include "cli/scene_options.hpp"
#include "cli/text_output.hpp"

namespace piblocks::cli {

void add_count(CLI::App& app) {
  CLI::App* command = app.add_subcommand("count", "Print the total number of collisions");
  auto options = std::make_shared<SceneOptions>();
  options->add_system(*command);
  command->callback([options] {
    TextOutput out("-");
    out.line(count_collisions(options->scene().system).get_str());
    out.finish();
  });
}

}  // namespace piblocks::cli
