#include "stress/log_checks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "support/oracle.hpp"

namespace piblocks::stress {
namespace {

/// The root of an exact number, also where its double would underflow or overflow.
double root(const Rational& value) {
  if (value == 0) return 0;
  const long bits = static_cast<long>(mpz_sizeinbase(value.get_num_mpz_t(), 2)) -
                    static_cast<long>(mpz_sizeinbase(value.get_den_mpz_t(), 2));
  const long half = bits / 2;
  Rational near_one;
  if (half >= 0) {
    mpq_div_2exp(near_one.get_mpq_t(), value.get_mpq_t(), static_cast<mp_bitcnt_t>(2 * half));
  } else {
    mpq_mul_2exp(near_one.get_mpq_t(), value.get_mpq_t(), static_cast<mp_bitcnt_t>(-2 * half));
  }
  return std::scalbln(std::sqrt(to_double(near_one)), half);
}

Rational mass_ratio(const BlockSystem& system) { return system.blue.mass / system.red.mass; }

Rational speed_squared(const BlockSystem& s) {
  return mass_ratio(s) * s.blue.velocity * s.blue.velocity + s.red.velocity * s.red.velocity;
}

double error_of(double value, const Rational& exact) {
  if (!std::isfinite(value)) return std::numeric_limits<double>::infinity();
  return std::fabs(to_double(Rational(value) - exact));
}

}  // namespace

Bounds::Bounds(const BlockSystem& system)
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

double Bounds::distance(const Rational& time) const {
  const Rational y1 = system_.blue_gap() + system_.blue.velocity * time;
  const Rational y2 = system_.blue_gap() + system_.blocks_gap() + system_.red.velocity * time;
  return root(mass_ratio(system_) * y1 * y1 + y2 * y2);
}

double Bounds::blue(const Rational& time) const {
  const Rational corner = system_.wall_face + system_.blue.width / 2;
  const double coordinate = std::fabs(to_double(corner)) + distance(time);
  return 8 * kUnit * (distance(time) + ell_) + 4 * kUnit * coordinate;
}

double Bounds::red(const Rational& time) const {
  const Rational corner = system_.wall_face + system_.blue.width + system_.red.width / 2;
  const double coordinate = std::fabs(to_double(corner)) + distance(time);
  return 8 * kUnit * distance(time) + 4 * kUnit * coordinate;
}

Rational Bounds::time(const Rational& time) const {
  const Rational tau = abs(time - closest_approach_);
  return tau * Rational(8 * kUnit) + (abs(time) + abs(closest_approach_)) * Rational(0x1p-100);
}

void expect_possible(const BlockSystem& system, const BlockState& state, const Bounds& bounds,
                     const Rational& time) {
  ASSERT_TRUE(std::isfinite(state.blue.position) && std::isfinite(state.blue.velocity) &&
              std::isfinite(state.red.position) && std::isfinite(state.red.velocity))
      << "at t = " << to_double(time) << ": blue " << state.blue.position << " with "
      << state.blue.velocity << ", red " << state.red.position << " with " << state.red.velocity;
  // Folding puts the blocks into the wedge whatever the error of the phase: only coordinates round.
  const Rational& blue_width = system.blue.width;
  const Rational gap_to_wall = Rational(state.blue.position) - blue_width / 2 - system.wall_face;
  const Rational gap = Rational(state.red.position) - Rational(state.blue.position) -
                       (blue_width + system.red.width) / 2;
  const double blue_rounding = 4 * kUnit * std::fabs(state.blue.position) +
                               4 * kUnit * std::fabs(to_double(system.wall_face + blue_width));
  const double red_rounding = blue_rounding + bounds.red(time);
  EXPECT_GE(to_double(gap_to_wall), -blue_rounding)
      << "blue in the wall at t = " << to_double(time);
  EXPECT_GE(to_double(gap), -red_rounding) << "overlap at t = " << to_double(time);
}

void expect_energy_kept(const BlockState& state, const Bounds& bounds) {
  EXPECT_NEAR(std::hypot(bounds.sigma() * state.blue.velocity, state.red.velocity), bounds.speed(),
              bounds.velocity());
}

namespace {

/// r v_blue + v_red before and after a collision of the blocks.
void expect_momentum_kept(const BlockSystem& system, const CollisionLog& log, const Collision& now,
                          const Bounds& bounds) {
  if (now.kind != CollisionKind::blocks) return;
  const bool is_first = now.index == 1;
  const double blue_before =
      is_first ? to_double(system.blue.velocity) : log.at(now.index - 1).blue.velocity;
  const double red_before =
      is_first ? to_double(system.red.velocity) : log.at(now.index - 1).red.velocity;
  const double sigma = bounds.sigma();
  EXPECT_NEAR(sigma * (sigma * now.blue.velocity) + now.red.velocity,
              sigma * (sigma * blue_before) + red_before, (1 + sigma) * 2 * bounds.velocity());
  EXPECT_NEAR(now.red.velocity - now.blue.velocity, blue_before - red_before,
              (1 + 1 / sigma) * 2 * bounds.velocity());
}

void expect_state_of(const CollisionLog& log, const Collision& now, const Bounds& bounds) {
  const Rational time = to_rational(now.time);
  const BlockState state = state_at(log, time);
  const double time_error = to_double(bounds.time(time));
  const BlockState after = state_after(log, now.index);
  EXPECT_EQ(after.blue.position, now.blue.position);
  // The true collision may be a little later or earlier, and blue then as fast as ever.
  const double blue_way = 2 * time_error *
                          (std::fabs(state.blue.velocity) + std::fabs(now.blue.velocity) +
                           bounds.velocity() / bounds.sigma());
  const double red_way = 4 * time_error * bounds.speed();
  EXPECT_NEAR(state.blue.position, now.blue.position, 2 * bounds.blue(time) + blue_way);
  EXPECT_NEAR(state.red.position, now.red.position, 2 * bounds.red(time) + red_way);
}

}  // namespace

void expect_consistent(const BlockSystem& system, const CollisionLog& log, const Integer& index,
                       const Bounds& bounds) {
  SCOPED_TRACE("collision " + index.get_str());
  const Collision now = log.at(index);
  const Rational time = to_rational(now.time);
  const BlockState just_after = state_after(log, index);
  expect_possible(system, just_after, bounds, time);
  expect_energy_kept(just_after, bounds);
  expect_momentum_kept(system, log, now, bounds);
  expect_state_of(log, now, bounds);
  EXPECT_EQ(now.index, index);
  EXPECT_GE(time, -bounds.time(time));

  if (index == log.size()) {
    EXPECT_EQ(log.flight_at(time + 2 * bounds.time(time) + 1).count, index);
    return;
  }
  const Collision next = log.at(index + 1);
  const Rational next_time = to_rational(next.time);
  EXPECT_NE(now.kind, next.kind);
  const Rational doubt = bounds.time(time) + bounds.time(next_time);
  EXPECT_GE(next_time - time, -doubt);
  if (next_time - time <= 2 * doubt) return;  // two collisions that a time cannot tell apart
  EXPECT_EQ(log.flight_at((time + next_time) / 2).count, index);
  const Integer at_time = log.flight_at(next_time).count;
  EXPECT_TRUE(at_time == index || at_time == index + 1 || log.size() > index + 1) << at_time;
}

void expect_oracles_state(const BlockSystem& system, const CollisionLog& log, const Rational& time,
                          const Bounds& bounds) {
  const BlockState state = state_at(log, time);
  const oracle::ExactState exact = oracle::high_precision_state(system, time);
  SCOPED_TRACE("t = " + time.get_str());
  EXPECT_EQ(state.count, exact.count);
  EXPECT_LE(error_of(state.blue.position, exact.blue.position), bounds.blue(time));
  EXPECT_LE(error_of(state.red.position, exact.red.position), bounds.red(time));
  EXPECT_LE(error_of(state.blue.velocity, exact.blue.velocity) * bounds.sigma(), bounds.velocity());
  EXPECT_LE(error_of(state.red.velocity, exact.red.velocity), bounds.velocity());
}

}  // namespace piblocks::stress
