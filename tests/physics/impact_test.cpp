// Collisions taken together, against all of them one by one and against what they do to the blocks.
#include "physics/impact.hpp"

#include <gtest/gtest.h>
#include <piblocks/system.hpp>
#include <piblocks/two_blocks.hpp>

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "support/oracle.hpp"

namespace piblocks {
namespace {

constexpr CollisionKind kKinds[] = {CollisionKind::wall, CollisionKind::blocks};

struct Moments {
  double impulse = 0;
  double delay = 0;  ///< impulses times the times since the turn, over impulse
  bool is_empty = true;
};

/// Impulses in the unit of Impact: of the velocities just after a collision, which it turned round.
Moments one_by_one(const TwoBlocks& system, const PairLog& log, CollisionKind kind,
                   const Integer& first, const Integer& last, const Time& since) {
  const double r = to_double(system.blue.mass / system.red.mass);
  Moments sum;
  double moment = 0;
  for (Integer index = first; index <= last; ++index) {
    const PairCollision c = log.blocks_collision(index);
    if (c.kind != kind) continue;
    const double speed = std::hypot(std::sqrt(r) * c.blue.velocity, c.red.velocity);
    const double blow = kind == CollisionKind::wall ? (1 + r) * std::fabs(c.blue.velocity)
                                                    : std::fabs(c.red.velocity - c.blue.velocity);
    sum.impulse += blow / speed;
    moment += blow / speed * ((c.time.hi - since.hi) + (c.time.lo - since.lo));
    sum.is_empty = false;
  }
  sum.delay = sum.is_empty ? 0 : moment / sum.impulse;
  return sum;
}

void expect_sum(const TwoBlocks& system, const PairLog& log, CollisionKind kind,
                const Integer& first, const Integer& last) {
  SCOPED_TRACE(first.get_str() + " to " + last.get_str());
  const Time since = first <= last ? log.blocks_collision(first).time : Time{};
  const Moments expected = one_by_one(system, log, kind, first, last, since);
  const auto together = log.impact(kind, first, last);
  ASSERT_EQ(together.has_value(), !expected.is_empty);
  if (!together) return;
  EXPECT_EQ(together->kind, kind);
  EXPECT_NEAR(together->impulse, expected.impulse, 1e-12 * expected.impulse);
  const double delay = (together->time.hi - since.hi) + (together->time.lo - since.lo);
  EXPECT_NEAR(delay, expected.delay, 1e-12 * (1 + std::fabs(expected.delay)));
}

std::vector<TwoBlocks> systems() {
  std::vector<TwoBlocks> result;
  for (int digits = 1; digits <= 4; ++digits) result.push_back(article_blocks(digits));
  result.push_back(article_blocks(3));
  result.back().blue.velocity = -1;  // the wall first
  result.push_back(article_blocks(1));
  result.back().red.mass = Rational(1, 50);
  result.push_back(article_blocks(3));
  result.back().blue.position = Rational(1, 2);  // all at once, in the corner
  result.push_back(article_blocks(2));
  result.back().blue = {Rational(3, 7), 3, Rational(-1, 3), Rational(1, 2)};
  return result;
}

TEST(Impact, IsTheSumOfItsCollisionsByEveryEngine) {
  for (const TwoBlocks& system : systems()) {
    SCOPED_TRACE("ratio " + system.red.mass.get_str());
    for (const Engine engine : {Engine::unfolded, Engine::events}) {
      if (corner_of(system) && engine == Engine::events) continue;  // has no order for them
      const auto log = make_pair_log(system, engine);
      const Integer last = log->last();
      for (const CollisionKind kind : kKinds) {
        expect_sum(system, *log, kind, 1, last);
        expect_sum(system, *log, kind, 1, 1);
        expect_sum(system, *log, kind, last, last);
        expect_sum(system, *log, kind, last / 3 + 1, last / 2 + 1);
        expect_sum(system, *log, kind, last / 2, last - 1);
        EXPECT_FALSE(log->impact(kind, 2, 1).has_value());
      }
    }
  }
}

TEST(Impact, OfOneCollisionIsWhereAndWhenThatIs) {
  const TwoBlocks system = article_blocks(3);
  const auto log = make_pair_log(system);
  for (Integer index = 1; index <= log->last(); ++index) {
    const PairCollision c = log->blocks_collision(index);
    const auto together = log->impact(c.kind, index, index);
    ASSERT_TRUE(together.has_value());
    EXPECT_EQ(together->time, c.time);
    // Blue is 1 wide, and meets the wall with its left side.
    const double to_contact = c.kind == CollisionKind::wall ? -0.5 : 0.5;
    EXPECT_NEAR(together->position, c.blue.position + to_contact, 1e-13);
  }
  // The first blow is red's, with nearly all the energy, to resting blue.
  EXPECT_NEAR(log->impact(CollisionKind::blocks, 1, 1)->impulse, 1, 1e-12);
}

TEST(Impact, GoesOnBeforeTimeZero) {
  TwoBlocks system = article_blocks(3);
  const auto whole = make_pair_log(system);
  // The same run, with time 0 in the middle of it.
  const oracle::ExactState start =
      oracle::exact_state(system, oracle::exact_run(system, 1000), parse_rational("3.49"));
  const long before = start.count.get_si();
  system.blue = {system.blue.mass, start.blue.position, start.blue.velocity, system.blue.width};
  system.red = {system.red.mass, start.red.position, start.red.velocity, system.red.width};
  for (const Engine engine : {Engine::unfolded, Engine::events}) {
    const auto log = make_pair_log(system, engine);
    EXPECT_EQ(log->count_near(to_time(Rational(-1000))), -before);
    for (const CollisionKind kind : kKinds) {
      for (long first : {1L, 7L, before - 3, before + 1}) {
        const auto expected = whole->impact(kind, first, first + 9);
        const auto together = log->impact(kind, first - before, first + 9 - before);
        ASSERT_TRUE(together && expected);
        EXPECT_NEAR(together->impulse, expected->impulse, 1e-8 * expected->impulse);
        EXPECT_NEAR(together->time.hi + 3.49, expected->time.hi, 1e-8);
      }
    }
  }
}

/// What the impulses between two times do to the blocks: red's change of velocity is that of all
/// the blocks' collisions, the change of momentum is the wall's; and the later they are, the less
/// far both get.
void expect_oracles_motion(const TwoBlocks& system, const PairLog& log, const Rational& from,
                           const Rational& to) {
  SCOPED_TRACE(from.get_str() + " to " + to.get_str());
  const auto before = oracle::high_precision_state(system, from);
  const auto after = oracle::high_precision_state(system, to);
  const Rational& m = system.blue.mass;
  const Rational& big = system.red.mass;
  const auto momentum = [&](const oracle::ExactState& s) {
    return Rational(m * s.blue.velocity + big * s.red.velocity);
  };
  const auto moment = [&](const oracle::ExactState& s) {
    return Rational(m * s.blue.position + big * s.red.position);
  };
  const double speed =
      std::sqrt(to_double(Rational(m / big * system.blue.velocity * system.blue.velocity +
                                   system.red.velocity * system.red.velocity)));
  const double unit = to_double(2 * m * big / (m + big)) * speed;
  const Integer first = before.count + 1;
  for (const CollisionKind kind : kKinds) {
    const bool wall = kind == CollisionKind::wall;
    const Rational blow = wall ? Rational(momentum(after) - momentum(before))
                               : Rational(big * (after.red.velocity - before.red.velocity));
    const Rational way =
        wall ? Rational(moment(after) - moment(before) - momentum(before) * (to - from))
             : Rational(big * (after.red.position - before.red.position -
                               before.red.velocity * (to - from)));
    const auto together = log.impact(kind, first, after.count);
    ASSERT_TRUE(together.has_value());
    EXPECT_NEAR(together->impulse, to_double(blow) / unit, 1e-11 * to_double(blow) / unit);
    const Rational centre = to - way / blow;
    EXPECT_NEAR(to_double(to_rational(together->time) - centre), 0, 1e-11 * to_double(to - from));
  }
}

TEST(Impact, DoesToTheBlocksWhatTheOracleSaysAtAnyNumberOfDigits) {
  for (int digits : {2, 5, 9, 20, 60}) {
    SCOPED_TRACE(digits);
    const TwoBlocks system = article_blocks(digits);
    const auto log = make_pair_log(system);
    expect_oracles_motion(system, *log, 0, 10);
    expect_oracles_motion(system, *log, 3, parse_rational("3.6"));
    expect_oracles_motion(system, *log, 0, parse_rational("3.4"));
    expect_oracles_motion(system, *log, parse_rational("3.55"), 9);
  }
}

TEST(CountNear, IsTheCountButForCollisionsWithinItsRounding) {
  for (int digits : {1, 3, 6, 12, 20}) {
    const auto log = make_pair_log(article_blocks(digits));
    for (const char* text :
         {"-3", "0", "1", "2.1", "3.4", "3.4999", "3.5000001", "4", "5.5", "50"}) {
      const Rational t(parse_rational(text));
      const Integer exact = log->blocks_at(t).count;
      const Integer near = log->count_near(to_time(t));
      EXPECT_LE(abs(near - exact), 1 + abs(exact) / 1'000'000'000'000) << digits << " at " << text;
    }
  }
}

TEST(CountNear, IsExactWhereCollisionsAreStored) {
  TwoBlocks system = article_blocks(1);
  for (const Engine engine : {Engine::unfolded, Engine::events}) {
    const auto log = make_pair_log(system, engine);  // at 2, 3 and 4
    EXPECT_EQ(log->count_near({1.99, 0}), 0);
    EXPECT_EQ(log->count_near({2.01, 0}), 1);
    EXPECT_EQ(log->count_near({3.5, 0}), 2);
    EXPECT_EQ(log->count_near({1e9, 0}), 3);
    EXPECT_EQ(log->count_near({-1e9, 0}), 0);
  }
}

TEST(CountNear, CountsAllOfACornerAtOnce) {
  TwoBlocks system = article_blocks(3);
  system.blue.position = Rational(1, 2);
  const auto log = make_pair_log(system);
  const Rational corner = corner_of(system)->time;
  EXPECT_EQ(log->count_near(to_time(corner)), log->last());
  EXPECT_EQ(log->count_near(to_time(corner - Rational(1, 1000000))), 0);
}

/// Of bodies that are two blocks by other names, mirrored and not.
TEST(Impact, SumsThoseOfBodiesInClosedForm) {
  for (const int side : {1, -1}) {
    const Rational mass = 1'000'000;
    const System system{
        1,
        {{mass, {side * 5}, {-side * 2}, 1}, {Rational(3), {side * 2}, {side * Rational(1, 8)}, 1}},
        {{side > 0 ? "left" : "right", {0}, {side}}}};
    const auto log = make_log(system);
    ASSERT_GT(log->last(), 1000);
    for (const CollisionKind kind : kKinds) {
      for (const auto& [first, last] : {std::pair(1, 1001), std::pair(500, 502)}) {
        double impulse = 0;
        for (Integer index = first; index <= last; ++index) {
          if (const auto one = log->impact(kind, index, index)) impulse += one->impulse;
        }
        const auto together = log->impact(kind, first, last);
        ASSERT_TRUE(together);
        EXPECT_NEAR(together->impulse, impulse, 1e-11 * impulse);
        EXPECT_GE(side * together->position, 0);
        EXPECT_GE(together->time.hi, log->collision(first).time.hi);
        EXPECT_LE(together->time.hi, log->collision(last).time.hi);
      }
    }
  }
}

}  // namespace
}  // namespace piblocks
