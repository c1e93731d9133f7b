// What every frame of a scene shows.
// In: a scene, once, and the number of a frame. Out: its draw list.
#pragma once

#include <piblocks/canvas.hpp>
#include <piblocks/collision_log.hpp>
#include <piblocks/composition.hpp>
#include <piblocks/error.hpp>
#include <piblocks/timeline.hpp>

#include <memory>
#include <utility>
#include <vector>

#include "render/logo.hpp"

namespace piblocks {

inline Ground ground_of(const View& view) {
  return view.background == Background::transparent ? Ground::transparent : Ground::opaque;
}

/// Const members are thread-safe.
class Film {
 public:
  /// @throws SceneError if problems_of(scene) is not empty; UsageError, SimulationError, DrawError
  explicit Film(const Scene& scene)
      : scene_(checked(scene)),
        log_(make_collision_log(scene_.system)),
        timeline_(scene_, *log_),
        composition_(scene_, *log_, read_logo(scene_)) {}

  const Scene& scene() const noexcept { return scene_; }
  const CollisionLog& log() const noexcept { return *log_; }
  const Schedule& schedule() const noexcept { return timeline_.schedule(); }
  const View& view() const noexcept { return scene_.view; }
  Ground ground() const noexcept { return ground_of(scene_.view); }
  std::int64_t frame_count() const noexcept { return timeline_.frame_count(); }
  /// @param number  from 0 to frame_count() - 1.
  DrawList frame(std::int64_t number) const {
    FrameTime shown = timeline_.at(number);
    BlockState state = state_at(*log_, shown.time);
    return composition_.frame({std::move(state), std::move(shown.time), std::move(shown.slower)});
  }

 private:
  /// Whoever fills in a Scene by hand has not been told what is wrong with it.
  static const Scene& checked(const Scene& scene) {
    const std::vector<Problem> problems = problems_of(scene);
    if (!problems.empty()) throw SceneError(describe(problems));
    return scene;
  }

  Scene scene_;
  std::unique_ptr<CollisionLog> log_;
  Timeline timeline_;
  Composition composition_;
};

}  // namespace piblocks
