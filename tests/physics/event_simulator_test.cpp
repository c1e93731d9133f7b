#include <gtest/gtest.h>
#include <piblocks/error.hpp>
#include <piblocks/event_simulator.hpp>

#include <limits>
#include <optional>
#include <vector>

#include "physics/rods.hpp"
#include "support/message_of.hpp"
#include "support/traced_random.hpp"

namespace piblocks {
namespace {
using testing_support::message_of;

using Rods = EventSimulator<double, 1>;
// Six rods between two walls never stop.
TEST(EventSimulator, KeepsTheOrderOfRodsBetweenWalls) {
  TracedRandom random(13);
  std::vector<Rod> rods = {rod(kInfiniteMass<double>, -0.5, 0)};
  for (int i = 0; i < 6; ++i) {
    rods.push_back(rod(random.uniform(0.01, 100), 2 * i + 1, random.uniform(-1, 1)));
  }
  rods.push_back(rod(kInfiniteMass<double>, 14, 0));
  Rods simulator(rods);
  for (int k = 0; k < 20'000; ++k) {
    ASSERT_TRUE(simulator.step());
    const auto& now = simulator.particles();
    for (std::size_t i = 1; i < now.size(); ++i) {
      ASSERT_GE(now[i].position[0] - now[i - 1].position[0], 1 - 1e-13) << "collision " << k;
    }
  }
  EXPECT_EQ(simulator.particles().front().velocity[0], 0);
  EXPECT_EQ(simulator.particles().back().position[0], 14);
}

TEST(EventSimulator, AMovingWallPushesEverythingAhead) {
  Rods simulator({rod(kInfiniteMass<double>, 0, 1), rod(1, 3, 0), rod(4, 5, 0)});
  simulator.run(100);
  const auto& end = simulator.particles();
  EXPECT_EQ(end[0].velocity[0], 1);
  EXPECT_GE(end[1].velocity[0], 1);
  EXPECT_GE(end[2].velocity[0], end[1].velocity[0]);
}

TEST(EventSimulator, BreaksTiesByTheOrderOfPairs) {
  Rods simulator({rod(1, 0, 1), rod(1, 3, -1), rod(1, 10, 1), rod(1, 13, -1)});
  const auto events = simulator.run(10);
  ASSERT_GE(events.size(), 2u);
  EXPECT_EQ(events[0].time, events[1].time);
  EXPECT_EQ(events[0].first, 0u);
  EXPECT_EQ(events[1].first, 2u);
}

TEST(EventSimulator, KnowsTheFlightAfterTheLastCollision) {
  Rods simulator({rod(1, 2, 0), rod(1, 5, -1)});
  EXPECT_EQ(simulator.next_time(), 2.0);
  EXPECT_EQ(simulator.particles_at(1.5)[1].position[0], 3.5);
  EXPECT_THROW(simulator.particles_at(2.5), UsageError);
  EXPECT_THROW(simulator.particles_at(-1), UsageError);
  ASSERT_TRUE(simulator.step());
  EXPECT_EQ(simulator.time(), 2);
  EXPECT_EQ(simulator.next_time(), std::nullopt);
  EXPECT_EQ(simulator.step(), std::nullopt);
  EXPECT_EQ(simulator.particles_at(100)[0].position[0], -96);
  EXPECT_THROW(simulator.particles_at(1), UsageError);
}

TEST(EventSimulator, TakesNoParticlesAndOne) {
  EXPECT_TRUE(Rods({}).run(0).empty());
  EXPECT_TRUE(Rods({rod(1, 0, 1)}).run(0).empty());
}

TEST(EventSimulator, StopsAtTheLimit) {
  const std::vector<Rod> blocks = {rod(1, 2, 0), rod(100, 5, -1),
                                   rod(kInfiniteMass<double>, -0.5, 0)};
  EXPECT_EQ(Rods(blocks).run(31).size(), 31u);
  EXPECT_THROW(Rods(blocks).run(30), SimulationError);
  EXPECT_EQ(message_of<Error>([&] { Rods(blocks).run(30); }),
            "simulation: collision 31: the limit of 30 was reached");
}

/// With vectors, of which there are 2, 4 or 8 numbers in one, 1 would be lost or not.
TEST(EventSimulator, AddsCoordinatesInTheirOrder) {
  const Eigen::Matrix<double, 8, 1> ones = Eigen::Matrix<double, 8, 1>::Ones();
  Eigen::Matrix<double, 8, 1> terms;
  terms << 1, 0x1p60, -0x1p60, 1, 0x1p60, 1, -0x1p60, 1;
  EXPECT_EQ(detail::dot(terms, ones), 1);
  terms << 0x1p60, -0x1p60, 1, 1, 1, 0x1p60, -0x1p60, 1;
  EXPECT_EQ(detail::dot(terms, ones), 1);
  terms << 0x1p60, 1, 1, 1, -0x1p60, 1, 1, 1;
  EXPECT_EQ(detail::dot(terms, ones), 3);
}

TEST(EventSimulator, ReportsNumbersThatLeaveTheRange) {
  const double huge = std::numeric_limits<double>::max();
  // The distance between the centres overflows at once.
  EXPECT_THROW(Rods({rod(1, -huge, 1), rod(1, huge, -1)}), SimulationError);
  // The meeting is too far in the future.
  Rods late({rod(1, 0, 0), rod(1, 1e10, -1e-300)});
  EXPECT_EQ(message_of<Error>([&] { late.step(); }),
            "simulation: collision 1: its time is out of the number type's range");
  // The radii are lost beside the distance, and the centres coincide.
  Rods lost({rod(1, 0, 0), rod(1, 1e100, -1)});
  EXPECT_EQ(message_of<Error>([&] { lost.step(); }),
            "simulation: collision 1: the state of particle 0 is out of the number type's range");
}

TEST(EventSimulator, ReportsEverythingWrongWithItsParticlesAtOnce) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Rod thin = rod(1, 5, 0);
  thin.radius = 0;
  Rod light_wall = rod(1, 9, 0);
  light_wall.facing[0] = 1;
  EXPECT_EQ(message_of<Error>([&] {
              Rods({rod(-1, nan, 0), thin, rod(1, 8, nan), light_wall});
            }),
            "simulation: particle 0: mass is not positive\n"
            "simulation: particle 0: position is not finite\n"
            "simulation: particle 1: radius is not positive and finite\n"
            "simulation: particle 2: velocity is not finite\n"
            "simulation: particle 3: is a wall, and its mass is not infinite");
}

}  // namespace
}  // namespace piblocks
