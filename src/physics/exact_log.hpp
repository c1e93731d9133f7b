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

  const Integer& size() const override { return size_; }
  const Integer& first_index() const override { return first_index_; }
  Collision at(const Integer& index) const override;
  Rational time_after(const Integer& index) const override;
  std::unique_ptr<CollisionStream> stream(const Integer& first, const Integer& last) const override;
  FreeFlight flight_at(const Rational& time) const override;

 private:
  const ExactCollision& event(const Integer& index) const;

  std::vector<ExactCollision> events_;  // of all time, in order
  ExactCollision start_;                // before all of them; its kind has no meaning
  Integer first_index_;
  Integer size_;
};

}  // namespace piblocks
