#include <fmt/format.h>
#include <piblocks/instant.hpp>

#include <memory>
#include <vector>

#include "cli/commands.hpp"
#include "cli/scene_options.hpp"
#include "cli/text_output.hpp"

namespace piblocks::cli {
namespace {

struct StateOptions {
  SceneOptions scene;
  std::vector<std::string> instants;
  Engine engine = Engine::unfolded;
};

void run(const StateOptions& options) {
  std::vector<Instant> instants;
  for (const std::string& text : options.instants) {
    instants.push_back(parse_option("--at", text, parse_instant));
  }
  const auto log = make_collision_log(options.scene.scene().system, options.engine);
  TextOutput out("-");
  for (const Instant& instant : instants) {
    const auto [time, state] = state_at(*log, instant);
    out.format_line(R"({{"time":{},"collisions":"{}","blue":{{"position":{},"velocity":{}}},)"
                    R"("red":{{"position":{},"velocity":{}}}}})",
                    time.hi, state.count.get_str(), state.blue.position, state.blue.velocity,
                    state.red.position, state.red.velocity);
  }
  out.finish();
}

}  // namespace

void add_state(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("state", "Print positions, velocities and count, one JSON object a line");
  auto options = std::make_shared<StateOptions>();
  options->scene.add_system(*command);
  command
      ->add_option("--at", options->instants,
                   "Instants, separated by commas: times, 'last', or '#K'")
      ->required()
      ->delimiter(',')
      ->type_name("S[,S...]");
  add_engine(*command, options->engine);
  command->callback([options] { run(*options); });
}

}  // namespace piblocks::cli
