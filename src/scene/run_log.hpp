// The run of a scene: the collisions of blue, red and the wall, or those of its bodies.
// In: a scene without problems. Out: its log, of either kind.
#pragma once

#include <piblocks/bodies.hpp>
#include <piblocks/run.hpp>
#include <piblocks/scene.hpp>

#include <memory>
#include <optional>
#include <string>

namespace piblocks {

/// One of two logs. What needs only times and counts takes timeline().
class RunLog {
 public:
  /// @throws as make_collision_log(), or make_body_log() of a scene with bodies; UsageError if the
  ///         scene shows what is not certain and does not allow that.
  explicit RunLog(const Scene& scene);
  RunLog(std::unique_ptr<CollisionLog> log) : blocks_(std::move(log)) {}

  const Timeline& timeline() const {
    if (blocks_) return *blocks_;
    return *bodies_;
  }
  /// Nothing if the scene has bodies.
  const CollisionLog* blocks() const noexcept { return blocks_.get(); }
  /// Nothing if the scene has none.
  const BodyLog* bodies() const noexcept { return bodies_.get(); }

 private:
  std::unique_ptr<CollisionLog> blocks_;
  std::unique_ptr<BodyLog> bodies_;
};

/// @throws UsageError if bodies are not certain at this time, unless the scene allows that.
void require_certain(const Scene& scene, const BodyLog& log, const Rational& time);

/// What to tell the user if the order of pairs decides what happens up to this collision, as far as
/// the log has been computed; nothing of two blocks and a wall.
std::optional<std::string> tie_note(const RunLog& log, const Integer& last);

/// @param what  in the message: an option
/// @throws UsageError if the scene has bodies: only two blocks and a wall can be shown that way.
void require_blocks(const Scene& scene, const char* what);

}  // namespace piblocks
