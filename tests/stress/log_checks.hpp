// What holds for every run of two blocks, whatever its numbers.
// In: a system, its log, and a time or an index. Out: GoogleTest failures.
#pragma once

#include <piblocks/two_blocks.hpp>

namespace piblocks::stress {

/// Unit roundoff of a double.
inline constexpr double kUnit = 0x1p-53;

/// Numbers beyond a double's range on both sides; no rounding of theirs matters here.
using Wide = long double;

/// Least distance between doubles: where they are denormal, that is all they can tell.
inline constexpr Wide kLeast = 0x1p-1074L;

Wide to_wide(const Rational& value);
/// The square root, also where the value itself is out of range.
Wide root(const Rational& value);

/// A system with what its error bounds are made of: R the distance from the corner, ell that of
/// the line of motion times m_red/m_blue's root, tc the time of closest approach.
class Bounds {
 public:
  explicit Bounds(const TwoBlocks& system);

  /// Of a position at `time`: |dy1| <= 8 u (R + ell), |dy2| <= 8 u R, and the coordinates'
  /// rounding.
  Wide blue(const Rational& time) const;
  Wide red(const Rational& time) const;
  /// Of sigma v_blue and of v_red.
  Wide velocity() const { return 24 * kUnit * speed_ + (1 + sigma_) * kLeast; }
  /// Of a collision's time: 8 u of |t| or of |t - tc|, whichever is less, and what two doubles
  /// cannot hold of it.
  Rational time(const Rational& time) const;
  /// When the last collision is at the earliest, but for a factor of 100.
  Wide last_time() const { return speed_ == 0 ? 0 : ell_ / speed_; }
  /// sqrt(m_blue/m_red).
  Wide sigma() const { return sigma_; }
  /// |(sigma v_blue, v_red)|, the same at all times.
  Wide speed() const { return speed_; }

 private:
  Wide distance(const Rational& time) const;

  TwoBlocks system_;
  Wide sigma_;
  Wide speed_;
  Wide ell_;
  Rational closest_approach_;
};

/// Numbers are finite and the blocks in their order.
void expect_possible(const TwoBlocks& system, const PairState& state);
/// The velocities have the energy of the start.
void expect_energy_kept(const PairState& state, const Bounds& bounds);
/// Collision `index` and its neighbours in the log: their order, momentum, and the states just
/// before, at and between them.
void expect_consistent(const TwoBlocks& system, const PairLog& log, const Integer& index,
                       const Bounds& bounds);
/// The state at `time` is the oracle's, to the a-priori bound.
void expect_oracles_state(const TwoBlocks& system, const PairLog& log, const Rational& time,
                          const Bounds& bounds);

}  // namespace piblocks::stress
