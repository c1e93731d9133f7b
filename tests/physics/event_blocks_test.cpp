#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/eigen.hpp>
#include <gtest/gtest.h>
#include <piblocks/event_simulator.hpp>

#include <cmath>
#include <limits>

#include "support/oracle.hpp"

// The article's system, and what its hard cases should give, on the general engine.
namespace piblocks {
namespace {

using Wide = boost::multiprecision::cpp_bin_float_50;
constexpr std::int64_t kMaxEvents = 2'000'000;

template <typename Scalar>
Particle<Scalar, 1> block(const Scalar& mass, const Scalar& position, const Scalar& velocity) {
  using Vector = typename Particle<Scalar, 1>::Vector;
  return {mass, Scalar(1) / 2, Vector(position), Vector(velocity)};
}

/// Blue, red, wall: blocks before wall in a tie.
template <typename Scalar>
std::vector<Particle<Scalar, 1>> blocks_and_wall(const Scalar& ratio, const Scalar& speed = 1) {
  return {block<Scalar>(1, 2, 0), block<Scalar>(ratio, 5, -speed),
          block<Scalar>(kInfiniteMass<Scalar>, Scalar(-1) / 2, 0)};
}

template <typename Scalar>
std::int64_t collisions(const std::vector<Particle<Scalar, 1>>& bodies) {
  EventSimulator<Scalar, 1> simulator(bodies);
  while (simulator.count() < kMaxEvents && simulator.step()) {
  }
  return simulator.count();
}

TEST(EventBlocks, CountDigitsOfPiInEveryNumberType) {
  std::int64_t ratio = 1;
  for (const int count : {3, 31, 314, 3141, 31415}) {
    EXPECT_EQ(collisions(blocks_and_wall<double>(static_cast<double>(ratio))), count);
    if (count < 10'000) {
      EXPECT_EQ(collisions(blocks_and_wall<Wide>(Wide(ratio))), count);
    }
    ratio *= 100;
  }
  EXPECT_EQ(collisions(blocks_and_wall<long double>(1e8L)), 31415);
}

// Every collision of three digits against the exact run.
TEST(EventBlocks, FollowTheExactRun) {
  const auto exact = oracle::exact_run({}, 1000);  // ratio 10^4
  EventSimulator<double, 1> simulator(blocks_and_wall<double>(1e4));
  const auto events = simulator.run(1000);
  ASSERT_EQ(events.size(), exact.size());
  for (std::size_t k = 0; k < events.size(); ++k) {
    SCOPED_TRACE("collision " + std::to_string(events[k].index));
    const bool at_wall = exact[k].kind == CollisionKind::wall;
    EXPECT_EQ(events[k].first, 0u);
    EXPECT_EQ(events[k].second, at_wall ? 2u : 1u);
    EXPECT_NEAR(events[k].time, to_double(exact[k].time), 1e-12 * to_double(exact[k].time));
    EXPECT_NEAR(events[k].first_after.position[0], to_double(exact[k].blue.position), 1e-11);
    EXPECT_NEAR(events[k].first_after.velocity[0], to_double(exact[k].blue.velocity), 1e-9);
  }
}

// The quadratic of the article's loop gives 0 or NaN for these.
TEST(EventBlocks, CountDoesNotDependOnTheUnitOfSpeed) {
  EXPECT_EQ(collisions(blocks_and_wall<double>(1e4, 1e-300)), 314);
  EXPECT_EQ(collisions(blocks_and_wall<double>(1e4, 1e155)), 314);
}

TEST(EventBlocks, CountDoesNotDependOnTheUnitOfMass) {
  for (const double unit : {1e-300, 1e-200, 1e154, 1e300}) {
    auto bodies = blocks_and_wall<double>(1e4);
    bodies[0].mass *= unit;
    bodies[1].mass *= unit;
    EXPECT_EQ(collisions(bodies), 314) << unit;
  }
}

TEST(EventBlocks, LightRedBlocksBounceOffOnce) {
  for (const double ratio : {1e-300, 1e-32, 0.1, 1.0 / 3.0}) {
    EXPECT_EQ(collisions(blocks_and_wall<double>(ratio)), 2) << ratio;
  }
}

// The blocks would need 10^150 collisions; the numbers stay finite as long as one likes to look.
TEST(EventBlocks, HugeRatiosGiveNoNaN) {
  EventSimulator<double, 1> simulator(blocks_and_wall<double>(1e300));
  for (int k = 0; k < 100; ++k) ASSERT_TRUE(simulator.step());
  EXPECT_EQ(simulator.particles()[1].velocity[0], -1);
  EXPECT_NEAR(simulator.particles()[0].velocity[0], 100, 1e-12);
}

// pi/theta is an integer for 1 and 3: the last collision comes or not with the last bit.
TEST(EventBlocks, TellApartRatiosThatDifferInTheLastBit) {
  const double epsilon = std::numeric_limits<double>::epsilon();
  EXPECT_EQ(collisions(blocks_and_wall<double>(1 - epsilon / 2)), 3);
  EXPECT_EQ(collisions(blocks_and_wall<double>(1 + epsilon)), 4);
  EXPECT_EQ(collisions(blocks_and_wall<double>(3 - 2 * epsilon)), 5);
  EXPECT_EQ(collisions(blocks_and_wall<double>(3)), 5);
  EXPECT_EQ(collisions(blocks_and_wall<double>(3 + 2 * epsilon)), 6);
}

TEST(EventBlocks, CornerHitsAndContacts) {
  const auto total = [](double wall_gap, double blocks_gap, double blue, double red) {
    return collisions<double>({block<double>(1, wall_gap + 0.5, blue),
                               block<double>(100, wall_gap + blocks_gap + 1.5, red),
                               block<double>(kInfiniteMass<double>, -0.5, 0)});
  };
  EXPECT_EQ(total(0, 3, 0, -1), 31) << "blue rests at the wall";
  EXPECT_EQ(total(1, 1, -1, -2), 32) << "both arrive in the corner at once";
  EXPECT_EQ(total(2, 0, -1, -1), 31) << "in contact, moving to the wall together";
  EXPECT_EQ(total(0, 0, 0, -1), 31) << "start in the corner";
  EXPECT_EQ(total(2, 0, 0, -1), 31) << "in contact, approaching";
  EXPECT_EQ(total(2, 0, 0, 1), 0) << "in contact, separating";
  EXPECT_EQ(total(0, 2, -1, -1), 31) << "blue at the wall, moving in";
  EXPECT_EQ(total(0, 2, 1, -1), 30) << "blue at the wall, moving out";
  EXPECT_EQ(total(2, 2, 0, 0), 0) << "at rest";
}

}  // namespace
}  // namespace piblocks
