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
  const CLI::Option* frames;
  const CLI::Option* at;
  const CLI::Option* output;
};

int parse_count(const std::string& text) {
  return static_cast<int>(parse_whole_number(text, 1, Integer(kMaxSheetPictures)).get_si());
}

void run(const SheetOptions& options) {
  refuse_terminal(*options.output);
  if (options.frames->count() > 0 && options.at->count() > 0) {
    throw UsageError("--frames and --at both say which instants are shown; give one of them");
  }
  const Scene scene = options.scene.scene();
  options.scene.refuse_as_output(*options.output, scene);
  const auto named = value_of(*options.at, parse_instants);
  const int count = value_of(*options.frames, parse_count).value_or(kUsualCount);
  const StopOnSignals signals;
  render_sheet(scene, named ? *named : spread_instants(scene, count), *text_of(*options.output),
               signals.token());
  note_convention(scene.system);
}

}  // namespace

void add_sheet(CLI::App& app) {
  CLI::App* command = app.add_subcommand("sheet", "Render several instants on one page, for paper");
  SceneOptions scene(*command);
  const CLI::Option* frames = &add_value_option(
      *command, "--frames", "N", "So many instants, spread over the run (default 12)");
  const CLI::Option* at = &add_value_option(*command, "--at", "T[,T...]",
                                            "Or these instants: 3.5, turn-0.3, last+1, '#314'");
  const CLI::Option* output =
      add_value_option(*command, "-o,--output", "OUT",
                       "NAME.pdf, NAME.png, NAME.svg, or - (PNG on standard output)")
          .required();
  scene.add_size();
  scene.add_show();
  scene.add_span();
  command->footer(
      "Examples:\n"
      "  piblocks sheet -o sheet.pdf\n"
      "  piblocks sheet --digits 2 --at '0,#1,#10,#20,last' -o collisions.svg");
  const SheetOptions options{scene, frames, at, output};
  command->callback([options] { run(options); });
}

}  // namespace piblocks::cli
