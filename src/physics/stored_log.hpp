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
  /// @param initial   the motion at time 0, before a collision at time 0.
  /// @param forward   collisions at times >= 0, in order.
  /// @param backward  collisions of the run with all velocities reversed, in its order and with
  ///                  its times and velocities.
  StoredLog(const FreeFlight& initial, const std::vector<StoredCollision>& forward,
            const std::vector<StoredCollision>& backward);

  const Integer& size() const override { return size_; }
  Collision at(const Integer& index) const override;
  FreeFlight flight_at(const Rational& time) const override;

 private:
  struct Flight {
    Time start;          // of the half-open interval it holds for
    CollisionKind kind;  // of the collision at start
    Time anchor;
    Motion blue;
    Motion red;
  };

  std::vector<Flight> flights_;  // ordered by start; the first has none
  std::size_t initial_ = 0;      // the flight whose count is 0
  Integer size_;
};

}  // namespace piblocks
