// Gaps to a relative error of a few roundings, where positions have lost them.
#include <gtest/gtest.h>
#include <piblocks/two_blocks.hpp>

#include <algorithm>
#include <cmath>
#include <string>

#include "support/oracle.hpp"
#include "support/random_system.hpp"
#include "support/traced_random.hpp"

namespace piblocks {
namespace {

constexpr double kBound = 16 * 0x1p-53;
/// Precision in bits that the oracle adds to its own.
constexpr std::int64_t kExtraBits = 1024;

struct ExactGaps {
  Rational y1;
  Rational y2;
};

ExactGaps gaps_of(const TwoBlocks& s, const Rational& blue, const Rational& red) {
  return {blue - s.blue.width / 2 - s.wall_face,
          red - s.wall_face - s.blue.width - s.red.width / 2};
}

double relative_error(double given, const Rational& wanted) {
  // The oracle finds 0 only to its precision.
  if (abs(wanted) < power(Rational(1, 2), 700)) return std::fabs(given) < 1e-200 ? 0 : HUGE_VAL;
  return std::fabs(to_double((Rational(given) - wanted) / wanted));
}

void expect_close(const Gaps& given, const ExactGaps& wanted) {
  EXPECT_LE(relative_error(given.y1, wanted.y1), kBound)
      << given.y1 << ", not " << to_double(wanted.y1);
  EXPECT_LE(relative_error(given.y2, wanted.y2), kBound)
      << given.y2 << ", not " << to_double(wanted.y2);
  EXPECT_GE(given.y1, 0);
  EXPECT_LE(given.y1, given.y2);
}

void expect_gaps(const TwoBlocks& system, const PairLog& log, const Rational& time) {
  SCOPED_TRACE("t = " + time.get_str());
  const auto state = oracle::high_precision_state(system, time, kExtraBits);
  const ExactGaps exact = gaps_of(system, state.blue.position, state.red.position);
  expect_close(log.gaps_at(time), exact);
  const double bound = log.y2_bound_at(time);
  EXPECT_GE(bound, to_double(exact.y2) * (1 - kBound));
  const double most = std::sqrt(1 + to_double(system.blue.mass / system.red.mass));  // 1 / cos θ
  if (is_elastic(system) && log.count_at(time) > 0) {
    EXPECT_LE(bound, to_double(exact.y2) * most * (1 + kBound));
  }
}

void expect_gaps_at_collision(const TwoBlocks& system, const PairLog& log, const Integer& index) {
  SCOPED_TRACE("collision " + index.get_str());
  const auto event = oracle::high_precision_collision(system, index, kExtraBits);
  const Gaps gaps = log.gaps_at_collision(index);
  expect_close(gaps, gaps_of(system, event.blue.position, event.red.position));
  if (event.kind == CollisionKind::wall) {
    EXPECT_EQ(gaps.y1, 0);
  } else {
    EXPECT_EQ(gaps.y1, gaps.y2);
  }
}

/// An index from 1 to the last, near either end, near the turn, or anywhere.
Integer any_index(Random& random, const Integer& size) {
  const Integer step(random.integer(0, 20));
  Integer index;
  switch (random.integer(0, 3)) {
    case 0:
      index = 1 + step;
      break;
    case 1:
      index = size - step;
      break;
    case 2:
      index = size / 2 + step - 10;
      break;
    default:
      index = 1 + size * random.integer(0, 999'999) / 1'000'000;
  }
  return std::clamp<Integer>(index, 1, size);
}

TEST(Gaps, AroundTheTurnAtAnyNumberOfDigits) {
  TracedRandom random(161803);
  for (int digits : {1, 2, 3, 4, 5, 6, 7, 9, 12, 15, 17, 20, 40, 100}) {
    SCOPED_TRACE(digits);
    TwoBlocks system = article_blocks(digits);
    // A wall elsewhere takes the digits from positions.
    if (digits % 2 == 0) {
      for (Rational* x : {&system.wall_face, &system.blue.position, &system.red.position}) {
        *x += digits % 4 == 0 ? Rational(-1, 2) : Rational(1'000'001, 3);
      }
    }
    const auto log = make_pair_log(system);
    const Rational turn = turn_of(system).value();
    expect_gaps(system, *log, turn);
    for (const char* text : {"-3", "0", "1", "4", "6", "15"}) {
      expect_gaps(system, *log, parse_rational(text));
    }
    const long scales = 7L * digits + 10;
    for (std::int64_t i = 0; i < many(40); ++i) {
      const auto scale = static_cast<unsigned long>(random.integer(0, scales));
      const Rational distance = Rational(random.uniform(-1, 1)) / power(2, scale);
      expect_gaps(system, *log, turn + distance);
    }
  }
}

TEST(Gaps, JustAfterACollision) {
  TracedRandom random(577215);
  for (int digits = 1; digits <= 20; ++digits) {
    SCOPED_TRACE(digits);
    const TwoBlocks system = article_blocks(digits);
    const auto log = make_pair_log(system);
    for (std::int64_t i = 0; i < many(10); ++i) {
      const Integer index = any_index(random, log->last());
      expect_gaps_at_collision(system, *log, index);
      const Rational time = log->time_after(index);
      expect_gaps(system, *log, time);
      expect_gaps(system, *log, time + power(Rational(1, 2), 200));
    }
  }
}

TEST(Gaps, OfRandomSystems) {
  TracedRandom random(141421);
  for (std::int64_t i = 0; i < many(150); ++i) {
    const TwoBlocks system = random_system(random, -4, 40);
    const auto log = make_pair_log(system);
    for (int j = 0; j < 4; ++j) expect_gaps(system, *log, random.rational(-10, 20, 1000));
    expect_gaps(system, *log, turn_of(system).value());
    if (log->last() == 0) continue;
    expect_gaps_at_collision(system, *log, any_index(random, log->last()));
  }
}

TEST(Gaps, BeforeAndAfterTheCorner) {
  // The blocks touch and move to the wall together: all collisions happen at once.
  TwoBlocks system = article_blocks(4);
  system.red.position = system.blue.position + (system.blue.width + system.red.width) / 2;
  system.blue.velocity = system.red.velocity;
  const auto log = make_pair_log(system);
  for (const char* text : {"0", "0.5", "1", "1.000000001", "2", "1000"}) {
    expect_gaps(system, *log, parse_rational(text));
  }
}

TEST(Gaps, OfALightRedBlockAreExact) {
  TwoBlocks system = article_blocks(1);
  system.red.mass = Rational(1, 3);
  const auto log = make_pair_log(system);
  for (int i = 0; i < 40; ++i) expect_gaps(system, *log, Rational(i) / 7);
  for (Integer k = 1; k <= log->last(); ++k) expect_gaps_at_collision(system, *log, k);
}

TEST(Gaps, OfEnginesThatStepAreDifferencesOfPositions) {
  const TwoBlocks system = article_blocks(3);
  const auto log = make_pair_log(system, Engine::events);
  const auto exact = make_pair_log(system);
  for (int i = 0; i < 200; ++i) {
    const Rational time = Rational(i) / 20;
    const Gaps gaps = log->gaps_at(time);
    EXPECT_NEAR(gaps.y1, exact->gaps_at(time).y1, 1e-9);
    EXPECT_NEAR(gaps.y2, exact->gaps_at(time).y2, 1e-9);
    EXPECT_GE(gaps.y1, 0);
    EXPECT_LE(gaps.y1, gaps.y2);
  }
  for (Integer k = 1; k <= log->last(); ++k) {
    const Gaps gaps = log->gaps_at_collision(k);
    EXPECT_EQ(gaps.y1, log->blocks_collision(k).kind == CollisionKind::wall ? 0 : gaps.y2);
    EXPECT_NEAR(gaps.y2, exact->gaps_at_collision(k).y2, 1e-9);
  }
}

}  // namespace
}  // namespace piblocks
