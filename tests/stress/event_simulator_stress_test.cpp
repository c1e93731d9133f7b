// The general engine on a line, with numbers from the whole range of a double.
#include <gtest/gtest.h>
#include <piblocks/error.hpp>
#include <piblocks/event_simulator.hpp>

#include <cmath>
#include <vector>

#include "stress/cases.hpp"

namespace piblocks::stress {
namespace {

using Simulator = EventSimulator<double, 1>;
constexpr std::int64_t kMaxEvents = 500;

double extreme(Random& random) {
  const std::int64_t kind = random.integer(0, 9);
  if (kind == 0) return 0;
  if (kind == 1) return 5e-324;
  if (kind == 2) return 1.7e308;
  return std::pow(10.0, kind < 6 ? random.uniform(-3, 3) : random.uniform(-320, 308));
}

std::vector<Simulator::Body> random_bodies(Random& random) {
  std::vector<Simulator::Body> bodies(static_cast<std::size_t>(random.integer(2, 6)));
  for (Simulator::Body& body : bodies) {
    body.mass = random.integer(0, 4) == 0 ? kInfiniteMass<double> : extreme(random);
    body.radius = extreme(random);
    body.position[0] = extreme(random) * (random.integer(0, 1) == 0 ? 1 : -1);
    body.velocity[0] = extreme(random) * (random.integer(0, 1) == 0 ? 1 : -1);
  }
  return bodies;
}

void expect_finite(const Simulator& simulator) {
  EXPECT_TRUE(std::isfinite(simulator.time()));
  for (const Simulator::Body& body : simulator.particles()) {
    EXPECT_TRUE(std::isfinite(body.position[0]) && std::isfinite(body.velocity[0]));
  }
}

TEST(EventSimulatorStress, EndsWithAResultOrATypedError) {
  for_each_case(5'000, 6'000'000, [](Random& random) {
    try {
      Simulator simulator(random_bodies(random));
      double before = 0;
      while (simulator.count() < kMaxEvents && simulator.step()) {
        expect_finite(simulator);
        EXPECT_GE(simulator.time(), before);
        before = simulator.time();
      }
    } catch (const UsageError&) {
    } catch (const SimulationError&) {
    }
  });
}

}  // namespace
}  // namespace piblocks::stress
