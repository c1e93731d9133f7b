#include "cli/commands.hpp"
#include "cli/convention_note.hpp"
#include "cli/scene_options.hpp"
#include "cli/text_output.hpp"

namespace piblocks::cli {

void add_count(Command& app) {
  Command command = app.add_command("count", "Print the total number of collisions");
  const SceneOptions scene(command);
  command.set_footer(
      "Examples:\n"
      "  piblocks count --digits 12\n"
      "  piblocks count --mass-ratio 1/3");
  command.on_run([scene] {
    TextOutput out("-");
    const BlockSystem system = scene.scene().system;
    out.line(count_collisions(system).get_str());
    out.finish();
    note_convention(system);
  });
}

}  // namespace piblocks::cli
