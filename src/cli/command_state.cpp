#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/instant.hpp>
#include <piblocks/run.hpp>

#include <optional>
#include <string>
#include <vector>

#include "cli/commands.hpp"
#include "cli/options.hpp"
#include "cli/scene_options.hpp"
#include "cli/text_output.hpp"

namespace piblocks::cli {
namespace {

/// @throws UsageError if the engine cannot say.
PositionBounds bounds_at(const CollisionLog& log, const Rational& time) {
  if (const auto bounds = position_bounds(log, time)) return *bounds;
  throw UsageError(
      "--bounds: engines that step cannot say how exact they are; use --engine unfolded");
}

std::string described(const Motion& motion, const std::optional<double>& position_bound) {
  const std::string bound =
      position_bound ? fmt::format(R"(,"position_bound":{})", shown(*position_bound)) : "";
  return fmt::format(R"({{"position":{}{},"velocity":{}}})", shown(motion.position), bound,
                     shown(motion.velocity));
}

void write(const Rational& time, const BlockState& state,
           const std::optional<PositionBounds>& bounds, TextOutput& out) {
  const auto blue_bound = bounds ? std::optional(bounds->blue) : std::nullopt;
  const auto red_bound = bounds ? std::optional(bounds->red) : std::nullopt;
  out.format_line(R"({{"time":{},"collisions":"{}","blue":{},"red":{}}})", shown(to_double(time)),
                  state.count.get_str(), described(state.blue, blue_bound),
                  described(state.red, red_bound));
}

void run_state(const Command& options, const SceneOptions& scene_options) {
  const std::vector<Instant> instants = *options.value("--at", parse_instants);
  const Scene scene = scene_options.scene();
  const auto log = make_log(scene.system, options);
  TextOutput out("-");
  for (const Instant& instant : instants) {
    const Rational time = time_of(instant, *log);
    std::optional<PositionBounds> bounds;
    if (options.is_given("--bounds")) bounds = bounds_at(*log, time);
    write(time, log->state_at(time), bounds, out);
  }
  out.finish();
  note_convention(scene);
}

}  // namespace

void add_state(Command& app) {
  Command command =
      app.add_command("state", "Print positions, velocities and count, one JSON object a line");
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

}  // namespace piblocks::cli
