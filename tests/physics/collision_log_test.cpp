#include <gtest/gtest.h>
#include <piblocks/error.hpp>
#include <piblocks/two_blocks.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "support/state_after.hpp"

namespace piblocks {
namespace {

constexpr const char* kDigitsOfPi = "31415926535897932384626433832795028841971693993751";

/// A system by its gaps: wall face at 0, unit blocks.
struct Start {
  const char* ratio;
  const char* blue_gap;
  const char* blocks_gap;
  const char* blue_velocity;
  const char* red_velocity;

  TwoBlocks system() const {
    TwoBlocks s;
    s.blue.mass = 1;
    s.red.mass = parse_rational(ratio);
    s.blue.position = parse_rational(blue_gap) + Rational(1, 2);
    s.red.position = s.blue.position + 1 + parse_rational(blocks_gap);
    s.blue.velocity = parse_rational(blue_velocity);
    s.red.velocity = parse_rational(red_velocity);
    return s;
  }
};

Integer total(const Start& start) {
  const Integer size = make_pair_log(start.system())->last();
  EXPECT_EQ(count_collisions(start.system()), size);
  return size;
}

TEST(Count, IsTheFirstDigitsOfPi) {
  for (int digits = 1; digits <= 50; ++digits) {
    const Integer expected(std::string(kDigitsOfPi).substr(0, static_cast<std::size_t>(digits)));
    EXPECT_EQ(make_pair_log(article_blocks(digits))->last(), expected);
    EXPECT_EQ(count_collisions(article_blocks(digits)), expected);
  }
  EXPECT_TRUE(count_collisions(article_blocks(2000)).get_str().starts_with(kDigitsOfPi));
}

/// floor(pi * base^places), by the digits.
Integer floor_of_pi(int base, int places) {
  const std::string whole = pi_digits(base, 2).substr(0, base < 4 ? 2 : 1);
  std::string digits = pi_digits(base, whole.size() + static_cast<std::size_t>(places));
  std::erase(digits, '.');
  return Integer(digits, base);
}

/// 19/6 and 22/7 are so little above pi that these ratios of masses count to them.
const std::vector<int> kRootsOfExceptions = {6, 7, 14, 21, 28};

TEST(Count, IsPiTimesTheRootOfTheMassRatioButForAFew) {
  const Integer scale = power(10, 30).get_num();
  std::string digits = pi_digits(10, 31);
  std::erase(digits, '.');
  std::vector<int> exceptions;
  for (int root = 1; root < 113; ++root) {
    TwoBlocks system;
    system.red.mass = root * root;
    if (count_collisions(system) != Integer(digits, 10) * root / scale) exceptions.push_back(root);
  }
  EXPECT_EQ(exceptions, kRootsOfExceptions);
}

TEST(Count, IsPiInEveryBaseButForAFew) {
  std::vector<int> exceptions;
  for (int base = kMinBase; base <= kMaxBase; ++base) {
    for (int digits = 1; digits <= 40; ++digits) {
      const Integer counted = count_collisions(article_blocks(digits, base));
      const Integer expected = floor_of_pi(base, digits - 1);
      if (counted == expected) continue;
      EXPECT_EQ(counted, expected + 1);
      EXPECT_EQ(digits, 2) << base;
      exceptions.push_back(base);
    }
  }
  EXPECT_EQ(exceptions, kRootsOfExceptions);
  EXPECT_EQ(count_collisions(article_blocks(3, 2)), 12);
  EXPECT_EQ(count_collisions(article_blocks(4, 2)), 25);
}

TEST(Count, DoesNotDependOnTheStartingGaps) {
  for (const char* gap : {"1e-100", "0.001", "1", "1e15", "1e100"}) {
    EXPECT_EQ(total({"10000", gap, "2", "0", "-1"}), 314);
    EXPECT_EQ(total({"10000", "3/2", gap, "0", "-1"}), 314);
  }
}

TEST(Count, DoesNotDependOnTheScaleOfVelocitiesAndMasses) {
  for (const char* speed : {"-5e-324", "-1e-300", "-1", "-1e155", "-1e300"}) {
    EXPECT_EQ(total({"10000", "3/2", "2", "0", speed}), 314) << speed;
  }
  for (const char* unit : {"1e-320", "1e-200", "1e154", "1e300"}) {
    TwoBlocks system = article_blocks(3);
    system.blue.mass *= parse_rational(unit);
    system.red.mass *= parse_rational(unit);
    EXPECT_EQ(count_collisions(system), 314) << unit;
  }
}

TEST(Count, IsRightBesideTheExactRatios) {
  // pi/theta is whole only for the ratios 1/3, 1 and 3 (Niven): the last ray is never reached.
  const auto beside = [](double ratio) {
    TwoBlocks system;
    system.red.mass = Rational(ratio);
    return count_collisions(system);
  };
  EXPECT_EQ(beside(std::nextafter(1.0, 0.0)), 3);
  EXPECT_EQ(beside(std::nextafter(1.0, 2.0)), 4);
  EXPECT_EQ(beside(std::nextafter(3.0, 0.0)), 5);
  EXPECT_EQ(beside(std::nextafter(3.0, 4.0)), 6);
}

TEST(Count, IsRightWhereSimpleFormulasFail) {
  EXPECT_EQ(total({"2", "3/2", "2", "0", "-1"}), 5);
  EXPECT_EQ(total({"10", "3/2", "2", "0", "-1"}), 10);
  EXPECT_EQ(total({"0.1", "3/2", "2", "0", "-1"}), 2);
  EXPECT_EQ(total({"1e32", "3/2", "2", "0", "-1"}), Integer("31415926535897932"))
      << "the nearest double to 1e32 gives another count";
}

TEST(Count, IsZeroWhereNothingMeets) {
  EXPECT_EQ(total({"0.01", "3/2", "2", "0", "0"}), 0);
  EXPECT_EQ(total({"100", "0", "0", "0", "0"}), 0);
}

TEST(Count, FollowsTheConventionAtCorners) {
  // Blue rests on the wall: the blocks meet first, as for a wall a hair further away.
  EXPECT_EQ(total({"100", "0", "3/2", "0", "-1"}), 31);
  // Both gaps closed, red pushing: everything happens at time 0.
  EXPECT_EQ(make_pair_log(Start{"100", "0", "0", "0", "-1"}.system())->blocks_at(0).count, 31);
}

TEST(Flights, AreHalfOpen) {
  // The blocks meet at t = 2/(3/10) = 20/3, a time that no double can hold.
  const auto log = make_pair_log(Start{"100", "3/2", "2", "0", "-0.3"}.system());
  const Rational meeting(20, 3);
  EXPECT_EQ(log->blocks_at(meeting).count, 1);
  EXPECT_EQ(log->blocks_at(meeting - parse_rational("1e-40")).count, 0);
  EXPECT_EQ(log->blocks_at(meeting + parse_rational("1e-40")).count, 1);
}

TEST(Flights, CountACollisionAtTimeZero) {
  EXPECT_EQ(make_pair_log(Start{"100", "3/2", "0", "0", "-1"}.system())->blocks_at(0).count, 1);
  EXPECT_EQ(make_pair_log(Start{"100", "3/2", "0", "0", "1"}.system())->blocks_at(0).count, 0);
  EXPECT_EQ(make_pair_log(Start{"100", "0", "2", "-1", "0"}.system())->blocks_at(0).count, 1);
  EXPECT_EQ(make_pair_log(Start{"100", "0", "2", "1", "0"}.system())->blocks_at(0).count, 0);
  EXPECT_EQ(make_pair_log(Start{"0.5", "3/2", "0", "0", "-1"}.system())->blocks_at(0).count, 1);
}

// The rounding of an engine must not carry the first collision past time 0, nor away from it.
TEST(Flights, OfEveryEngineBeginToCountAtTimeZero) {
  for (const Start& start :
       {Start{"1000", "5/12", "0", "0", "12/7"}, Start{"23122/3", "2/3", "0", "0", "15/2"},
        Start{"52429/84", "5/2", "0", "40/3", "-17/2"}, Start{"1", "5", "0", "5", "29/14"},
        Start{"66096/61", "69/4", "0", "-29/19", "-9/13"}, Start{"7", "0", "2/7", "-1", "-1/3"},
        Start{"100", "1/3", "0", "34/19", "-8/9"}, Start{"31", "56/22", "0", "0", "-1/2"},
        Start{"7", "0", "2/7", "1/3", "-1/3"}, Start{"37", "35/12", "0", "-35", "-3/5"}}) {
    const TwoBlocks system = start.system();
    const auto exact = make_pair_log(system);
    const auto log = make_pair_log(system, Engine::events);
    EXPECT_EQ(log->blocks_at(0).count, exact->blocks_at(0).count) << start.ratio;
    EXPECT_EQ(log->first_index(), exact->first_index()) << start.ratio;
    EXPECT_TRUE(log->last() == 0 || log->blocks_collision(1).time.hi >= 0) << start.ratio;
    EXPECT_TRUE(log->first_index() == 1 || log->blocks_collision(0).time.hi <= 0) << start.ratio;
  }
}

TEST(Flights, GoOnBeforeTheFirstAndAfterTheLastCollision) {
  for (const Engine engine : {Engine::unfolded, Engine::events}) {
    const auto log = make_pair_log(article_blocks(3), engine);
    EXPECT_NEAR(log->blocks_at(-1000).red.position, 1005, 1e-10);
    EXPECT_NEAR(log->blocks_at(-1000).blue.position, 2, 1e-10);
    const PairState last = state_after(*log, 314);
    const double duration = 1000 - log->blocks_collision(314).time.hi;
    const PairState later = log->blocks_at(1000);
    EXPECT_NEAR(later.blue.position, last.blue.position + duration * last.blue.velocity, 1e-9);
    EXPECT_NEAR(later.red.position, last.red.position + duration * last.red.velocity, 1e-9);
  }
}

TEST(Flights, CountBackwardsBeforeTimeZero) {
  // Blue comes off the wall, which it must have met before.
  for (const char* ratio : {"100", "1", "0.5"}) {
    const auto log = make_pair_log(Start{ratio, "1", "3", "1", "-1"}.system());
    EXPECT_EQ(log->blocks_at(0).count, 0) << ratio;
    EXPECT_EQ(log->blocks_at(Rational(-3, 2)).count, -1) << ratio;
    EXPECT_NEAR(log->blocks_at(Rational(-3, 2)).blue.position, 1, 1e-14) << ratio;
    EXPECT_NEAR(log->blocks_at(Rational(-3, 2)).blue.velocity, -1, 1e-14) << ratio;
  }
}

TEST(Log, AlternatesAndBeginsWithTheBlocks) {
  for (const Engine engine : {Engine::unfolded, Engine::events}) {
    const auto log = make_pair_log(article_blocks(3), engine);
    double before = 0;
    for (long k = 1; k <= 314; ++k) {
      const PairCollision c = log->blocks_collision(k);
      EXPECT_EQ(c.index, k);
      EXPECT_EQ(c.kind, k % 2 == 1 ? CollisionKind::blocks : CollisionKind::wall);
      EXPECT_GT(c.time.hi, before);
      before = c.time.hi;
      if (c.kind == CollisionKind::wall) {
        EXPECT_GT(c.blue.velocity, 0);
        EXPECT_NEAR(c.blue.position, 0.5, 1e-10);
      } else {
        EXPECT_NEAR(c.red.position - c.blue.position, 1, 1e-10);
      }
    }
  }
}

/// Collision k of both to `tolerance`.
void expect_same(const PairCollision& a, const PairCollision& b, double tolerance) {
  SCOPED_TRACE("collision " + a.index.get_str());
  EXPECT_EQ(a.index, b.index);
  EXPECT_EQ(a.kind, b.kind);
  EXPECT_NEAR(a.time.hi, b.time.hi, tolerance * (1 + std::fabs(a.time.hi)));
  EXPECT_GE(a.time.hi, 0);
  EXPECT_NEAR(a.blue.position, b.blue.position, tolerance);
  EXPECT_NEAR(a.red.position, b.red.position, tolerance);
  EXPECT_NEAR(a.blue.velocity, b.blue.velocity, tolerance * (1 + std::fabs(a.blue.velocity)));
  EXPECT_NEAR(a.red.velocity, b.red.velocity, tolerance);
}

TEST(Log, EnginesAgree) {
  for (int digits = 1; digits <= 5; ++digits) {
    const auto unfolded = make_pair_log(article_blocks(digits), Engine::unfolded);
    const auto stepped = make_pair_log(article_blocks(digits), Engine::events);
    ASSERT_EQ(unfolded->last(), stepped->last());
    for (long k = 1; k <= unfolded->last(); ++k) {
      expect_same(unfolded->blocks_collision(k), stepped->blocks_collision(k), 1e-8);
      ASSERT_FALSE(HasFailure());
    }
  }
}

// With equal masses the last ray would be parallel to the line; a hair heavier, red lets blue catch
// up with the wall again, after about 1e90 s.
TEST(Log, KeepsAHairBetweenTheMasses) {
  TwoBlocks system = article_blocks(1);
  system.red.mass = 1 + 1 / power(2, 300);
  const auto log = make_pair_log(system);
  EXPECT_EQ(log->last(), 4);
  const PairCollision last = log->blocks_collision(4);
  EXPECT_EQ(last.kind, CollisionKind::wall);
  EXPECT_GT(last.time.hi, 1e89);
  EXPECT_LT(last.time.hi, 1e92);
  EXPECT_EQ(last.blue.position, to_double(system.wall_face + system.blue.width / 2));
}

TEST(Log, EnginesAgreeOnEveryKindOfStart) {
  for (const Start& start :
       {Start{"100", "1", "1", "-1", "-2"}, Start{"100", "1", "1", "2", "-1"},
        Start{"0.5", "1", "3", "1", "-1"}, Start{"1", "3/2", "2", "0", "-1"},
        Start{"100", "3/2", "0", "-1", "-1"}, Start{"100", "0", "0", "0", "-1"},
        Start{"100", "3/2", "2", "0", "1"}, Start{"7", "0", "2", "-1", "-1/3"}}) {
    const auto unfolded = make_pair_log(start.system());
    const auto stepped = make_pair_log(start.system(), Engine::events);
    ASSERT_EQ(unfolded->last(), stepped->last());
    for (long k = 1; k <= unfolded->last(); ++k) {
      expect_same(unfolded->blocks_collision(k), stepped->blocks_collision(k), 1e-13);
    }
  }
}

/// The row of a batch as the collision that at() gives.
PairCollision row_of(const PairBatch& batch, std::size_t row) {
  return {batch.first + static_cast<unsigned long>(row),
          {batch.time_hi[row], batch.time_lo[row]},
          batch.kind[row],
          {batch.blue_position[row], batch.blue_velocity[row]},
          {batch.red_position[row], batch.red_velocity[row]}};
}

/// The stream from `first` to `last` has exactly the collisions of at(), to a few ulp.
void expect_streamed(const PairLog& log, const Integer& first, const Integer& last) {
  const auto batch = std::make_unique<PairBatch>();
  const auto stream = log.stream(first, last);
  Integer next = first;
  while (stream->read(*batch)) {
    ASSERT_EQ(batch->first, next);
    ASSERT_GT(batch->size, 0U);
    for (std::size_t row = 0; row < batch->size; ++row) {
      expect_same(log.blocks_collision(next), row_of(*batch, row), 2e-15);
      ++next;
    }
  }
  EXPECT_EQ(next, std::max<Integer>(first, last + 1));
  EXPECT_EQ(batch->size, 0U);
  EXPECT_FALSE(stream->read(*batch)) << "an ended stream stays ended";
}

TEST(Stream, HasEveryCollisionOfAnyRange) {
  for (const Engine engine : {Engine::unfolded, Engine::events}) {
    for (const int digits : {1, 2, 3, 4}) {
      const auto log = make_pair_log(article_blocks(digits), engine);
      expect_streamed(*log, 1, log->last());
    }
    const auto log = make_pair_log(article_blocks(4), engine);
    for (const long first : {1L, 2L, 63L, 64L, 1500L, 1571L, 2000L, 3141L}) {
      for (const long length : {0L, 1L, 2L, 63L, 64L, 65L, 511L, 513L, 1000L}) {
        expect_streamed(*log, first, std::min<Integer>(log->last(), first + length - 1));
      }
    }
  }
}

TEST(Stream, StartsAnywhereInALogOfAnySize) {
  for (const int digits : {9, 16, 20, 40, 150}) {
    const auto log = make_pair_log(article_blocks(digits));
    const Integer middle = log->last() / 2;
    for (const Integer& first : {Integer(1), Integer(middle - 700), Integer(log->last() - 1200)}) {
      expect_streamed(*log, first, first + 1100);
    }
  }
}

TEST(Stream, KnowsMirroredAndLightSystems) {
  for (const Start& start :
       {Start{"1000", "0", "3/2", "-1", "-1"}, Start{"0.5", "1", "3", "1", "-1"},
        Start{"100", "3/2", "0", "-1", "-1"}, Start{"100", "3/2", "2", "0", "0"}}) {
    const auto log = make_pair_log(start.system());
    expect_streamed(*log, 1, log->last());
  }
}

TEST(Log, RefusesInvalidSystems) {
  TwoBlocks overlapping;
  overlapping.red.position = Rational(29, 10);
  EXPECT_THROW(make_pair_log(overlapping), SceneError);
  EXPECT_THROW(count_collisions(overlapping), SceneError);
  EXPECT_THROW(article_blocks(0), UsageError);
  EXPECT_THROW(article_blocks(kMaxDigits + 1), UsageError);
  EXPECT_THROW(article_blocks(3, kMinBase - 1), UsageError);
  EXPECT_THROW(article_blocks(3, kMaxBase + 1), UsageError);
}

TEST(Log, RefusesToStoreTooMuchAndRatiosBeyondItsRange) {
  EXPECT_THROW(make_pair_log(article_blocks(8), Engine::events), UsageError);
  EXPECT_THROW(make_pair_log(article_blocks(400)), UsageError);
  EXPECT_EQ(make_pair_log(article_blocks(300))->last().get_str().size(), 300u);
}

}  // namespace
}  // namespace piblocks
