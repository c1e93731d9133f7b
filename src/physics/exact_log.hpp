// The event loop in exact rational arithmetic, for the few collisions of a light red block.
// In: a BlockSystem with m_red <= m_blue, or one at rest. Out: its log; every answer is rounded
// once.
#pragma once

#include <piblocks/run.hpp>

#include <vector>

namespace piblocks {

/// A collision and the blocks just after it.
struct ExactCollision {
  Rational time;
  CollisionKind kind;
  BlockSystem blocks;
};

class ExactLog final : public CollisionLog {
 public:
  /// @throws SimulationError past a step limit that no such system reaches.
  explicit ExactLog(const BlockSystem& system);

  Collision collision(const Integer& index) const override;
  BlockState state_at(const Rational& time) const override;
  Rational time_after(const Integer& index) const override;

 private:
  const ExactCollision& event(const Integer& index) const;

  std::vector<ExactCollision> events_;  // of all time, in order
  ExactCollision start_;                // before all of them; its kind has no meaning
};

}  // namespace piblocks
