#include "cli/convention_note.hpp"

#include <piblocks/run.hpp>

#include "cli/say.hpp"

namespace piblocks::cli {

void note_convention(const BlockSystem& system) {
  const auto corner = corner_of(system);
  if (!corner) return;
  say("piblocks: note: all collisions happen at once, at t = {}, when blue touches both wall "
      "and red: by convention {}, which makes {} ({} first: {})\n",
      to_text(corner->time),
      corner->blocks_first ? "the blocks meet first" : "blue meets the wall first",
      readable(corner->count), corner->blocks_first ? "wall" : "blocks",
      readable(corner->other_count));
}

void note_convention(const Script& script) {
  if (const auto* scene = std::get_if<Scene>(&script)) return note_convention(scene->system);
  for (const StoryPart& part : std::get<Storyboard>(script).parts) {
    const auto* const runs = std::get_if<Runs>(&part.content);
    if (runs == nullptr) continue;
    for (const Scene& run : *runs) note_convention(run.system);
  }
}

}  // namespace piblocks::cli
