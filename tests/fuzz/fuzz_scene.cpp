// Scene files: read, checked, and, if they are good, asked where the blocks are.
#include <piblocks/collision_log.hpp>
#include <piblocks/error.hpp>
#include <piblocks/interpolator.hpp>
#include <piblocks/scene.hpp>
#include <piblocks/timeline.hpp>

#include "fuzz/input_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace piblocks;
  const fuzz::InputFile file(data, size);
  try {
    SceneBuilder builder;
    builder.read_file(file.path());
    const Scene scene = builder.build();
    const auto log = make_collision_log(scene.system);
    const Timeline timeline(scene, *log);
    for (const std::int64_t frame : {std::int64_t{0}, timeline.frame_count() - 1}) {
      state_at(*log, timeline.time_of(frame));
    }
  } catch (const Error&) {  // the right answer to most of what comes here
  }
  return 0;
}
