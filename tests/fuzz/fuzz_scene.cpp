// Scene files and storyboards: read, checked, and, if they are good, asked where the blocks are.
#include <piblocks/error.hpp>
#include <piblocks/script.hpp>
#include <piblocks/two_blocks.hpp>

#include <cstdlib>

#include "fuzz/input_file.hpp"
#include "scene/schedule.hpp"

namespace {
using namespace piblocks;

void ask(const Scene& scene) {
  const auto log = make_pair_log(scene.system);
  const Schedule schedule = make_schedule(scene, *log);
  for (const std::int64_t frame : {std::int64_t{0}, film_frames(schedule) - 1}) {
    log->blocks_at(schedule.time_of(frame));
  }
}

/// What was read without a problem has none.
void ask(const Storyboard& story) {
  if (!problems_of(story).empty()) std::abort();
  describe(story);
  for (const Segment& segment : story.segments) {
    if (const auto* runs = std::get_if<Scenes>(&segment.content)) {
      for (const Scene& run : *runs) ask(run);
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const fuzz::InputFile file(data, size);
  try {
    ScriptBuilder builder;
    builder.read_file(file.path());
    const Script script = builder.build();
    std::visit([](const auto& any) { ask(any); }, script);
  } catch (const Error&) {  // the right answer to most of what comes here
  }
  return 0;
}
