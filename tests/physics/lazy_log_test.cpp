// A log computes as far as it is asked for, and its answers do not depend on what was asked before.
#include <gtest/gtest.h>
#include <piblocks/error.hpp>
#include <piblocks/log.hpp>
#include <piblocks/two_blocks.hpp>

#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "support/property.hpp"

namespace piblocks {
namespace {

/// Blocks on a line or discs on a grid, open or enclosed, with immovable ones among them.
System random_system(Random& random) {
  System system;
  system.dimensions = int(random.integer(1, 2));
  const bool is_plane = system.dimensions == 2;
  const auto count = random.integer(2, 6);
  for (std::int64_t i = 0; i < count; ++i) {
    Body body{.mass = random.rational(1, 9, 7), .position = {Rational(3 * i)}};
    if (is_plane) body.position = {Rational(3 * (i % 3)), Rational(3 * (i / 3))};
    body.velocity[0] = random.rational(-3, 3, 7);
    if (is_plane) body.velocity[1] = random.rational(-3, 3, 7);
    if (i > 0 && random.integer(0, 4) == 0) body = {std::nullopt, body.position, {}, body.size};
    system.bodies.push_back(body);
  }
  if (random.integer(0, 1) == 1) system.walls.push_back({"left", {-2}, {1}});
  if (random.integer(0, 1) == 1) system.walls.push_back({"right", {20}, {-1}});
  if (is_plane && random.integer(0, 2) == 0) {
    system.walls.push_back({"lower", {0, -2}, {0, 1}});
    system.walls.push_back({"upper", {0, 5}, {0, -1}});
  }
  return system;
}

void expect_same_collision(const Collision& a, const Collision& b) {
  EXPECT_EQ(a.index, b.index);
  EXPECT_EQ(a.time, b.time);
  EXPECT_EQ(a.first, b.first);
  EXPECT_EQ(a.second, b.second);
  EXPECT_EQ(a.first_after, b.first_after);
  EXPECT_EQ(a.second_after, b.second_after);
}

TEST(LazyLog, AnswersAreThoseOfALongerRun) {
  int unending = 0;
  for (std::uint64_t i = 0; i < std::uint64_t(many(300)); ++i) {
    Random random(7'000 + i);
    SCOPED_TRACE(random.trace() + ", system " + std::to_string(i));
    const System system = random_system(random);
    const Rational until = random.rational(0, 12, 5);
    const auto whole = make_log(system, until + 10);
    whole->state_at(until + 10);
    unending += whole->never_ends() ? 1 : 0;

    const Integer count = whole->count_at(until);
    EXPECT_EQ(make_log(system)->count_at(until), count);
    const State state = make_log(system)->state_at(until);
    EXPECT_EQ(state.count, count);
    EXPECT_EQ(state.bodies, whole->state_at(until).bodies);
    if (count < 1) continue;
    const Integer index = 1 + Integer(long(random.integer(0, 1000))) % count;
    expect_same_collision(make_log(system)->collision(index), whole->collision(index));
    EXPECT_EQ(make_log(system)->first_since(whole->time_after(count)),
              whole->first_since(whole->time_after(count)));
    EXPECT_EQ(make_log(system)->certain_until(until), whole->certain_until(until));
    EXPECT_EQ(make_log(system)->first_tie(count), whole->first_tie(count));
  }
  EXPECT_GT(unending, many(60));
}

TEST(LazyLog, BeginsAtTimeZero) {
  EXPECT_THROW(make_log(article_system(3), Rational(-1)), UsageError);
  EXPECT_THROW(count_collisions(article_system(3), Rational(-1)), UsageError);
  EXPECT_THROW(make_log({1, {{1, {0}}, {1, {2}}, {1, {4}}}}, Rational(-1)), UsageError);
}

/// Between blocks of 10^14 and 10^40 times its mass a light one bounces some 10^7 times, first at
/// time 2.
TEST(LazyLog, DoesNotAskWhatHappensLater) {
  System system;
  system.bodies = {
      {1, {2}, {}, 1}, {power(100, 7), {5}, {-1}, 1}, {power(100, 20), {Rational(-1, 2)}, {}, 1}};
  const auto log = make_log(system);
  EXPECT_EQ(log->count_at(1), 0);
  EXPECT_TRUE(log->has(3));
  EXPECT_EQ(log->collision(1).time.hi, 2);
  EXPECT_THROW(log->last(), SimulationError);
  EXPECT_THROW(log->last(), SimulationError) << "again";
  EXPECT_EQ(log->count_at(1), 0) << "what was computed stays";
}

/// Discs whose near misses end certainty: what a later answer says of a time, the first one says.
TEST(LazyLog, CertaintyIsKnownAtOnce) {
  int ends = 0;
  for (std::uint64_t i = 0; i < std::uint64_t(many(40)); ++i) {
    Random random(500 + i);
    SCOPED_TRACE(random.trace() + ", system " + std::to_string(i));
    constexpr int kSide = 6;
    System system{2, {}, {{"left", {-2}, {1}}, {"right", {3 * kSide + 1}, {-1}}}};
    system.walls.push_back({"lower", {0, -2}, {0, 1}});
    system.walls.push_back({"upper", {0, 3 * kSide + 1}, {0, -1}});
    for (int k = 0; k < kSide * kSide; ++k) {
      system.bodies.push_back({.mass = random.integer(1, 9),
                               .position = {3 * (k % kSide) + random.rational(0, 1, 7),
                                            3 * (k / kSide) + random.rational(0, 1, 7)},
                               .velocity = {random.rational(-5, 5, 7), random.rational(-5, 5, 7)}});
    }
    const auto whole = make_log(system);
    const std::optional<double> until = whole->certain_until(30);
    if (!until) continue;
    ++ends;
    const Integer certain = whole->count_at(Rational(*until));
    for (Integer k = certain + 1; k < certain + 4; ++k) {
      const Rational next = to_rational(whole->collision(k).time);
      const Rational before = Rational(*until) + (next - Rational(*until)) * Rational(99, 100);
      EXPECT_EQ(make_log(system)->certain_until(before), until);
    }
  }
  EXPECT_GT(ends, many(10));
}

/// A miss by 10^-28 of what truly is a collision.
TEST(LazyLog, WhatIsMissedEndsCertaintyOfTheWholeRun) {
  System system{2, {}, {}};
  system.bodies.push_back({.position = {0, 0}});
  system.bodies.push_back({.position = {-10, 2 - 1 / Rational(power(10, 28))}, .velocity = {1, 0}});
  const auto log = make_log(system);
  EXPECT_EQ(log->last(), 0);
  EXPECT_NEAR(log->certain_until(std::nullopt).value_or(0), 10, 1e-6);
}

/// After a collision, rounding errors of velocities bring a disc to the wall it goes along, in some
/// 10^14 time units.
TEST(LazyLog, RoundingErrorsOfLongAgoEndNoRun) {
  System system{2, {}, {{"lower", {0, Rational(-7, 3)}, {0, 1}}}};
  system.bodies.push_back({.position = {0, 0}, .velocity = {Rational(1, 3), 0}});
  system.bodies.push_back({.mass = 3, .position = {4, 0}});
  const auto log = make_log(system);
  EXPECT_EQ(log->last(), 1);
  EXPECT_EQ(log->certain_until(std::nullopt), std::nullopt);
  EXPECT_LT(log->certain_until(Rational(power(10, 30))).value_or(1e31), 1e30);
}

TEST(LazyLog, TiesAreSeenAtTimesThatAreNoBinaryFractions) {
  System system{1, {}, {}};
  for (const int x : {-2, 0, 2}) {
    system.bodies.push_back({.position = {Rational(x)}, .velocity = {Rational(-3 * x, 2)}});
  }
  EXPECT_EQ(make_log(system)->last(), 3);
  EXPECT_THROW(make_log(system)->time_after(1), UsageError);
  EXPECT_THROW(make_log(system)->time_after(2), UsageError);
}

TEST(LazyLog, StopsWhenItIsAsked) {
  System box{1, {{1, {5}, {1}, 1}}, {{"left", {0}, {1}}, {"right", {10}, {-1}}}};
  std::stop_source source;
  const auto log = make_log(box, std::nullopt, source.get_token());
  EXPECT_EQ(log->count_at(100), 11);
  source.request_stop();
  EXPECT_EQ(log->count_at(90), 10) << "what is known stays known";
  EXPECT_THROW(log->count_at(1'000'000), Interrupted);
}

/// Rounding may exchange collisions that happen together, and everything after them.
TEST(EventEngine, StepsAnySystemAsTheOthersDo) {
  int compared = 0;
  int at_walls = 0;
  for (std::uint64_t i = 0; i < std::uint64_t(many(300)); ++i) {
    Random random(9'000 + i);
    const System system = random_system(random);
    SCOPED_TRACE(random.trace() + ", system " + std::to_string(i));
    const auto right = make_log(system);
    const auto stepped = make_log(system, {}, {}, Engine::events);
    double before = -1;
    for (Integer k = 1; k <= 20 && right->has(k); ++k) {
      ASSERT_TRUE(stepped->has(k));
      const Collision a = right->collision(k);
      const Collision b = stepped->collision(k);
      if (a.time.hi - before < 1e-6 || right->certain_until(to_rational(a.time))) break;
      if (right->has(k + 1) && right->collision_time(k + 1).hi - a.time.hi < 1e-6) break;
      before = a.time.hi;
      EXPECT_NEAR(b.time.hi, a.time.hi, 1e-9 * (1 + a.time.hi));
      ASSERT_EQ(std::pair(b.first, b.second), std::pair(a.first, a.second)) << "#" << k.get_str();
      for (const std::size_t axis : {0U, 1U}) {
        EXPECT_NEAR(b.first_after.position.at(axis), a.first_after.position.at(axis), 1e-7);
        EXPECT_NEAR(b.first_after.velocity.at(axis), a.first_after.velocity.at(axis), 1e-7);
      }
      ++compared;
      at_walls += a.second >= system.bodies.size() ? 1 : 0;
    }
  }
  EXPECT_GT(compared, many(600));
  EXPECT_GT(at_walls, many(100));
}

TEST(EventEngine, SaysHowManyBodiesItSteps) {
  System system;
  for (std::size_t i = 0; i <= kMaxEventBodies; ++i) {
    system.bodies.push_back({.position = {Rational(2 * i)}});
  }
  EXPECT_THROW(make_log(system, {}, {}, Engine::events), UsageError);
  system.bodies.pop_back();
  EXPECT_EQ(make_log(system, {}, {}, Engine::events)->last(), 0);
}

TEST(LazyLog, RejectsWhatIsNoSystem) {
  EXPECT_THROW(make_log({}), SceneError);
  System overlapping{1, {{1, {0}, {}, 1}, {1, {Rational(1, 2)}, {}, 1}}, {}};
  EXPECT_THROW(make_log(overlapping), SceneError);
}

TEST(LazyLog, OnlyTheLastCollisionOfWhatMayNeverEndNeedsAHorizon) {
  const Body fixed{std::nullopt, {}, {}, 1};
  System discs{2, {fixed, fixed, {1, {5, 0}, {1, Rational(1, 100)}, 1}}, {}};
  discs.bodies[1].position = {10, 0};
  for (System system : {discs, System{1, {{1, {5}, {1}, 1}}, {}}}) {
    if (system.dimensions == 1) system.walls = {{"left", {0}, {1}}, {"right", {10}, {-1}}};
    const auto log = make_log(system);
    EXPECT_TRUE(log->never_ends());
    EXPECT_FALSE(log->has_last());
    EXPECT_THROW(log->last(), UsageError);
    EXPECT_EQ(make_log(system, 30)->last(), log->count_at(30));
    EXPECT_GT(log->count_at(30), 0);
  }
  discs.bodies.erase(discs.bodies.begin());
  EXPECT_FALSE(make_log(discs)->never_ends());
  EXPECT_EQ(make_log(discs)->last(), 1);
}

}  // namespace
}  // namespace piblocks
