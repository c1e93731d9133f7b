#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/eigen.hpp>
#include <gtest/gtest.h>
#include <piblocks/event_simulator.hpp>

#include <cmath>
#include <limits>

#include "support/traced_random.hpp"

namespace piblocks {
namespace {

template <typename ScalarType, int Dimension>
struct Space {
  using Scalar = ScalarType;
  static constexpr int kDim = Dimension;
};

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

}  // namespace
}  // namespace piblocks
