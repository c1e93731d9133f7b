#include "render/shutter.hpp"

#include <optional>

namespace piblocks {
namespace {

std::vector<ExposurePart> expose(const CollisionLog& log, const std::vector<TimeSlice>& slices) {
  std::vector<ExposurePart> parts;
  parts.reserve(slices.size());
  for (const TimeSlice& slice : slices) {
    parts.push_back({to_double(slice.share), log.expose(slice.from, slice.to)});
  }
  return parts;
}

Rational open_s(const View& view) { return view.shutter / view.frame_rate; }

}  // namespace

std::vector<ExposurePart> expose_frame(const Scene& scene, const CollisionLog& log,
                                       const Schedule& schedule, std::int64_t frame) {
  if (scene.view.shutter == 0) return {};
  const Rational video_s = Rational(frame) / scene.view.frame_rate;
  return expose(log, schedule.during(video_s, open_s(scene.view)));
}

std::vector<ExposurePart> expose_still(const Scene& scene, const CollisionLog& log,
                                       const Rational& time) {
  if (scene.view.shutter == 0) return {};
  const Rational length_s = open_s(scene.view);
  // A scene without collisions may have no end, and so no schedule.
  if (log.size() > 0 || !scene.time.to.after_last) {
    const Schedule schedule(scene, log);
    if (const auto video_s = schedule.first_shown(time)) {
      return expose(log, schedule.during(*video_s, length_s));
    }
  }
  return expose(log, {{time, time + scene.time.speed * length_s, 1}});
}

}  // namespace piblocks
