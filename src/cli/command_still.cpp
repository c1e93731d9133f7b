#include <piblocks/render.hpp>

#include "cli/commands.hpp"
#include "cli/options.hpp"
#include "cli/scene_options.hpp"
#include "cli/stop_on_signals.hpp"

namespace piblocks::cli {
namespace {

void run_still(const Command& options, const SceneOptions& scene_options) {
  refuse_terminal(options);
  const Script script = scene_options.script();
  scene_options.check_output(script);
  const StopOnSignals signals;
  render_still(script, *options.value("--at", parse_instant), output_of(options), signals.token());
  note_convention(script);
}

}  // namespace

void add_still(Command& app) {
  Command command = app.add_command("still", "Render one instant as a picture");
  SceneOptions scene(command);
  command.add_required_value("--at", "T",
                             "Instant: a time, 'turn', 'last', or '#K' for collision K; an\n"
                             "offset may follow, as in turn-0.3 and last+1. Of a storyboard:\n"
                             "a second of its video, or 'last' for its last frame");
  command.add_required_value("-o,--output", "OUT",
                             "NAME.png, NAME.svg, NAME.pdf, or - (PNG on standard output)");
  scene.add_picture();
  scene.add_show();
  scene.add_exposure();
  command.set_footer(
      "Examples:\n"
      "  piblocks still --at 3.5 -o turn.svg\n"
      "  piblocks still scene.toml --at '#10' --size 640x360 -o tenth.png");
  command.on_run([=] { run_still(command, scene); });
}

}  // namespace piblocks::cli
