#include <piblocks/render.hpp>

#include "cli/commands.hpp"
#include "cli/convention_note.hpp"
#include "cli/options.hpp"
#include "cli/refuse_terminal.hpp"
#include "cli/scene_options.hpp"
#include "cli/stop_on_signals.hpp"

namespace piblocks::cli {

void add_still(CLI::App& app) {
  CLI::App* command = app.add_subcommand("still", "Render one instant as a picture");
  SceneOptions scene(*command);
  const CLI::Option* instant =
      add_value_option(*command, "--at", "T",
                       "Instant: a time, 'turn', 'last', or '#K' for collision K; an\n"
                       "offset may follow, as in turn-0.3 and last+1. Of a storyboard:\n"
                       "a second of its video, or 'last' for its last frame")
          .required();
  const CLI::Option* output =
      add_value_option(*command, "-o,--output", "OUT",
                       "NAME.png, NAME.svg, NAME.pdf, or - (PNG on standard output)")
          .required();
  scene.add_picture();
  scene.add_show();
  scene.add_exposure();
  command->footer(
      "Examples:\n"
      "  piblocks still --at 3.5 -o turn.svg\n"
      "  piblocks still scene.toml --at '#10' --size 640x360 -o tenth.png");
  command->callback([=] {
    refuse_terminal(*output);
    const Script shown = scene.script();
    scene.refuse_as_output(*output, shown);
    const StopOnSignals signals;
    render_still(shown, *value_of(*instant, parse_instant), *text_of(*output), signals.token());
    note_convention(shown);
  });
}

}  // namespace piblocks::cli
