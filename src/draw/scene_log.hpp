// The run of a scene as that of bodies, whichever log it has. It goes when there is one log.
// In: a scene and the log of either kind. Out: bodies, and their states and collisions.
#pragma once

#include <piblocks/bodies.hpp>
#include <piblocks/run.hpp>
#include <piblocks/scene.hpp>

#include <memory>
#include <optional>
#include <vector>

#include "physics/exposure.hpp"

namespace piblocks {

/// What the scene shows. Blue and red are bodies 0 and 1, beside wall 0.
Bodies bodies_of(const Scene& scene);

BodiesState bodies_state(BlockState state);
/// Back again. @param state  of two bodies
BlockState blocks_state(const BodiesState& state);

/// A log of either kind. It does not own it.
class SceneLog {
 public:
  SceneLog(const CollisionLog& log);
  SceneLog(const BodyLog& log);

  operator const Timeline&() const noexcept { return *timeline_; }
  const Timeline* operator->() const noexcept { return timeline_; }
  /// The closed form of two blocks beside a wall; nothing where there are other bodies.
  const CollisionLog* two_blocks() const noexcept { return blocks_; }

  const BodySystem& system() const noexcept { return *system_; }

  /// As those of BodyLog; of two blocks, also before time 0.
  BodiesState state_at(const Rational& time) const;
  BodyCollision collision(const Integer& index) const;
  std::vector<std::vector<PathPoint>> paths(const Rational& from, const Rational& to,
                                            std::size_t most) const;
  std::optional<double> certain_until() const;

  // Until there is one exposure, only one of these has something.
  std::optional<Exposure> exposure_of_blocks(const Rational& from, const Rational& to) const;
  std::optional<BodyExposure> exposure_of_bodies(const Rational& from, const Rational& to) const;

 private:
  const Timeline* timeline_;
  const CollisionLog* blocks_ = nullptr;
  const BodyLog* bodies_ = nullptr;
  std::shared_ptr<const BodySystem> system_;  ///< that of the log, or made for it
};

}  // namespace piblocks
