// Blocks on a line: against an exact program that shares nothing with them but the masses.
#include <gtest/gtest.h>
#include <piblocks/error.hpp>
#include <piblocks/system.hpp>

#include <algorithm>
#include <functional>
#include <map>

#include "physics/exact_line.hpp"
#include "physics/exact_walk.hpp"
#include "physics/stepper.hpp"
#include "support/property.hpp"

namespace piblocks {
namespace {

struct Limits {
  long most_bodies = 6;
  bool walls = true;
  bool is_driven = false;  ///< walls and immovable blocks may move
  bool is_lossy = false;
};

Rational any_restitution(Random& random) {
  const auto choice = random.integer(0, 3);
  return choice < 2 ? Rational(choice) : random.rational(0, 1, 10);
}

/// Coefficients for all, and some bodies and walls with their own.
void make_lossy(System& system, Random& random) {
  system.restitution = any_restitution(random);
  system.wall_restitution = any_restitution(random);
  const auto give_own = [&](auto& one) {
    if (random.integer(0, 3) == 0) one.restitution = any_restitution(random);
  };
  for (Body& body : system.bodies) give_own(body);
  for (Wall& wall : system.walls) give_own(wall);
}

void make_driven(System& system, Random& random) {
  for (Body& body : system.bodies) {
    if (!body.mass) body.velocity[0] = random.rational(-1, 1, 4);
  }
  for (Wall& wall : system.walls) wall.velocity[0] = random.rational(-1, 1, 4);
}

System random_line(Random& random, const Limits& limits) {
  System system;
  const long count = random.integer(2, limits.most_bodies);
  Rational x = random.rational(-4, 4, 3);
  const Rational left = x - random.rational(0, 3, 5);
  for (long i = 0; i < count; ++i) {
    Body body;
    body.size = random.rational(1, 4, 5);
    x += random.rational(0, 3, 7) + body.size / 2;
    body.position[0] = x;
    x += body.size / 2;
    body.velocity[0] = random.rational(-3, 3, 7);
    body.mass = random.rational(1, 60, 7);
    if (random.integer(0, 3) == 0) *body.mass *= 100;
    if (random.integer(0, 9) == 0) {
      body.mass.reset();
      body.velocity[0] = 0;
    }
    system.bodies.push_back(body);
  }
  // In any order, and perhaps all of them immovable.
  for (std::size_t i = system.bodies.size(); i > 1; --i) {
    std::swap(system.bodies[i - 1], system.bodies[std::size_t(random.integer(0, long(i) - 1))]);
  }
  if (!system.bodies.front().mass) system.bodies.front().mass = 3;
  if (limits.walls && random.integer(0, 1) == 0) system.walls.push_back({"left", {left}, {1}});
  if (limits.walls && random.integer(0, 2) == 0) {
    system.walls.push_back({"right", {x + random.rational(0, 3, 5)}, {-1}});
  }
  if (limits.is_driven) make_driven(system, random);
  if (limits.is_lossy) make_lossy(system, random);
  return system;
}

/// Whether no collision moves either of the two: the walk passes over such meetings.
bool is_jam(const System& system, const SteppedCollision& step) {
  const auto is_immovable = [&](std::uint32_t id) {
    return id >= system.bodies.size() || !system.bodies[id].mass;
  };
  return is_immovable(step.first) && is_immovable(step.second);
}

constexpr int kMostSteps = 150;

/// Blocks at whole places with whole velocities, of which many meet at once.
System random_row(Random& random) {
  System system{.contacts = Contacts::at_once};
  const long count = random.integer(3, 9);
  Rational x;
  for (long i = 0; i < count; ++i) {
    x += 1 + random.integer(0, 3) / 2;
    Body body{.mass = random.integer(1, 3), .position = {x}, .size = 1};
    body.velocity[0] = random.integer(-1, 1);
    if (random.integer(0, 14) == 0) body.mass.reset();
    system.bodies.push_back(body);
  }
  if (!system.bodies.front().mass) system.bodies.front().mass = 2;
  if (random.integer(0, 2) == 0) system.walls.push_back({"left", {0}, {1}});
  if (random.integer(0, 2) == 0) system.walls.push_back({"right", {x + 1}, {-1}});
  if (random.integer(0, 1) == 0) make_lossy(system, random);
  for (Body& body : system.bodies) {
    if (!body.mass) body.velocity[0] = 0;
  }
  return system;
}

using Draw = std::function<System(Random&)>;

Draw lines_of(const Limits& limits) {
  return [limits](Random& random) { return random_line(random, limits); };
}

/// @param ties  counts collisions that happen at once with another of the same body
void expect_steps_of_walk(std::int64_t count, std::uint64_t seed, const Draw& draw, int& ties) {
  for (std::uint64_t i = 0; i < std::uint64_t(count); ++i) {
    Random random(seed + i);
    const System system = draw(random);
    ASSERT_TRUE(problems_of(system).empty()) << problems_of(system).front().reason;
    ExactWalk walk(system);
    const auto stepper = make_line_stepper(system);
    for (int k = 0; k < kMostSteps; ++k) {
      const std::size_t bits = walk.bits();
      const std::optional<SteppedCollision> step = stepper->step();
      if (step && is_jam(system, *step)) break;
      const std::optional<ExactCollision> expected = walk.next();
      // Doubles cannot follow infinitely many collisions.
      if (!step && stepper->certain_until() < kForEver) {
        EXPECT_GT(bits, kMaxExactBits) << "system " << i << ", step " << k;
        break;
      }
      ASSERT_EQ(step.has_value(), expected.has_value()) << "system " << i << ", step " << k;
      if (!step) break;
      if (step->is_tied) ++ties;
      if (!step->exact_time) {
        EXPECT_GT(bits, kMaxExactBits) << "system " << i << ", step " << k;
        break;
      }
      ASSERT_EQ(*step->exact_time, expected->time) << "system " << i << ", step " << k;
      ASSERT_EQ(step->first, expected->first);
      ASSERT_EQ(step->second, expected->second);
      const Body& first = walk.bodies()[expected->first];
      ASSERT_EQ(step->first_after.velocity[0], to_double(first.velocity[0]));
      ASSERT_EQ(step->first_after.position[0], to_double(first.position[0]));
    }
  }
}

void expect_steps_of_walk(std::int64_t count, std::uint64_t seed, const Limits& limits) {
  int ties = 0;
  expect_steps_of_walk(count, seed, lines_of(limits), ties);
}

TEST(LineTest, EveryCollisionIsThatOfAnExactProgram) { expect_steps_of_walk(many(60), 0, {}); }

TEST(LineTest, StagesAreThoseOfAnExactProgram) {
  int ties = 0;
  expect_steps_of_walk(many(100), 8'000'000, random_row, ties);
  EXPECT_GT(ties, 100);
}

TEST(LineTest, LossAndMotionAreThoseOfAnExactProgram) {
  expect_steps_of_walk(many(40), 2'000'000, {.is_lossy = true});
  expect_steps_of_walk(many(40), 3'000'000, {.is_driven = true});
  expect_steps_of_walk(many(40), 4'000'000, {.is_driven = true, .is_lossy = true});
}

/// What each body meets, in order; and when.
using Partners = std::map<std::size_t, std::vector<std::pair<std::size_t, double>>>;

void add(Partners& partners, std::size_t first, std::size_t second, double time) {
  partners[first].emplace_back(second, time);
  partners[second].emplace_back(first, time);
}

/// @return certain steps of a system
double certain_steps_of(std::int64_t count, std::uint64_t seed, const Draw& draw) {
  double certain_steps = 0;
  int uncertain = 0;
  for (std::uint64_t i = 0; i < std::uint64_t(count); ++i) {
    Random random(seed + i);
    const System system = draw(random);
    ExactWalk walk(system);
    const auto line = make_certified_line(elements_of(system), 0, are_at_once(system));
    Partners expected;
    Partners found;
    for (int k = 0; k < kMostSteps; ++k) {
      if (const auto collision = walk.next()) {
        add(expected, collision->first, collision->second, to_double(collision->time));
      }
      const auto step = line->step();
      if (step && is_jam(system, *step)) break;
      if (step) add(found, step->first, step->second, step->time.hi);
    }
    // Doubles may take collisions of different bodies in another order, also around the last step.
    for (int k = 0; k < 10; ++k) {
      const auto collision = walk.next();
      if (!collision) break;
      add(expected, collision->first, collision->second, to_double(collision->time));
    }
    const double until = line->certain_until();
    if (until < kForEver) ++uncertain;
    for (const auto& [body, meetings] : found) {
      for (std::size_t k = 0; k < meetings.size(); ++k) {
        const auto& [partner, time] = meetings[k];
        if (time >= until) break;
        if (k >= expected[body].size() || partner != expected[body][k].first) {
          ADD_FAILURE() << "system " << i << ", body " << body << ", time " << time;
          return 0;
        }
        // Of bodies that have hardly any speed left, only the order is certain.
        if (is_elastic(system)) {
          EXPECT_NEAR(time, expected[body][k].second, 1e-7 * (1 + time)) << "system " << i;
        }
        certain_steps += 0.5;
      }
    }
  }
  std::printf("certain: %.1f steps a system; %d of %d end\n", certain_steps / double(count),
              uncertain, int(count));
  return certain_steps / double(count);
}

TEST(LineTest, DoublesAreRightForAsLongAsTheySay) {
  EXPECT_GT(certain_steps_of(many(100), 1'000'000, lines_of({.most_bodies = 5})), 20);
}

TEST(LineTest, DoublesOfLossAndMotionAreRight) {
  Limits limits{.most_bodies = 5, .is_lossy = true};
  EXPECT_GT(certain_steps_of(many(100), 5'000'000, lines_of(limits)), 20);
  limits.is_driven = true;
  EXPECT_GT(certain_steps_of(many(100), 7'000'000, lines_of(limits)), 20);
  limits.is_lossy = false;
  EXPECT_GT(certain_steps_of(many(100), 6'000'000, lines_of(limits)), 20);
}

/// It takes contacts in order, and is not certain where that matters.
TEST(LineTest, DoublesOfContactsAtOnceAreRight) {
  EXPECT_GT(certain_steps_of(many(100), 9'000'000, random_row), 1);
}

/// Two systems whose only difference is the order of their bodies.
TEST(LineTest, TheOrderOfBodiesDoesNotMatter) {
  Random random(7);
  System system = random_line(random, {});
  System reversed = system;
  std::ranges::reverse(reversed.bodies);
  const auto a = make_line_stepper(system);
  const auto b = make_line_stepper(reversed);
  while (const auto step = a->step()) {
    const auto other = b->step();
    ASSERT_TRUE(other);
    EXPECT_EQ(step->exact_time, other->exact_time);
    if (step->time.hi > 50) break;
  }
}

System cradle() {
  System system;
  for (int i = 0; i < 5; ++i) {
    system.bodies.push_back({1, {Rational(i == 0 ? -3 : i)}, {Rational(i == 0 ? 2 : 0)}, 1});
  }
  return system;
}

TEST(LineTest, CollisionsAtOneInstantAreInPairOrder) {
  const auto log = make_log(cradle());
  EXPECT_EQ(log->last(), 4);
  for (int k = 1; k <= 4; ++k) {
    const Collision c = log->collision(k);
    EXPECT_EQ(c.time.hi, 1.5);
    EXPECT_EQ(int(c.first), k - 1);
    EXPECT_EQ(int(c.second), k);
  }
  EXPECT_EQ(log->first_tie(log->last()), std::nullopt)
      << "one meets the next, which touches the one after it";
  EXPECT_EQ(log->state_at(2).bodies[4].velocity[0], 2);
  EXPECT_EQ(log->state_at(2).bodies[4].position[0], 5);
  EXPECT_EQ(log->state_at(Rational(3, 2)).count, 4);
  EXPECT_EQ(log->time_after(4), Rational(3, 2));
  EXPECT_THROW(log->time_after(2), UsageError);
}

/// Two pairs that meet at one time have nothing to do with each other.
TEST(LineTest, OnlyABodyThatMeetsTwoOthersAtOnceIsATie) {
  System tied;
  for (const int x : {-3, 0, 3}) tied.bodies.push_back({1, {x}, {Rational(-x, 3)}, 1});
  EXPECT_EQ(make_log(tied)->first_tie(1), 1);
  // Two more meet before that, far away.
  tied.bodies.push_back({1, {-20}, {}, 1});
  tied.bodies.push_back({1, {-22}, {1}, 1});
  EXPECT_EQ(make_log(tied)->first_tie(9), 2);

  System system;
  for (const int x : {0, 10}) {
    system.bodies.push_back({.position = {x, 0}, .velocity = {1, 0}});
    system.bodies.push_back({.position = {x + 3, 0}, .velocity = {-1, 0}});
  }
  const auto log = make_log(system);
  EXPECT_EQ(log->collision(1).time.hi, log->collision(2).time.hi);
  EXPECT_EQ(log->first_tie(log->last()), std::nullopt);
}

TEST(LineTest, ABlockBetweenAnotherAndTheWallAtOnceIsATie) {
  System corner;
  corner.bodies = {{std::nullopt, {-1}, {}, 2}, {1, {Rational(1, 2)}, {}, 1}, {3, {3}, {-1}, 1}};
  EXPECT_EQ(make_log(corner)->first_tie(1), 1);
  corner.bodies[1].position = {1};
  EXPECT_EQ(make_log(corner)->first_tie(9), std::nullopt);
}

TEST(LineTest, TheClosedFormTakesBlocksByOtherNames) {
  for (const int sign : {1, -1}) {
    System system;
    system.bodies = {{power(100, 19), {Rational(sign * 5)}, {Rational(-sign)}, 1},
                     {1, {Rational(sign * 2)}, {}, 1}};
    system.walls = {{"wall", {Rational(-sign, 2)}, {Rational(sign)}}};
    const auto log = make_log(system);
    EXPECT_EQ(log->last(), Integer("31415926535897932384"));
    EXPECT_FALSE(log->is_exact(1));
    const Collision second = log->collision(2);
    EXPECT_EQ(second.first, 1U);   // blue
    EXPECT_EQ(second.second, 2U);  // the wall
    EXPECT_EQ(log->state_at(0).bodies[0].position[0], sign * 5);
    EXPECT_FALSE(may_never_end(system));
  }
}

/// Numbers that are called exact are the nearest doubles; those of the closed form need not be.
TEST(LineTest, TheClosedFormSaysWhetherItIsExact) {
  for (const Rational& mass : {Rational(3, 7), Rational(1), Rational(7, 3), Rational(100)}) {
    System system;
    system.bodies = {{1, {Rational(19, 7)}, {Rational(-1, 3)}, Rational(1, 3)},
                     {mass, {Rational(16, 3)}, {Rational(-10, 9)}, 1}};
    system.walls = {{"wall", {Rational(1, 9)}, {1}}};
    const auto log = make_log(system);
    const bool is_exact = mass <= 1;
    EXPECT_EQ(log->is_exact(1), is_exact) << mass;
    ExactWalk walk(system);
    for (Integer k = 1; k <= log->last(); ++k) {
      const auto expected = walk.next();
      const Motion found = log->collision(k).first_after;
      const Body& truth = walk.bodies()[expected->first];
      const double limit = is_exact ? 0 : 1e-14;
      EXPECT_LE(std::fabs(found.position[0] - to_double(truth.position[0])), limit) << k;
      EXPECT_LE(std::fabs(found.velocity[0] - to_double(truth.velocity[0])), limit) << k;
    }
  }
}

TEST(LineTest, SwitchingToDoublesKeepsWhatHappens) {
  System system;
  system.bodies = {{1, {1}, {1}, 1},
                   {Rational(17, 3), {3}, {Rational(-1, 7)}, 1},
                   {Rational(5, 11), {5}, {0}, 1}};
  system.walls = {{"left", {0}, {1}}, {"right", {7}, {-1}}};
  EXPECT_TRUE(may_never_end(system));
  EXPECT_THROW(make_log(system)->last(), UsageError);
  const auto log = make_log(system, Rational(2000));
  EXPECT_TRUE(log->is_exact(100));
  EXPECT_FALSE(log->is_exact(log->last()));
  ExactWalk walk(system);
  const double until = log->certain_until(2000).value_or(2000);
  EXPECT_GT(until, 100);
  for (Integer k = 1; k <= log->last() && k < 1500; ++k) {
    const auto expected = walk.next();
    const Collision found = log->collision(k);
    if (found.time.hi >= until) break;
    ASSERT_EQ(found.first, expected->first) << k;
    ASSERT_EQ(found.second, expected->second) << k;
    ASSERT_NEAR(found.time.hi, to_double(expected->time), 1e-9);
  }
}

TEST(LineTest, RejectsWhatIsNoSystem) {
  const auto problem = [](System system) {
    const auto problems = problems_of(system);
    return problems.empty() ? std::string() : problems.front().key + " " + problems.front().reason;
  };
  System system = cradle();
  system.bodies[1].mass = -1;
  EXPECT_EQ(problem(system), "body 2.mass = -1: must be greater than 0");
  system = cradle();
  system.bodies[2].position[0] = Rational(3, 2);
  EXPECT_EQ(problem(system), "body 3.position = 3/2: overlaps body 2 by 1/2");
  system = cradle();
  system.walls = {{"left", {-3}, {1}}};
  EXPECT_EQ(problem(system), "body 1.position = -3: reaches 1/2 beyond the left wall");
  for (Body& body : system.bodies) body = {std::nullopt, {}, {}, 1};
  EXPECT_EQ(problem(system), "body all have infinite mass: nothing can move");
  EXPECT_EQ(problem({}), "body is missing: there must be at least one");
}

}  // namespace
}  // namespace piblocks
