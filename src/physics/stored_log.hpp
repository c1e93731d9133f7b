// A collision log held in memory.
// In: what an event loop recorded, forwards and backwards from time 0. Out: look-up by index or
// by time (binary search).
#pragma once

#include <piblocks/run.hpp>

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
  /// @param system    whose motion was recorded.
  /// @param forward   collisions at times >= 0, in order.
  /// @param backward  collisions of the run with all velocities reversed, in its order and with
  ///                  its times and velocities.
  StoredLog(const BlockSystem& system, std::vector<StoredCollision> forward,
            std::vector<StoredCollision> backward);

  Collision collision(const Integer& index) const override;
  BlockState state_at(const Rational& time) const override;
  Rational time_after(const Integer& index) const override;

 private:
  std::vector<StoredCollision> forward_;
  std::vector<StoredCollision> backward_;
};

}  // namespace piblocks
