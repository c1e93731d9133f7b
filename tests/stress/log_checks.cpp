#include "stress/log_checks.hpp"

#include <gtest/gtest.h>
#include <mpfr.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "support/oracle.hpp"
#include "support/state_after.hpp"

namespace piblocks::stress {
namespace {

Rational mass_ratio(const TwoBlocks& system) { return system.blue.mass / system.red.mass; }

Rational speed_squared(const TwoBlocks& s) {
  return mass_ratio(s) * s.blue.velocity * s.blue.velocity + s.red.velocity * s.red.velocity;
}

/// |value - exact|.
Wide error_of(double value, const Rational& exact) {
  if (!std::isfinite(value)) return std::numeric_limits<Wide>::infinity();
  return std::fabs(to_wide(Rational(value) - exact));
}

void expect_near(const char* what, Wide value, Wide wanted, Wide tolerance) {
  EXPECT_LE(std::fabs(value - wanted), tolerance) << what << ": " << value << ", not " << wanted;
}

Wide size_of(const Rational& value) { return std::fabs(to_wide(value)); }

}  // namespace

Wide to_wide(const Rational& value) {
  mpfr_t wide;
  mpfr_init2(wide, 128);
  mpfr_set_q(wide, value.get_mpq_t(), MPFR_RNDN);
  const Wide result = mpfr_get_ld(wide, MPFR_RNDN);
  mpfr_clear(wide);
  return result;
}

Wide root(const Rational& value) {
  mpfr_t wide;
  mpfr_init2(wide, 128);
  mpfr_set_q(wide, value.get_mpq_t(), MPFR_RNDN);
  mpfr_sqrt(wide, wide, MPFR_RNDN);
  const Wide result = mpfr_get_ld(wide, MPFR_RNDN);
  mpfr_clear(wide);
  return result;
}

Bounds::Bounds(const TwoBlocks& system)
    : system_(system),
      sigma_(root(mass_ratio(system))),
      speed_(root(speed_squared(system))),
      ell_(0) {
  if (speed_ == 0) return;
  const Rational y1 = system.blue_gap();
  const Rational y2 = y1 + system.blocks_gap();
  const Rational area = y2 * system.blue.velocity - y1 * system.red.velocity;
  const Rational squared = speed_squared(system);
  ell_ = root(area * area / squared);
  closest_approach_ =
      -(mass_ratio(system) * y1 * system.blue.velocity + y2 * system.red.velocity) / squared;
}

Wide Bounds::distance(const Rational& time) const {
  const Rational y1 = system_.blue_gap() + system_.blue.velocity * time;
  const Rational y2 = system_.blue_gap() + system_.blocks_gap() + system_.red.velocity * time;
  return root(mass_ratio(system_) * y1 * y1 + y2 * y2);
}

Wide Bounds::blue(const Rational& time) const {
  const Wide offset = size_of(system_.wall_face + system_.blue.width / 2);
  return kUnit * (8 * (distance(time) + ell_) + 2 * offset + distance(time)) + kLeast;
}

Wide Bounds::red(const Rational& time) const {
  const Wide offset = size_of(system_.wall_face + system_.blue.width + system_.red.width / 2);
  return kUnit * (8 * distance(time) + 2 * offset + distance(time)) + kLeast;
}

Rational Bounds::time(const Rational& time) const {
  const Rational tau = abs(time - closest_approach_);
  return std::min<Rational>(abs(time), tau) * Rational(8 * kUnit) + abs(time) * Rational(0x1p-102) +
         Rational(0x1p-1074);
}

void expect_possible(const TwoBlocks& system, const PairState& state) {
  ASSERT_TRUE(std::isfinite(state.blue.position) && std::isfinite(state.blue.velocity) &&
              std::isfinite(state.red.position) && std::isfinite(state.red.velocity))
      << "blue " << state.blue.position << " with " << state.blue.velocity << ", red "
      << state.red.position << " with " << state.red.velocity;
  // Folding puts the blocks into the wedge whatever the error of the phase: only coordinates round.
  const Rational blue_offset = system.wall_face + system.blue.width / 2;
  const Rational red_offset = system.wall_face + system.blue.width + system.red.width / 2;
  const Rational y1 = Rational(state.blue.position) - blue_offset;
  const Rational y2 = Rational(state.red.position) - red_offset;
  const Wide blue_rounding =
      kUnit * (size_of(blue_offset) + std::fabs(Wide(state.blue.position))) + kLeast;
  const Wide red_rounding =
      kUnit * (size_of(red_offset) + std::fabs(Wide(state.red.position))) + kLeast;
  EXPECT_GE(to_wide(y1), -1.01L * blue_rounding) << "blue in the wall";
  EXPECT_GE(to_wide(y2 - y1), -1.01L * (blue_rounding + red_rounding)) << "overlap";
}

void expect_energy_kept(const PairState& state, const Bounds& bounds) {
  expect_near("speed", std::hypot(bounds.sigma() * state.blue.velocity, Wide(state.red.velocity)),
              bounds.speed(), 8 * kUnit * bounds.speed() + (1 + bounds.sigma()) * kLeast);
}

namespace {

/// r v_blue + v_red and the relative velocity, before and after a collision of the blocks.
void expect_momentum_kept(const TwoBlocks& system, const PairLog& log, const PairCollision& now,
                          const Bounds& bounds) {
  if (now.kind != CollisionKind::blocks) return;
  Wide blue_before = to_double(system.blue.velocity);
  Wide red_before = to_double(system.red.velocity);
  if (now.index > 1) {
    const PairCollision before = log.blocks_collision(now.index - 1);
    blue_before = before.blue.velocity;
    red_before = before.red.velocity;
  }
  const Wide sigma = bounds.sigma();
  expect_near("momentum", sigma * (sigma * now.blue.velocity) + now.red.velocity,
              sigma * (sigma * blue_before) + red_before, (1 + sigma) * 2 * bounds.velocity());
  expect_near("relative velocity", now.red.velocity - Wide(now.blue.velocity),
              blue_before - red_before, (1 + 1 / sigma) * 2 * bounds.velocity());
}

void expect_state_of(const PairLog& log, const PairCollision& now, const Bounds& bounds) {
  const Rational time = to_rational(now.time);
  const PairState state = log.blocks_at(time);
  const PairState after = state_after(log, now.index);
  EXPECT_EQ(after.blue.position, now.blue.position);
  EXPECT_EQ(after.red.velocity, now.red.velocity);
  // The true collision may be a little later or earlier, and blue then as fast as ever.
  const Wide time_error = to_wide(bounds.time(time));
  const Wide blue_way = 2 * time_error *
                        (std::fabs(Wide(state.blue.velocity)) + std::fabs(Wide(now.blue.velocity)) +
                         bounds.velocity() / bounds.sigma());
  const Wide red_way = 2 * time_error * bounds.speed();
  expect_near("blue", state.blue.position, now.blue.position, 2 * bounds.blue(time) + blue_way);
  expect_near("red", state.red.position, now.red.position, 2 * bounds.red(time) + red_way);
}

/// Collision `now` is followed by the next one, and states between them know.
void expect_order(const PairLog& log, const PairCollision& now, const Bounds& bounds) {
  const Rational time = to_rational(now.time);
  const PairCollision next = log.blocks_collision(now.index + 1);
  const Rational next_time = to_rational(next.time);
  EXPECT_NE(now.kind, next.kind);
  const Rational doubt = bounds.time(time) + bounds.time(next_time);
  EXPECT_GE(next_time - time, -doubt);
  if (next_time - time <= doubt) return;  // two collisions that a rounded time cannot tell apart
  EXPECT_EQ(log.blocks_at((time + next_time) / 2).count, now.index);

  if (now.index + 2 > log.last()) return;
  const Rational later = to_rational(log.blocks_collision(now.index + 2).time);
  if (later - next_time <= bounds.time(next_time) + bounds.time(later)) return;
  const Integer at_next = log.blocks_at(next_time).count;
  EXPECT_TRUE(at_next == now.index || at_next == next.index) << at_next;
}

}  // namespace

void expect_consistent(const TwoBlocks& system, const PairLog& log, const Integer& index,
                       const Bounds& bounds) {
  SCOPED_TRACE("collision " + index.get_str());
  const PairCollision now = log.blocks_collision(index);
  const Rational time = to_rational(now.time);
  const PairState just_after = state_after(log, index);
  EXPECT_EQ(now.index, index);
  EXPECT_GE(time, -bounds.time(time));
  expect_possible(system, just_after);
  expect_energy_kept(just_after, bounds);
  expect_momentum_kept(system, log, now, bounds);
  expect_state_of(log, now, bounds);
  if (index < log.last()) {
    expect_order(log, now, bounds);
  } else {
    EXPECT_EQ(log.blocks_at(time + 2 * bounds.time(time)).count, index);
  }
}

/// Beyond those that the ratio of the masses asks for: lengths and velocities differ as much.
constexpr std::int64_t kOracle_bits = 1000;

void expect_oracles_state(const TwoBlocks& system, const PairLog& log, const Rational& time,
                          const Bounds& bounds) {
  const PairState state = log.blocks_at(time);
  const oracle::ExactState exact = oracle::high_precision_state(system, time, kOracle_bits);
  SCOPED_TRACE("t = " + time.get_str());
  EXPECT_EQ(state.count, exact.count);
  EXPECT_LE(error_of(state.blue.position, exact.blue.position), bounds.blue(time));
  EXPECT_LE(error_of(state.red.position, exact.red.position), bounds.red(time));
  EXPECT_LE(error_of(state.blue.velocity, exact.blue.velocity) * bounds.sigma(), bounds.velocity());
  EXPECT_LE(error_of(state.red.velocity, exact.red.velocity), bounds.velocity());
}

}  // namespace piblocks::stress
