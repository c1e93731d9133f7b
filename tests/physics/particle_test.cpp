#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/eigen.hpp>
#include <gtest/gtest.h>
#include <piblocks/event_simulator.hpp>

#include <cmath>
#include <limits>

#include "physics/rods.hpp"
#include "support/traced_random.hpp"

namespace piblocks {
namespace {

using Wide = boost::multiprecision::cpp_bin_float_50;
using Disc = Particle<double, 2>;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Disc disc(double x, double y, double u, double v) { return {1, 0.5, {x, y}, {u, v}}; }

// Head-on, the meeting is exactly gap / closing speed: the article's first collision.
TEST(CollisionTime, HeadOnIsGapOverSpeed) {
  EXPECT_EQ(collision_time(rod(1, 2, 0), rod(100, 5, -1)), 2.0);
  EXPECT_EQ(collision_time(rod(100, 5, -1), rod(1, 2, 0)), 2.0);
  EXPECT_EQ(collision_time(rod(1, 2, 0), rod(100, 5, -3)), 2.0 / 3.0);
  EXPECT_EQ(collision_time(disc(0, 0, 1, 0), disc(4, 0, -1, 0)), 1.5);
}

TEST(CollisionTime, IsZeroForBallsInContactThatApproach) {
  EXPECT_EQ(collision_time(rod(1, 2, 1), rod(1, 3, 0)), 0.0);
  EXPECT_EQ(collision_time(rod(1, 2, 1), rod(1, 2.75, 0)), 0.0) << "overlapping";
}

TEST(CollisionTime, IsNoneForBallsThatNeverMeet) {
  EXPECT_EQ(collision_time(rod(1, 2, 0), rod(1, 3, 0)), std::nullopt) << "in contact, at rest";
  EXPECT_EQ(collision_time(rod(1, 2, 0), rod(1, 3, 1)), std::nullopt) << "in contact, receding";
  EXPECT_EQ(collision_time(rod(1, 2, 0), rod(1, 2.5, 1)), std::nullopt) << "overlapping";
  EXPECT_EQ(collision_time(rod(1, 2, 3), rod(1, 9, 3)), std::nullopt) << "same velocity";
  EXPECT_EQ(collision_time(disc(0, 0, 1, 0), disc(4, 2, -1, 0)), std::nullopt) << "pass by";
  EXPECT_EQ(collision_time(rod(kInfinity, 2, 1), rod(kInfinity, 9, 0)), std::nullopt) << "walls";
}

TEST(CollisionTime, TellsAGrazeFromAHit) {
  EXPECT_EQ(collision_time(disc(0, 0, 1, 0), disc(4, 1, 0, 0)), std::nullopt) << "exact graze";
  const double offset = 1 - 1e-10;
  const auto hit = collision_time(disc(0, 0, 1, 0), disc(4, offset, 0, 0));
  ASSERT_TRUE(hit);
  EXPECT_NEAR(*hit, 4 - std::sqrt((1 - offset) * (1 + offset)), 1e-15);
  EXPECT_EQ(collision_time(disc(0, 0, 1, 0), disc(4, 1 + 1e-10, 0, 0)), std::nullopt);
}

TEST(CollisionTime, LeavesTheSurfacesTouching) {
  TracedRandom random(7);
  int hits = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    Disc p = disc(0, 0, random.uniform(-1, 1), random.uniform(-1, 1));
    Disc q = disc(random.uniform(2, 9), random.uniform(-2, 2), -1, random.uniform(-1, 1));
    const auto time = collision_time(p, q);
    if (!time) continue;
    ++hits;
    advance(p, *time);
    advance(q, *time);
    EXPECT_NEAR((p.position - q.position).norm(), 1.0, 1e-13);
  }
  EXPECT_GT(hits, 200);
}

// The double's answer against the same formula with 50 digits, for discs that come from far away.
TEST(CollisionTime, DoesNotCancel) {
  TracedRandom random(8);
  using WideDisc = Particle<Wide, 2>;
  for (int trial = 0; trial < 500; ++trial) {
    const double far = std::pow(10.0, random.uniform(0, 6));
    const Disc p = disc(0, 0, 0, 0);
    const Disc q = disc(1.01 + far, random.uniform(-0.9, 0.9), -1, 0);
    const WideDisc wide_p = {1, 0.5, p.position.cast<Wide>(), p.velocity.cast<Wide>()};
    const WideDisc wide_q = {1, 0.5, q.position.cast<Wide>(), q.velocity.cast<Wide>()};
    const auto time = collision_time(p, q);
    const auto exact = collision_time(wide_p, wide_q);
    ASSERT_EQ(time.has_value(), exact.has_value());
    if (!time) continue;
    EXPECT_LT(abs(Wide(*time) / *exact - 1), Wide(2e-15)) << q.position.transpose();
  }
}

// Lengths of 1e200 and speeds of 1e155 or 1e-300 have squares beyond double's range.
TEST(CollisionTime, IsIndependentOfScale) {
  const Disc p = disc(0, 0, 3, 1);
  const Disc q = disc(4, 1, -1, 0.5);
  const double expected = collision_time(p, q).value();
  const auto scaled = [](Disc body, double length, double speed) {
    body.radius *= length;
    body.position *= length;
    body.velocity *= speed;
    return body;
  };
  for (const double length : {1e-200, 1.0, 1e200}) {
    for (const double speed : {1e-155, 1.0, 1e155}) {
      const double unit = length / speed;
      if (unit == 0 || std::isinf(unit)) continue;
      const auto time = collision_time(scaled(p, length, speed), scaled(q, length, speed));
      ASSERT_TRUE(time);
      EXPECT_NEAR(*time / unit, expected, 1e-14) << length << " " << speed;
    }
  }
  EXPECT_NEAR(collision_time(scaled(p, 1, 1e-300), scaled(q, 1, 1e-300)).value() * 1e-300, expected,
              1e-14);
}

TEST(Collide, EqualMassesExchangeVelocitiesHeadOn) {
  Rod p = rod(1, 2, 3);
  Rod q = rod(1, 3, -1);
  collide(p, q);
  EXPECT_EQ(p.velocity[0], -1);
  EXPECT_EQ(q.velocity[0], 3);
}

// A disc that strikes an equal one at rest leaves at a right angle to it.
TEST(Collide, EqualMassesPartAtARightAngle) {
  Disc p = disc(0, 0, 1, 0);
  Disc q = disc(4, 0.7, 0, 0);
  const double time = collision_time(p, q).value();
  advance(p, time);
  advance(q, time);
  collide(p, q);
  EXPECT_NEAR(p.velocity.dot(q.velocity), 0, 1e-15);
  EXPECT_NEAR(q.velocity.normalized().dot((q.position - p.position).normalized()), 1, 1e-15);
  EXPECT_NEAR(q.velocity.norm(), std::sqrt(1 - 0.7 * 0.7), 1e-15);
}

TEST(Collide, AWallReflectsAndStaysAsItIs) {
  Disc wall = disc(0, 0, 0, 0);
  wall.mass = kInfinity;
  Disc ball = disc(1, 0, -2, 5);
  collide(wall, ball);
  EXPECT_EQ(wall.velocity, Disc::Vector(0, 0));
  EXPECT_EQ(ball.velocity, Disc::Vector(2, 5));
}

/// Against the distance from a line, in any direction and on either side of the pair.
TEST(Collide, AFlatWallTurnsTheVelocityAlongItsNormal) {
  TracedRandom random(11);
  int hits = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const double angle = random.uniform(0, 6.28);
    const Disc::Vector normal(std::cos(angle), std::sin(angle));
    Disc wall{.mass = kInfinity, .position = {1, 2}, .facing = random.uniform(0.1, 10) * normal};
    const double gap = random.uniform(0, 5);
    const Disc::Vector along(-normal[1], normal[0]);
    Disc ball{.mass = 3,
              .radius = 0.5,
              .position = wall.position + (0.5 + gap) * normal + random.uniform(-9, 9) * along,
              .velocity = {random.uniform(-2, 2), random.uniform(-2, 2)}};
    const double speed = -ball.velocity.dot(normal);
    const auto time = collision_time(wall, ball);
    ASSERT_EQ(time, collision_time(ball, wall));
    ASSERT_EQ(time.has_value(), speed > 0);
    if (!time) continue;
    ++hits;
    EXPECT_NEAR(*time, gap / speed, 1e-12 * (1 + gap) / speed);
    const Disc::Vector expected = ball.velocity + 2 * speed * normal;
    trial % 2 == 0 ? collide(wall, ball) : collide(ball, wall);
    EXPECT_LT((ball.velocity - expected).norm(), 1e-14);
    EXPECT_EQ(wall.velocity, Disc::Vector::Zero());
  }
  EXPECT_GT(hits, 800);
}

TEST(Collide, AMovingWallAddsTwiceItsSpeed) {
  Rod wall = rod(kInfinity, 0, 3);
  Rod ball = rod(1, 1, -2);
  collide(ball, wall);
  EXPECT_EQ(wall.velocity[0], 3);
  EXPECT_EQ(ball.velocity[0], 8);
}

TEST(Collide, DoesNothingToBallsThatRecede) {
  Rod p = rod(1, 2, -1);
  Rod q = rod(5, 3, 1);
  collide(p, q);
  EXPECT_EQ(p.velocity[0], -1);
  EXPECT_EQ(q.velocity[0], 1);
}

TEST(Collide, TakesAnyRatioOfMasses) {
  for (const double light : {5e-324, 1e-300, 1.0, 1e8}) {
    for (const double heavy : {1e30, 1e300, 1.7e308, kInfinity}) {
      Rod p = rod(light, 2, 1);
      Rod q = rod(heavy, 3, -1);
      collide(p, q);
      EXPECT_NEAR(p.velocity[0], -3, 1e-15) << light << " " << heavy;
      EXPECT_NEAR(q.velocity[0], -1, 1e-15) << light << " " << heavy;
    }
  }
  Rod p = rod(5e-324, 2, 1);
  Rod q = rod(5e-324, 3, -1);
  collide(p, q);
  EXPECT_EQ(p.velocity[0], -1);
}

TEST(Collide, TakesInfiniteMassInMultiprecision) {
  using WideRod = Particle<Wide, 1>;
  WideRod wall = {kInfiniteMass<Wide>, 1, WideRod::Vector(Wide(0)), WideRod::Vector(Wide(0))};
  WideRod ball = {3, 1, WideRod::Vector(Wide(2)), WideRod::Vector(Wide(-1))};
  EXPECT_EQ(collision_time(wall, ball), Wide(0));
  collide(wall, ball);
  EXPECT_EQ(wall.velocity[0], 0);
  EXPECT_EQ(ball.velocity[0], 1);
}

}  // namespace
}  // namespace piblocks
