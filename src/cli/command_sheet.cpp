#include <piblocks/render.hpp>

#include "cli/commands.hpp"
#include "cli/convention_note.hpp"
#include "cli/instant_list.hpp"
#include "cli/options.hpp"
#include "cli/refuse_terminal.hpp"
#include "cli/scene_options.hpp"
#include "cli/stop_on_signals.hpp"

namespace piblocks::cli {
namespace {

constexpr int kUsualCount = 12;

struct SheetOptions {
  SceneOptions scene;
  Option frames;
  Option at;
  Option output;
};

int parse_count(const std::string& text) {
  return static_cast<int>(parse_whole_number(text, 1, Integer(kMaxSheetPictures)).get_si());
}

void run(const SheetOptions& options) {
  refuse_terminal(options.output);
  if (options.frames.is_given() && options.at.is_given()) {
    throw UsageError("--frames and --at both say which instants are shown; give one of them");
  }
  const Scene scene = options.scene.scene();
  options.scene.refuse_as_output(options.output, scene);
  const auto named = value_of(options.at, parse_instants);
  const int count = value_of(options.frames, parse_count).value_or(kUsualCount);
  const StopOnSignals signals;
  render_sheet(scene, named ? *named : spread_instants(scene, count), *options.output.text(),
               signals.token());
  note_convention(scene.system);
}

}  // namespace

void add_sheet(Command& app) {
  Command command = app.add_command("sheet", "Render several instants on one page, for paper");
  SceneOptions scene(command);
  const Option frames =
      command.add_value("--frames", "N", "So many instants, spread over the run (default 12)");
  const Option at =
      command.add_value("--at", "T[,T...]", "Or these instants: 3.5, turn-0.3, last+1, '#314'");
  const Option output = command.add_required_value(
      "-o,--output", "OUT", "NAME.pdf, NAME.png, NAME.svg, or - (PNG on standard output)");
  scene.add_size();
  scene.add_show();
  scene.add_span();
  command.set_footer(
      "Examples:\n"
      "  piblocks sheet -o sheet.pdf\n"
      "  piblocks sheet --digits 2 --at '0,#1,#10,#20,last' -o collisions.svg");
  const SheetOptions options{scene, frames, at, output};
  command.on_run([options] { run(options); });
}

}  // namespace piblocks::cli
