// A collision log held in memory.
// In: what an event loop recorded, forwards and backwards from time 0. Out: look-up by index or
// by time (binary search).
#pragma once

#include <piblocks/collision_log.hpp>

#include <vector>

namespace piblocks {

/// One collision as an event loop meets it; velocities are those just after.
struct StoredCollision {
  Time time;
  CollisionKind kind = CollisionKind::blocks;
  Motion blue;
  Motion red;
};

class StoredLog final : public CollisionLog {
 public:
  /// @param mass_ratio  m_blue / m_red
  /// @param initial   the motion at time 0, before a collision at time 0.
  /// @param forward   collisions at times >= 0, in order.
  /// @param backward  collisions of the run with all velocities reversed, in its order and with
  ///                  its times and velocities.
  StoredLog(double mass_ratio, FreeFlight initial, std::vector<StoredCollision> forward,
            std::vector<StoredCollision> backward);

  const Integer& size() const override { return size_; }
  Collision at(const Integer& index) const override;
  std::unique_ptr<CollisionStream> stream(const Integer& first, const Integer& last) const override;
  FreeFlight flight_at(const Rational& time) const override;
  std::optional<Impact> impact(CollisionKind kind, const Integer& first,
                               const Integer& last) const override;
  Integer count_near(const Time& time) const override;
  std::unique_ptr<Exposure> expose(const Rational& begin, const Rational& end) const override;
  std::optional<PositionBounds> bounds_at(const Rational& /*time*/) const override {
    return std::nullopt;
  }

 private:
  /// In the unit of Impact.
  double impulse_of(const StoredCollision& collision) const;

  double mass_ratio_;
  FreeFlight initial_;
  std::vector<StoredCollision> forward_;
  std::vector<StoredCollision> backward_;
  Integer size_;
};

}  // namespace piblocks
