#include <piblocks/render.hpp>

#include "cli/commands.hpp"
#include "cli/options.hpp"
#include "cli/scene_options.hpp"
#include "cli/stop_on_signals.hpp"

namespace piblocks::cli {
namespace {

int parse_count(const std::string& text) { return parse_int(text, 1, kMaxSheetPictures); }

void run_sheet(const Command& options, const SceneOptions& scene_options) {
  constexpr int kUsualCount = 12;
  refuse_terminal(options);
  if (options.is_given("--frames") && options.is_given("--at")) {
    throw UsageError("--frames and --at both say which instants are shown; give one of them");
  }
  const Scene scene = scene_options.scene();
  scene_options.check_output(scene);
  const auto named = options.value("--at", parse_instants);
  const int count = options.value("--frames", parse_count).value_or(kUsualCount);
  const StopOnSignals signals;
  render_sheet(scene, named ? *named : spread_instants(scene, count), output_of(options),
               signals.token());
  note_convention(scene);
}

}  // namespace

void add_sheet(Command& app) {
  Command command = app.add_command("sheet", "Render several instants on one page, for paper");
  SceneOptions scene(command);
  command.add_value("--frames", "N", "So many instants, spread over the run (default 12)");
  command.add_value("--at", "T[,T...]", "Or these instants: 3.5, turn-0.3, last+1, '#314'");
  command.add_required_value("-o,--output", "OUT",
                             "NAME.pdf, NAME.png, NAME.svg, or - (PNG on standard output)");
  scene.add_size();
  scene.add_show();
  scene.add_span();
  command.set_footer(
      "Examples:\n"
      "  piblocks sheet -o sheet.pdf\n"
      "  piblocks sheet --digits 2 --at '0,#1,#10,#20,last' -o collisions.svg");
  command.on_run([=] { run_sheet(command, scene); });
}

}  // namespace piblocks::cli
