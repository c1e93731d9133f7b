#include "cli/script_facts.hpp"

#include <fmt/format.h>

#include "cli/values.hpp"

namespace piblocks::cli {

std::unique_ptr<CollisionLog> make_log(const BlockSystem& system, const OptionTexts& options) {
  const auto parse_engine = [](const std::string& text) {
    return parse_choice<Engine>(text, {{"unfolded", Engine::unfolded},
                                       {"events", Engine::events},
                                       {"velocities", Engine::velocities}});
  };
  return make_collision_log(system,
                            options.value("--engine", parse_engine).value_or(Engine::unfolded));
}

void claim_logos(OverwriteCheck& check, const Script& script) {
  for (const Scene* scene : scenes_of(script)) {
    if (!scene->show.logo.empty()) check.reads("the logo", scene->show.logo);
  }
}

std::vector<std::string> convention_notes(const Script& script) {
  std::vector<std::string> notes;
  for (const Scene* scene : scenes_of(script)) {
    const auto corner = corner_of(scene->system);
    if (!corner) continue;
    notes.push_back(fmt::format(
        "all collisions happen at once, at t = {}, when blue touches both wall and red: by "
        "convention {}, which makes {} ({} first: {})",
        to_text(corner->time),
        corner->blocks_first ? "the blocks meet first" : "blue meets the wall first",
        readable(corner->count), corner->blocks_first ? "wall" : "blocks",
        readable(corner->other_count)));
  }
  return notes;
}

}  // namespace piblocks::cli
