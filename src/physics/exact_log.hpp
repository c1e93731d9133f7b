// The event loop in exact rational arithmetic, for the few collisions of a light red block.
// In: a BlockSystem with m_red <= m_blue, or one at rest. Out: its log; every answer is rounded
// once.
#pragma once

#include <piblocks/blocks.hpp>
#include <piblocks/collision_log.hpp>

#include <vector>

namespace piblocks {

/// A collision and the blocks just after it.
struct ExactCollision {
  Rational time;
  CollisionKind kind;
  BlockSystem after;
};

class ExactLog final : public CollisionLog {
 public:
  /// @throws SimulationError past a step limit that no such system reaches.
  explicit ExactLog(const BlockSystem& system);

  const Integer& size() const override { return size_; }
  Collision at(const Integer& index) const override;
  std::unique_ptr<CollisionStream> stream(const Integer& first, const Integer& last) const override;
  FreeFlight flight_at(const Rational& time) const override;
  std::optional<Impact> impact(CollisionKind kind, const Integer& first,
                               const Integer& last) const override;
  Integer count_near(const Time& time) const override;
  std::unique_ptr<Exposure> expose(const Rational& begin, const Rational& end) const override;
  std::optional<PositionBounds> bounds_at(const Rational& time) const override;

 private:
  /// When the collision with this index happens.
  Rational time_of(long index) const;
  const ExactCollision& event(long index) const;

  BlockSystem initial_;
  std::vector<ExactCollision> forward_;
  std::vector<ExactCollision> backward_;  // with the velocities and times of the run reversed
  Integer size_;
};

}  // namespace piblocks
