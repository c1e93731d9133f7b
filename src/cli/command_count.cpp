#include "cli/commands.hpp"
#include "cli/convention_note.hpp"
#include "cli/scene_options.hpp"
#include "cli/text_output.hpp"

namespace piblocks::cli {

void add_count(CLI::App& app) {
  CLI::App* command = app.add_subcommand("count", "Print the total number of collisions");
  const SceneOptions scene(*command);
  command->footer(
      "Examples:\n"
      "  piblocks count --digits 12\n"
      "  piblocks count --mass-ratio 1/3");
  command->callback([scene] {
    TextOutput out("-");
    const BlockSystem system = scene.scene().system;
    out.line(count_collisions(system).get_str());
    out.finish();
    note_convention(system);
  });
}

}  // namespace piblocks::cli
