// What holds for every run of two blocks, whatever its numbers.
// In: a system, its log, and a time or an index. Out: GoogleTest failures.
#pragma once

#include <piblocks/blocks.hpp>
#include <piblocks/collision_log.hpp>
#include <piblocks/interpolator.hpp>

namespace piblocks::stress {

/// Unit roundoff of a double.
inline constexpr double kUnit = 0x1p-53;

/// A system with what its error bounds are made of: R the distance from the corner, ell that of
/// the line of motion times m_red/m_blue's root, tc the time of closest approach.
class Bounds {
 public:
  explicit Bounds(const BlockSystem& system);

  /// Of a position at `time`: |dy1| <= 8 u (R + ell), |dy2| <= 8 u R, and the coordinates'
  /// rounding.
  double blue(const Rational& time) const;
  double red(const Rational& time) const;
  /// Of sigma v_blue and of v_red.
  double velocity() const { return 32 * kUnit * speed_; }
  /// Of a collision's time, which is rounded once as a distance from tc.
  Rational time(const Rational& time) const;
  /// sqrt(m_blue/m_red).
  double sigma() const { return sigma_; }
  /// |(sigma v_blue, v_red)|, the same at all times.
  double speed() const { return speed_; }

 private:
  double distance(const Rational& time) const;

  BlockSystem system_;
  double sigma_;
  double speed_;
  double ell_;
  Rational closest_approach_;
};

/// Numbers are finite and the blocks in their order.
void expect_possible(const BlockSystem& system, const BlockState& state, const Bounds& bounds,
                     const Rational& time);
/// The velocities have the energy of the start.
void expect_energy_kept(const BlockState& state, const Bounds& bounds);
/// Collision `index` and its neighbours in the log: their order, momentum, and the states just
/// before, at and between them.
void expect_consistent(const BlockSystem& system, const CollisionLog& log, const Integer& index,
                       const Bounds& bounds);
/// The state at `time` is the oracle's, to the a-priori bound.
void expect_oracles_state(const BlockSystem& system, const CollisionLog& log, const Rational& time,
                          const Bounds& bounds);

}  // namespace piblocks::stress
