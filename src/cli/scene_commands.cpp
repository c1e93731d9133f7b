#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/instant.hpp>
#include <piblocks/render.hpp>
#include <piblocks/two_blocks.hpp>

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/command.hpp"
#include "cli/options.hpp"
#include "cli/progress.hpp"
#include "cli/scene_options.hpp"
#include "cli/stop_on_signals.hpp"
#include "cli/text_output.hpp"
#include "scene/run_log.hpp"
#include "scene/run_tables.hpp"

namespace piblocks::cli {
namespace {

/// All collisions, or those until --to; of two blocks and a wall all are counted without a log.
void run_count(const Command& options, const SceneOptions& scene_options) {
  TextOutput out;
  const Scene scene = scene_options.scene();
  const std::optional<Instant> to = options.value("--to", parse_instant);
  std::unique_ptr<Log> log;
  std::optional<Rational> until;
  Integer count;
  if (to || !two_blocks_of(scene.system)) {
    log = log_of(scene);
    until = to ? std::optional(time_of(*to, *log)) : log->horizon();
    count = until ? log->count_at(*until) : log->last();
  }
  if (log) {
    require_finite_count(*log, until);
    require_certain(scene, *log, until);
  } else {
    count = count_collisions(scene.system);
  }
  out.line(count.get_str(scene.show.base));
  out.finish();
  if (log) note_ties(*log, count);
  if (log && log->never_ends() && !to) {
    say("piblocks: note: collisions may go on for ever; these are the ones until time.to = {}\n",
        exact_text(scene.time.to));
  }
  note_convention(scene);
}

void run_state(const Command& options, const SceneOptions& scene_options) {
  const std::vector<Instant> instants = *options.value("--at", parse_instants);
  const Scene scene = scene_options.scene();
  const bool has_bounds = options.is_given("--bounds");
  const Table states = state_table(scene.system, has_bounds);
  const std::unique_ptr<Log> log = make_log(scene, options);
  TextOutput out;
  Integer last = 0;
  for (const Instant& instant : instants) {
    const Rational time = time_of(instant, *log);
    require_certain(scene, *log, time);
    const StateRow state = state_row(*log, time, has_bounds);
    last = std::max(last, state.count);
    out.line(state_text(states, state));
  }
  out.finish();
  note_ties(*log, last);
  note_convention(scene);
}

void run_still(const Command& options, const SceneOptions& scene_options) {
  refuse_terminal(options);
  const Script script = scene_options.script();
  scene_options.check_output(script);
  const StopOnSignals signals;
  const std::string output = output_of(options);
  note_all(render_still(script, *options.value("--at", parse_instant), output, signals.token()));
  note_convention(script);
  note_contrast(script);
  if (has_ending(output, ".svg") || has_ending(output, ".pdf")) note_sharp(script);
}

void run_sheet(const Command& options, const SceneOptions& scene_options) {
  refuse_terminal(options);
  const Scene scene = scene_options.scene();
  scene_options.check_output(scene);
  const SheetInstants instants = sheet_instants(options);
  const StopOnSignals signals;
  ProgressReport report(output_of(options), false,
                        {.unit = "pictures", .delay = std::chrono::seconds(1)});
  note_all(render_sheet(
      scene, instants, output_of(options),
      [&](const Progress& progress) { report.update(progress); }, signals.token()));
  note_convention(scene);
  note_contrast(scene);
  note_sharp(scene);
}

}  // namespace

void define_count(Command& command) {
  SceneOptions options(command);
  command.add_value("--to", "T",
                    "Count collisions until then (default: all; needed where they\nnever end)");
  command.set_footer(
      "Examples:\n"
      "  piblocks count --digits 12\n"
      "  piblocks count --digits 12 --base 2\n"
      "  piblocks count --mass-ratio 1/3");
  command.on_run([=] { run_count(command, options); });
}

void define_state(Command& command) {
  const SceneOptions scene(command);
  command.add_required_value("--at", "T[,T...]", "Instants: 3.5, turn-0.3, last+1, '#314'");
  command.add_flag("--bounds",
                   "Add position_bound: how far a position may be from the truth at most");
  add_engine(command);
  command.set_footer(
      "Examples:\n"
      "  piblocks state --at 0,3.5,last\n"
      "  piblocks state --digits 20 --at '#15707963267948966192' --bounds");
  command.on_run([=] { run_state(command, scene); });
}

void define_still(Command& command) {
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

void define_sheet(Command& command) {
  SceneOptions scene(command);
  command.add_value("--frames", "N", "So many instants, spread over the run (default 12)");
  command.add_value("--by", "WHAT",
                    "Spread them evenly by 'count' of collisions or by 'time'\n"
                    "(default: by count if the turn is shown and no two pictures\n"
                    "would have the same count; otherwise by time)");
  command.add_value("--at", "T[,T...]", "Or these instants: 3.5, turn-0.3, last+1, '#314'");
  command.add_required_value("-o,--output", "OUT",
                             "NAME.pdf, NAME.png, NAME.svg, or - (PNG on standard output)");
  scene.add_size();
  scene.add_show();
  scene.add_span();
  command.set_footer(
      "Examples:\n"
      "  piblocks sheet -o sheet.pdf\n"
      "  piblocks sheet --digits 2 --frames 32 --by count -o every-collision.pdf\n"
      "  piblocks sheet --digits 2 --at '0,#1,#10,#20,last' -o collisions.svg");
  command.on_run([=] { run_sheet(command, scene); });
}

}  // namespace piblocks::cli
