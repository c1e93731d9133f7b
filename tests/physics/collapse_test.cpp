// Infinitely many collisions in a finite time: which systems have them, against the literature.
#include <gtest/gtest.h>
#include <piblocks/error.hpp>
#include <piblocks/log.hpp>
#include <piblocks/two_blocks.hpp>

#include <cmath>

#include "physics/logs.hpp"
#include "support/contains.hpp"
#include "support/inelastic_checks.hpp"
#include "support/message_of.hpp"
#include "support/property.hpp"
#include "support/stepped_checks.hpp"
#include "support/traced_random.hpp"

namespace piblocks {
namespace {

/// Equal balls that run into each other, all in a row.
System row_of(Random& random, int count, const Rational& e) {
  System row{.restitution = e, .wall_restitution = e};
  for (int i = 0; i < count; ++i) {
    row.bodies.push_back({.mass = 1,
                          .position = {2 * i + random.rational(0, 1, 8)},
                          .velocity = {Rational(count - 2 * i) + random.rational(0, 2, 4)}});
  }
  return row;
}

bool collapses(const System& system) { return make_log(system)->collapse({}).has_value(); }

/// Bernu and Mazighi 1990; McNamara and Young 1992. A wall mirrors the balls.
double critical(int balls) { return std::pow(std::tan(M_PI / 4 * (1 - 2.0 / balls)), 2); }

TEST(Collapse, EqualBallsHaveTheRestitutionOfTheLiterature) {
  EXPECT_NEAR(critical(3), 7 - 4 * std::sqrt(3), 1e-15);
  EXPECT_NEAR(critical(4), 3 - 2 * std::sqrt(2), 1e-15);
  struct Bracket {
    int balls;
    Rational below;
    Rational above;
  };
  for (const Bracket& b :
       {Bracket{3, Rational(1, 14), Rational(2, 27)}, Bracket{4, Rational(1, 6), Rational(7, 40)},
        Bracket{5, Rational(1, 4), Rational(4, 15)}}) {
    SCOPED_TRACE(b.balls);
    EXPECT_NEAR(to_double(b.below) / critical(b.balls), 0.98, 0.02);
    EXPECT_NEAR(to_double(b.above) / critical(b.balls), 1.02, 0.02);
    for (std::uint64_t i = 0; i < std::uint64_t(many(8)); ++i) {
      Random random(i);
      EXPECT_TRUE(collapses(row_of(random, b.balls, b.below))) << i;
      EXPECT_FALSE(collapses(row_of(random, b.balls, b.above))) << i;
    }
  }
}

TEST(Collapse, SaysWhatCollapsesAndWhen) {
  System row{.bodies = {{.mass = 1, .position = {0}, .velocity = {1}},
                        {.mass = 1, .position = {3}},
                        {.mass = 1, .position = {6}, .velocity = {-1}},
                        {.mass = 2, .position = {90}, .velocity = {1}}},
             .restitution = Rational(1, 20)};
  const auto log = make_log(row);
  const auto collapse = log->collapse({});
  ASSERT_TRUE(collapse);
  EXPECT_EQ(collapse->bodies, (std::vector<std::uint32_t>{0, 1, 2}));
  EXPECT_EQ(collapse->listed, log->last());
  const Rational end = to_rational(*collapse->time);
  EXPECT_EQ(log->certain_until(end + 1), collapse->time->hi);
  EXPECT_FALSE(log->certain_until(end * Rational(9, 10)));
  EXPECT_FALSE(log->collapse(end * Rational(9, 10)));
  EXPECT_TRUE(log->collapse(end));
  EXPECT_FALSE(log->state_at(end * Rational(9, 10)).is_infinite);
  const State state = log->state_at(end + 1);
  EXPECT_TRUE(state.is_infinite);
  EXPECT_NEAR(state.bodies[0].velocity[0], state.bodies[2].velocity[0], 1e-12);
  EXPECT_NEAR(state.bodies[1].position[0] - state.bodies[0].position[0], 1, 1e-12);
  const auto count = [&] { count_collisions(row); };
  EXPECT_TRUE(testing_support::contains(
      testing_support::message_of<UsageError>(count),
      "count: there are infinitely many collisions of body 1, body 2 and body 3 until t = "));
}

/// Two blocks beside a wall, stepped, and with a third one far away.
TEST(Collapse, IsThatOfTheClosedForm) {
  for (const auto& [e, is_infinite] : {std::pair(168, true), std::pair(175, false)}) {
    TwoBlocks blocks = article_blocks(1);
    blocks.blocks_restitution = blocks.wall_restitution = Rational(e, 1000);
    System system = system_of(blocks);
    EXPECT_EQ(make_log(system)->collapse({}).has_value(), is_infinite);
    system.bodies.push_back({.mass = 1, .position = {100}, .velocity = {1}});
    const auto log = make_log(system);
    EXPECT_EQ(log->pair(), nullptr);
    const auto collapse = log->collapse({});
    ASSERT_EQ(collapse.has_value(), is_infinite);
    if (!collapse) continue;
    EXPECT_EQ(collapse->bodies, (std::vector<std::uint32_t>{0, 1, 3}));
    const double wanted = collapse_of(blocks)->time->hi;
    EXPECT_NEAR(collapse->time->hi, wanted, 1e-13 * wanted);
    EXPECT_TRUE(testing_support::contains(text_of(system, *collapse),
                                          "collisions of blue, red and the wall until t = "));
  }
}

TEST(Collapse, IsNotFoundInAnAlmostElasticCorner) {
  TwoBlocks blocks = article_blocks(3);
  blocks.blue.position = Rational(1, 2);
  blocks.blocks_restitution = blocks.wall_restitution = Rational(9999, 10000);
  System system = system_of(blocks);
  system.bodies.push_back({.mass = 1, .position = {100}, .velocity = {5}});
  const auto log = make_log(system);
  EXPECT_EQ(log->last(), count_collisions(blocks));
  EXPECT_GT(log->last(), 300);
  EXPECT_FALSE(log->collapse({}));
}

/// Where the criterion of three excludes it, runs end.
TEST(Collapse, OtherTriplesEnd) {
  int ended = 0;
  for (std::uint64_t i = 0; i < std::uint64_t(many(60)); ++i) {
    Random random(100 + i);
    System row = row_of(random, 3, random.rational(0, 1, 12));
    for (Body& body : row.bodies) body.mass = random.rational(1, 9, 2);
    row.bodies[1].restitution = random.rational(0, 1, 12);
    const auto log = make_log(row);
    log->last();
    const Rational kappa =
        *row.bodies[0].mass * *row.bodies[2].mass /
        ((*row.bodies[0].mass + *row.bodies[1].mass) * (*row.bodies[1].mass + *row.bodies[2].mass));
    const Rational e = restitution_of(row, 0, 1);
    const Rational f = restitution_of(row, 1, 2);
    const Rational trace = (1 + e) * (1 + f) * kappa - e - f;
    if (trace > 0 && trace * trace >= 4 * e * f) continue;
    EXPECT_FALSE(log->collapse({})) << "system " << i;
    ++ended;
  }
  EXPECT_GT(ended, 20);
}

TEST(Collapse, StepsAgreeWithTheClosedForm) {
  TracedRandom random(21);
  for (std::int64_t i = 0; i < many(300) && !testing::Test::HasFailure(); ++i) {
    expect_stepped_like_closed(random_inelastic_system(random));
  }
}

}  // namespace
}  // namespace piblocks
