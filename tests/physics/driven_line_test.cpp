// Blocks that lose energy, and walls that move: against answers that are known.
#include <gtest/gtest.h>
#include <piblocks/error.hpp>
#include <piblocks/log.hpp>

#include <cmath>

#include "physics/exact_line.hpp"
#include "physics/impact.hpp"
#include "physics/stepper.hpp"
#include "support/contains.hpp"
#include "support/message_of.hpp"
#include "support/property.hpp"

namespace piblocks {
namespace {

Body block(const Rational& x, const Rational& v, const Rational& mass = 1) {
  return {.mass = mass, .position = {x}, .velocity = {v}};
}

std::vector<double> velocities_at_end(const System& system) {
  const auto log = make_log(system);
  std::vector<double> velocities;
  for (const Motion& motion : log->state_at(log->time_after(log->last())).bodies) {
    velocities.push_back(motion.velocity[0]);
  }
  return velocities;
}

TEST(DrivenLine, CartsPartWithTheirShareOfTheSpeed) {
  System carts{.bodies = {block(0, 1), block(4, -1)}, .restitution = Rational(1, 2)};
  EXPECT_EQ(velocities_at_end(carts), (std::vector<double>{-0.5, 0.5}));
  const auto log = make_log(carts);
  EXPECT_EQ(log->impact(CollisionKind::blocks, 1, 1)->impulse, 1.5);
  carts.bodies[1].restitution = 0;
  EXPECT_EQ(velocities_at_end(carts), (std::vector<double>{0, 0}));
  EXPECT_EQ(make_log(carts)->impact(CollisionKind::blocks, 1, 1)->impulse, 1);
  carts.bodies[1].mass = 3;
  EXPECT_EQ(velocities_at_end(carts), (std::vector<double>{-0.5, -0.5}));
}

/// Each block is 10^12 times as heavy as the next one, and all fall onto a wall.
System falling_stack(int count, const Rational& e) {
  System stack{.walls = {{"left", {0}, {1}}}, .restitution = e, .wall_restitution = e};
  for (int i = 0; i < count; ++i) {
    const auto twelves = static_cast<unsigned long>(12 * (count - 1 - i));
    stack.bodies.push_back(block(Rational(2 * i + 1) / 2, -1, power(10, twelves)));
  }
  return stack;
}

TEST(DrivenLine, AStackThrowsItsTopBlock) {
  for (const Rational& e : {Rational(1), Rational(9, 10)}) {
    const std::vector<double> velocities = velocities_at_end(falling_stack(5, e));
    for (std::size_t i = 0; i < velocities.size(); ++i) {
      const double wanted = std::pow(1 + to_double(e), double(i + 1)) - 1;
      EXPECT_NEAR(velocities[i], wanted, 1e-10 * wanted) << i;
    }
  }
}

TEST(DrivenLine, ARowOfEqualBlocksPassesOnLessAndLess) {
  System row{.restitution = Rational(1, 2)};
  for (int i = 0; i < 8; ++i) row.bodies.push_back(block(3 * i, i == 0 ? 2 : 0));
  const auto log = make_log(row);
  Integer index = 1;
  while (log->collision(index).second != 7) ++index;
  EXPECT_EQ(log->collision(index).second_after.velocity[0], 2 * std::pow(0.75, 7));
}

/// Fowler's gas of one block: the length that is free, times the speed seen from the piston, is the
/// same at each of its hits.
TEST(DrivenLine, APistonKeepsTheAdiabaticInvariant) {
  for (const Rational& inwards : {Rational(1, 10), Rational(-1, 10)}) {
    System gas{.bodies = {block(2, 1)},
               .walls = {{"left", {0}, {1}}, {"right", {10}, {-1}, {Rational(-inwards)}}}};
    ExactLine line(gas);
    std::optional<Rational> invariant;
    Rational speed = 1;
    int hits = 0;
    while (hits < 20) {
      const auto step = line.step();
      if (!step) break;
      if (step->second != 2) continue;
      const LineElement& gas_block = line.elements()[1];
      const Rational now = (gas_block.position - Rational(1, 2)) * (speed + inwards);
      if (!invariant) invariant = now;
      EXPECT_EQ(now, *invariant);
      speed += 2 * inwards;
      EXPECT_EQ(gas_block.velocity, -speed);
      ++hits;
    }
    EXPECT_EQ(hits, inwards > 0 ? 20 : 5);
  }
}

/// Seen from a frame that moves, collisions happen at the same times between the same bodies.
TEST(DrivenLine, AllIsTheSameInAMovingFrame) {
  for (std::uint64_t i = 0; i < std::uint64_t(many(60)); ++i) {
    Random random(i);
    System system{.restitution = random.rational(0, 1, 4),
                  .wall_restitution = random.rational(0, 1, 4)};
    for (int n = 0; n < 4; ++n) {
      system.bodies.push_back(block(2 * n + random.rational(0, 1, 5), random.rational(-2, 2, 3)));
      if (n != 1 && random.integer(0, 3) == 0) system.bodies.back().mass.reset();
    }
    system.walls = {{"left", {-1}, {1}}, {"right", {9}, {-1}, {random.rational(-1, 1, 3)}}};
    System moving = system;
    const Rational boost = random.rational(-3, 3, 7);
    for (Body& body : moving.bodies) body.velocity[0] += boost;
    for (Wall& wall : moving.walls) wall.velocity[0] += boost;
    const auto a = make_line_stepper(system);
    const auto b = make_line_stepper(moving);
    for (int k = 0; k < 80; ++k) {
      const auto seen = a->step();
      const auto other = b->step();
      if ((seen && !seen->exact_time) || (other && !other->exact_time)) break;
      ASSERT_EQ(seen.has_value(), other.has_value());
      if (!seen) break;
      ASSERT_EQ(seen->exact_time, other->exact_time) << i;
      ASSERT_EQ(seen->first, other->first);
      ASSERT_EQ(seen->second, other->second);
    }
  }
}

TEST(DrivenLine, AWallIsWhereItHasMoved) {
  const System system{.bodies = {block(2, 0)}, .walls = {{"left", {0}, {1}, {Rational(1, 2)}}}};
  const auto log = make_log(system);
  EXPECT_EQ(log->last(), 1);
  const Collision hit = log->collision(1);
  EXPECT_EQ(hit.time.hi, 3);
  EXPECT_EQ(hit.second_after, (Motion{{1.5, 0}, {0.5, 0}}));
  EXPECT_EQ(hit.first_after, (Motion{{2, 0}, {1, 0}}));
  EXPECT_EQ(log->impact(CollisionKind::wall, 1, 1)->impulse, 1);
}

TEST(DrivenLine, TwoImmovableBodiesThatMeetEndTheRun) {
  System system{.bodies = {block(5, 1), block(2, 1)}, .walls = {{"left", {0}, {1}}}};
  system.bodies[1].mass.reset();
  system.bodies[1].velocity[0] = Rational(-1, 2);
  const auto log = make_log(system, Rational(10));
  EXPECT_EQ(log->state_at(2).bodies[1].position[0], 1);
  const auto ask = [&] { static_cast<void>(log->state_at(3)); };
  EXPECT_TRUE(testing_support::contains(
      testing_support::message_of<SimulationError>(ask),
      "body 2 and the left wall meet at t = 3, and neither can give way"));
}

/// In the order of pairs the left one is hit back twice.
TEST(DrivenLine, ABlockThatIsHitFromBothSidesAtOnceStays) {
  System row{.bodies = {block(0, 1), block(3, 0, 2), block(6, -1)}};
  for (const Rational& e : {Rational(1), Rational(1, 2), Rational(0)}) {
    row.restitution = e;
    row.contacts = Contacts::at_once;
    const double part = to_double(e);
    EXPECT_EQ(velocities_at_end(row), (std::vector<double>{-part, 0, part}));
    row.contacts = Contacts::in_order;
    if (e > 0) {
      EXPECT_NE(velocities_at_end(row)[1], 0);
    }
  }
}

/// Each of the two contacts is a collision with an impulse of its own.
TEST(DrivenLine, ContactsAtOnceShowTheirImpulses) {
  // Of both collisions the middle one, which is the lightest, shows the impulse.
  System row{.bodies = {block(0, 3), block(3, 0, Rational(1, 2)), block(6, -3)},
             .contacts = Contacts::at_once};
  const auto log = make_log(row);
  const double left = log->impact(CollisionKind::blocks, 1, 1)->impulse;
  const double right = log->impact(CollisionKind::blocks, 2, 2)->impulse;
  const std::vector<double> after = velocities_at_end(row);
  EXPECT_EQ(log->collision(1).time.hi, log->collision(2).time.hi);
  EXPECT_NEAR(after[0], 3 - left, 1e-15);
  EXPECT_NEAR(after[2], right - 3, 1e-15);
}

/// Two blocks beside a wall, which the closed form would take in order.
TEST(DrivenLine, TwoBlocksInACornerMayCollideAtOnce) {
  System corner{.bodies = {block(2, -1), block(Rational(9, 2), -2, 100)},
                .walls = {{"left", {0}, {1}}}};
  EXPECT_GT(make_log(corner)->last(), 20);
  corner.contacts = Contacts::at_once;
  EXPECT_EQ(make_log(corner)->last(), 2);
  EXPECT_EQ(count_collisions(corner), 2);
  EXPECT_EQ(velocities_at_end(corner), (std::vector<double>{1, 2}));
}

TEST(DrivenLine, BlocksAtOnceMayCollapse) {
  System row{.bodies = {block(0, 1, 7), block(1, 0, 11), block(2, 0, 13)}, .restitution = 0};
  for (const Contacts contacts : {Contacts::in_order, Contacts::at_once}) {
    row.contacts = contacts;
    const auto collapse = make_log(row)->collapse({});
    ASSERT_TRUE(collapse);
    EXPECT_EQ(collapse->bodies.size(), 3U);
  }
}

}  // namespace
}  // namespace piblocks
