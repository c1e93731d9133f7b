#include <piblocks/instant.hpp>

#include <algorithm>
#include <string>
#include <vector>

#include "cli/commands.hpp"
#include "cli/options.hpp"
#include "cli/scene_options.hpp"
#include "cli/text_output.hpp"

namespace piblocks::cli {
namespace {

std::vector<Instant> parse_instants(const std::string& text) {
  std::vector<Instant> instants;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    instants.push_back(parse_instant(text.substr(begin, end - begin)));
    begin = end + 1;
  }
  return instants;
}

void write(const TimedState& at, TextOutput& out) {
  const auto& [time, state] = at;
  out.format_line(R"({{"time":{},"collisions":"{}","blue":{{"position":{},"velocity":{}}},)"
                  R"("red":{{"position":{},"velocity":{}}}}})",
                  shown(time.hi), state.count.get_str(), shown(state.blue.position),
                  shown(state.blue.velocity), shown(state.red.position), shown(state.red.velocity));
}

}  // namespace

void add_state(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("state", "Print positions, velocities and count, one JSON object a line");
  const SceneOptions scene(*command);
  const CLI::Option* at = add_value_option(*command, "--at", "S[,S...]",
                                           "Instants: times, 'last', or '#K', the K-th collision")
                              .required();
  const CLI::Option* engine = &add_engine(*command);
  command->footer(
      "Examples:\n"
      "  piblocks state --at 0,3.5,last\n"
      "  piblocks state --digits 20 --at '#15707963267948966192'");
  command->callback([=] {
    const std::vector<Instant> instants = *value_of(*at, parse_instants);
    const auto log = make_log(scene.scene().system, *engine);
    TextOutput out("-");
    for (const Instant& instant : instants) write(state_at(*log, instant), out);
    out.finish();
  });
}

}  // namespace piblocks::cli
