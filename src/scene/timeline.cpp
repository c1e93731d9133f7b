#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/timeline.hpp>

namespace piblocks {

Timeline::Timeline(const Scene& scene, const CollisionLog& log)
    : schedule_(scene, log), frame_rate_(scene.view.frame_rate) {
  const Integer& frames = schedule_.frame_count();
  if (frames > kMaxFrames) {
    throw UsageError(
        fmt::format("time: {} frames are more than {}; narrow them with --from and --to, or "
                    "raise --speed",
                    readable(frames), readable(kMaxFrames)));
  }
  frame_count_ = frames.get_si();
}

}  // namespace piblocks
