#include "cli/commands.hpp"
#include "cli/scene_options.hpp"
#include "cli/text_output.hpp"

namespace piblocks::cli {

void add_count(Command& app) {
  Command command = app.add_command("count", "Print the total number of collisions");
  const SceneOptions options(command);
  command.set_footer(
      "Examples:\n"
      "  piblocks count --digits 12\n"
      "  piblocks count --mass-ratio 1/3");
  command.on_run([options] {
    TextOutput out("-");
    const Scene scene = options.scene();
    out.line(count_collisions(scene.system).get_str());
    out.finish();
    note_convention(scene);
  });
}

}  // namespace piblocks::cli
