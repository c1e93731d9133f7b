#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/eigen.hpp>
#include <gtest/gtest.h>
#include <piblocks/error.hpp>
#include <piblocks/event_simulator.hpp>

#include <cmath>
#include <limits>

#include "support/message_of.hpp"
#include "support/traced_random.hpp"

namespace piblocks {
namespace {

template <typename ScalarType, int Dimension>
struct Space {
  using Scalar = ScalarType;
  static constexpr int kDim = Dimension;
};

using testing_support::message_of;
using Wide = boost::multiprecision::cpp_bin_float_50;

/// Properties that hold in every dimension and for every number type.
template <typename SpaceType>
class EventSimulatorIn : public testing::Test {
 protected:
  using Scalar = typename SpaceType::Scalar;
  static constexpr int kDim = SpaceType::kDim;
  using Body = Particle<Scalar, kDim>;
  using Vector = typename Body::Vector;
  using Simulator = EventSimulator<Scalar, kDim>;

  /// Balls on the points of a grid, so that none overlap, thrown towards the middle.
  static std::vector<Body> random_balls(int number, Random& random) {
    std::vector<Body> balls;
    for (int i = 0; i < number; ++i) {
      Body ball;
      ball.mass = Scalar(random.uniform(0.1, 10));
      ball.radius = Scalar(random.uniform(0.2, 0.5));
      int cell = i;
      for (int axis = 0; axis < kDim; ++axis) {
        const int side = kDim == 1 ? number : 4;
        ball.position[axis] = Scalar(2 * (cell % side)) + Scalar(random.uniform(-0.4, 0.4));
        cell /= side;
        const double centre = kDim == 1 ? number : 3;
        const double inward = centre - static_cast<double>(ball.position[axis]);
        ball.velocity[axis] = Scalar(inward * 0.5 + random.uniform(-1, 1));
      }
      balls.push_back(ball);
    }
    return balls;
  }

  static Vector momentum(const std::vector<Body>& balls) {
    Vector sum = Vector::Zero();
    for (const Body& ball : balls) sum += ball.mass * ball.velocity;
    return sum;
  }

  static Scalar energy(const std::vector<Body>& balls) {
    Scalar sum(0);
    for (const Body& ball : balls) sum += ball.mass * ball.velocity.squaredNorm() / 2;
    return sum;
  }

  static double as_double(const Scalar& value) { return static_cast<double>(value); }

  /// How far rounding may have gone; `epsilons` is a generous count of them.
  static double tolerance(double epsilons) {
    return epsilons * static_cast<double>(std::numeric_limits<Scalar>::epsilon());
  }

  static double distance(const Vector& a, const Vector& b) {
    return as_double(Vector(a - b).norm());
  }
};

using Spaces = testing::Types<Space<double, 1>, Space<double, 2>, Space<double, 3>,
                              Space<long double, 1>, Space<long double, 2>, Space<long double, 3>,
                              Space<Wide, 1>, Space<Wide, 2>, Space<Wide, 3>>;
TYPED_TEST_SUITE(EventSimulatorIn, Spaces);

TYPED_TEST(EventSimulatorIn, ConservesMomentumAndEnergyAndKeepsBallsApart) {
  TracedRandom random(11);
  std::int64_t collisions = 0;
  for (int trial = 0; trial < 10; ++trial) {
    const auto balls = TestFixture::random_balls(12, random);
    typename TestFixture::Simulator simulator(balls);
    const double energy = TestFixture::as_double(TestFixture::energy(balls));
    auto last_time = simulator.time();
    while (const auto event = simulator.step()) {
      ASSERT_GE(event->time, last_time);
      last_time = event->time;
      const auto& now = simulator.particles();
      for (std::size_t i = 0; i < now.size(); ++i) {
        for (std::size_t j = i + 1; j < now.size(); ++j) {
          const double reach = TestFixture::as_double(now[i].radius + now[j].radius);
          ASSERT_GT(TestFixture::distance(now[i].position, now[j].position),
                    reach - TestFixture::tolerance(1e4) - 1e-15);
        }
      }
    }
    EXPECT_LT(TestFixture::distance(TestFixture::momentum(simulator.particles()),
                                    TestFixture::momentum(balls)),
              TestFixture::tolerance(1e4));
    EXPECT_NEAR(TestFixture::as_double(TestFixture::energy(simulator.particles()) -
                                       TestFixture::energy(balls)),
                0, energy * TestFixture::tolerance(1e3));
    collisions += simulator.count();
  }
  EXPECT_GT(collisions, 30);
}

// Errors grow with every collision of convex bodies, so the way back is retraced for a few.
TYPED_TEST(EventSimulatorIn, RetracesItsPathWhenVelocitiesAreReversed) {
  TracedRandom random(12);
  const auto start = TestFixture::random_balls(8, random);
  typename TestFixture::Simulator forth(start);
  while (forth.count() < 6 && forth.step()) {
  }
  ASSERT_GE(forth.count(), 2);
  auto turned = forth.next_time() ? forth.particles_at((forth.time() + *forth.next_time()) / 2)
                                  : forth.particles();
  auto way_back = forth.next_time() ? (forth.time() + *forth.next_time()) / 2 : forth.time();
  for (auto& ball : turned) ball.velocity = -ball.velocity;
  typename TestFixture::Simulator back(turned);
  while (back.next_time() && *back.next_time() < way_back) back.step();
  EXPECT_EQ(back.count(), forth.count());
  const auto returned = back.particles_at(way_back);
  for (std::size_t i = 0; i < start.size(); ++i) {
    EXPECT_LT(TestFixture::distance(returned[i].position, start[i].position),
              TestFixture::tolerance(1e7));
    EXPECT_LT(TestFixture::distance(returned[i].velocity, -start[i].velocity),
              TestFixture::tolerance(1e7));
  }
}

TYPED_TEST(EventSimulatorIn, NewtonsCradlePassesTheVelocityOn) {
  using Number = typename TestFixture::Scalar;
  std::vector<typename TestFixture::Body> balls(5);
  for (std::size_t i = 0; i < balls.size(); ++i) balls[i].position[0] = Number(2 * i);
  balls[0].position[0] = Number(-3);
  balls[0].velocity[0] = Number(1);
  typename TestFixture::Simulator simulator(balls);
  const auto events = simulator.run(100);
  ASSERT_EQ(events.size(), 4u);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(events[k].index, static_cast<std::int64_t>(k) + 1);
    EXPECT_EQ(events[k].time, 3);
    EXPECT_EQ(events[k].first, k);
    EXPECT_EQ(events[k].second, k + 1);
    EXPECT_EQ(simulator.particles()[k].velocity[0], 0);
  }
  EXPECT_EQ(simulator.particles()[4].velocity[0], 1);
}

using Rods = EventSimulator<double, 1>;
using Rod = Particle<double, 1>;

Rod rod(double mass, double position, double velocity) {
  return {mass, 0.5, Rod::Vector(position), Rod::Vector(velocity)};
}

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
