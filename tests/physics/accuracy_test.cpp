// The library against an oracle that shares nothing with it.
#include <gtest/gtest.h>
#include <piblocks/two_blocks.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "support/oracle.hpp"
#include "support/random_system.hpp"
#include "support/traced_random.hpp"

namespace piblocks {
namespace {

constexpr double kUnitRoundoff = 0x1p-53;

/// R and ell of the a-priori bounds |dy1| <= 8 u (R + ell), |dy2| <= 8 u R.
struct Distances {
  double from_corner;
  double closest;
};

Distances distances(const TwoBlocks& s, const oracle::ExactState& state) {
  const Rational r = s.blue.mass / s.red.mass;
  const double y1 = to_double(state.blue.position - s.blue.width / 2 - s.wall_face);
  const double y2 = to_double(state.red.position - s.wall_face - s.blue.width - s.red.width / 2);
  const Rational y1_start = s.blue_gap();
  const Rational y2_start = s.blue_gap() + s.blocks_gap();
  const Rational area = y2_start * s.blue.velocity - y1_start * s.red.velocity;
  const Rational speed_squared =
      r * s.blue.velocity * s.blue.velocity + s.red.velocity * s.red.velocity;
  return {std::hypot(std::sqrt(to_double(r)) * y1, y2),
          to_double(abs(area)) / std::sqrt(to_double(speed_squared))};
}

/// 8 u (R + ell) and 8 u R, and the rounding of the coordinates.
PositionBounds a_priori_bounds(const TwoBlocks& system, const oracle::ExactState& exact) {
  const Distances d = distances(system, exact);
  const double blue = 2 * std::fabs(to_double(exact.blue.position)) + d.from_corner;
  const double red = 4 * std::fabs(to_double(exact.red.position)) + d.from_corner;
  return {kUnitRoundoff * (8 * (d.from_corner + d.closest) + blue),
          kUnitRoundoff * (8 * d.from_corner + red)};
}

/// The state is the oracle's, to the bound that the log gives and to ours.
void expect_accurate(const TwoBlocks& system, const PairLog& log, const Rational& t) {
  SCOPED_TRACE("t = " + t.get_str());
  const PairState state = log.blocks_at(t);
  const oracle::ExactState exact = oracle::high_precision_state(system, t);
  EXPECT_EQ(state.count, exact.count);
  const PositionBounds ours = a_priori_bounds(system, exact);
  const PositionBounds given = log.bounds_at(t).value();
  const double blue_error =
      std::fabs(to_double(Rational(state.blue.position) - exact.blue.position));
  const double red_error = std::fabs(to_double(Rational(state.red.position) - exact.red.position));
  EXPECT_LE(blue_error, ours.blue);
  EXPECT_LE(red_error, ours.red);
  EXPECT_LE(blue_error, given.blue);
  EXPECT_LE(red_error, given.red);
  // sigma v_blue and v_red are the two parts of a velocity of constant length.
  const double speed = std::hypot(
      to_double(exact.red.velocity),
      to_double(exact.blue.velocity) * std::sqrt(to_double(system.blue.mass / system.red.mass)));
  EXPECT_NEAR(state.red.velocity, to_double(exact.red.velocity), 24 * kUnitRoundoff * speed);
}

TEST(Accuracy, OfTheArticlesSystemAtAnyNumberOfDigits) {
  for (int digits = 1; digits <= 20; ++digits) {
    const TwoBlocks system = article_blocks(digits);
    const auto log = make_pair_log(system);
    for (const char* text : {"0", "3.5", "4", "6", "3.4999999", "3.50000001", "15"}) {
      const Rational t = parse_rational(text);
      expect_accurate(system, *log, t);
      const PairState state = log->blocks_at(t);
      const oracle::ExactState exact = oracle::high_precision_state(system, t);
      EXPECT_NEAR(to_double(Rational(state.blue.position) - exact.blue.position), 0, 1e-13);
      EXPECT_NEAR(to_double(Rational(state.red.position) - exact.red.position), 0, 1e-13);
    }
  }
}

TEST(Accuracy, AtRandomTimes) {
  TracedRandom random(314159);
  for (int digits : {1, 2, 3, 5, 9, 12, 17, 25, 40, 100}) {
    const TwoBlocks system = article_blocks(digits);
    const auto log = make_pair_log(system);
    for (int i = 0; i < 40; ++i) {
      // Half of the times close in on the turning point at every scale.
      const Rational t =
          i % 2 == 0 ? Rational(random.uniform(-5, 20))
                     : Rational(3.5) +
                           Rational(std::ldexp(random.uniform(-1, 1), -int(random.integer(0, 60))));
      expect_accurate(system, *log, t);
    }
  }
}

TEST(Accuracy, OfRandomSystems) {
  TracedRandom random(271828);
  for (int i = 0; i < 400; ++i) {
    const TwoBlocks system = random_system(random, -8, 25);
    const auto log = make_pair_log(system);
    EXPECT_EQ(log->last(), oracle::high_precision_total(system));
    for (int j = 0; j < 4; ++j) expect_accurate(system, *log, random.rational(-10, 20, 1000));
  }
}

/// Worst relative error of a time that is allowed: that of two roundings.
constexpr double kTimeError = 4e-16;

void expect_event(const oracle::ExactEvent& exact, CollisionKind kind, const Time& time,
                  const BlockMotion& blue, const BlockMotion& red) {
  EXPECT_EQ(kind, exact.kind);
  EXPECT_LE(abs(to_rational(time) - exact.time), exact.time * Rational(kTimeError));
  EXPECT_NEAR(blue.position, to_double(exact.blue.position), 2e-15);
  EXPECT_NEAR(red.position, to_double(exact.red.position), 2e-15);
  EXPECT_NEAR(blue.velocity, to_double(exact.blue.velocity),
              4e-15 * (1 + std::fabs(blue.velocity)));
  EXPECT_NEAR(red.velocity, to_double(exact.red.velocity), 2e-15);
}

TEST(Accuracy, OfTheWholeLogAndItsStream) {
  for (int digits = 1; digits <= 4; ++digits) {
    const TwoBlocks system = article_blocks(digits);
    const auto log = make_pair_log(system);
    const std::vector<oracle::ExactEvent> run = oracle::exact_run(system, 4000);
    ASSERT_EQ(log->last(), run.size());
    const auto batch = std::make_unique<PairBatch>();
    const auto stream = log->stream(1, log->last());
    std::size_t i = 0;
    while (stream->read(*batch)) {
      for (std::size_t row = 0; row < batch->size; ++row, ++i) {
        SCOPED_TRACE("collision " + std::to_string(i + 1));
        const PairCollision c = log->blocks_collision(Integer(i + 1));
        expect_event(run[i], c.kind, c.time, c.blue, c.red);
        expect_event(run[i], batch->kind[row], {batch->time_hi[row], batch->time_lo[row]},
                     {batch->blue_position[row], batch->blue_velocity[row]},
                     {batch->red_position[row], batch->red_velocity[row]});
      }
    }
    EXPECT_EQ(i, run.size());
  }
}

TEST(Accuracy, LogAndStatesAreOneMotion) {
  // A little after each collision the state is the collision's, moved on.
  const auto log = make_pair_log(article_blocks(6));
  for (long k = 1; k < 314159; k += 997) {
    const PairCollision now = log->blocks_collision(k);
    const PairCollision next = log->blocks_collision(k + 1);
    const Rational middle = (to_rational(now.time) + to_rational(next.time)) / 2;
    const PairState state = log->blocks_at(middle);
    const double half = to_double(middle - to_rational(now.time));
    EXPECT_EQ(state.count, k);
    EXPECT_NEAR(state.blue.position, now.blue.position + half * now.blue.velocity, 1e-13);
    EXPECT_NEAR(state.red.position, now.red.position + half * now.red.velocity, 1e-13);
    EXPECT_NEAR(state.blue.velocity, now.blue.velocity, 1e-10);
  }
}

TEST(Accuracy, NoBoundIsClaimedForAnEngineThatSteps) {
  EXPECT_FALSE(make_pair_log(article_blocks(2), Engine::events)->bounds_at(3).has_value());
}

TEST(Accuracy, EnergyAndMomentumAreKept) {
  const TwoBlocks system = article_blocks(7);
  const auto log = make_pair_log(system);
  const double ratio = to_double(system.blue.mass / system.red.mass);
  for (long k = 1; k <= 3141592; k += 10007) {
    const PairCollision c = log->blocks_collision(k);
    const double energy =
        ratio * c.blue.velocity * c.blue.velocity + c.red.velocity * c.red.velocity;
    EXPECT_NEAR(energy, 1, 1e-15);
    if (c.kind == CollisionKind::blocks) {
      const PairCollision before = log->blocks_collision(Integer(std::max(1L, k - 1)));
      if (k == 1) continue;
      EXPECT_NEAR(ratio * c.blue.velocity + c.red.velocity,
                  ratio * before.blue.velocity + before.red.velocity, 1e-15);
    }
  }
}

}  // namespace
}  // namespace piblocks
