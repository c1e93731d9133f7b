#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/timeline.hpp>

namespace piblocks {
namespace {

Rational end_time(const End& end, const CollisionLog& log) {
  if (!end.after_last) return end.offset;
  if (log.size() == 0) {
    throw UsageError("time.to: the scene has no collision to end after; give a time, as --to 10");
  }
  return to_rational(log.at(log.size()).time) + end.offset;
}

}  // namespace

Timeline::Timeline(const Scene& scene, const CollisionLog& log)
    : from_(scene.time.from), step_(scene.time.speed / scene.view.frame_rate) {
  const Rational end = end_time(scene.time.to, log);
  if (end <= from_) {
    throw UsageError(
        fmt::format("time.from = {}: is not before the end at {}; there is nothing to show",
                    to_text(from_), to_text(end)));
  }
  const Integer frames = ceil((end - from_) / step_) + (scene.time.to.after_last ? 1 : 0);
  if (frames > kMaxFrames) {
    throw UsageError(
        fmt::format("time: {} frames are more than {}; narrow them with --from and --to, or "
                    "raise --speed",
                    readable(frames), readable(kMaxFrames)));
  }
  frame_count_ = frames.get_si();
}

}  // namespace piblocks
