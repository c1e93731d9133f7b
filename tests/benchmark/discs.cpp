// Collisions a second of discs in a box, by the engine for discs and by the general one.
// In: nothing. Out: a table. Build it with the preset release.
#include <fmt/format.h>
#include <piblocks/bodies.hpp>
#include <piblocks/event_simulator.hpp>

#include <cstdint>
#include <ctime>
#include <string>
#include <vector>

#include "disc_gas.hpp"
#include "median.hpp"
#include "physics/discs/disc_stepper.hpp"

namespace piblocks::benchmark {
namespace {

/// The balls that are walls for EventSimulator then bulge by no more than rounding.
constexpr double kWallRadius = 1e9;
constexpr double kSeconds = 1;
constexpr int kRuns = 5;

/// Processor time: other programs may be using the machine.
class Stopwatch {
 public:
  double seconds() const { return static_cast<double>(std::clock() - start_) / CLOCKS_PER_SEC; }

 private:
  std::clock_t start_ = std::clock();
};

/// Makes room in the middle for a disc that is as dense as the others.
void put_into(BodySystem& system, double radius) {
  const Rational& width = system.walls[1].point[0];
  const Rational& height = system.walls[3].point[1];
  const Body large = {Rational(radius * radius), {width / 2, height / 2}, {0, 0}, Rational(radius)};
  std::erase_if(system.bodies, [&](const Body& body) {
    const Rational x = body.position[0] - large.position[0];
    const Rational y = body.position[1] - large.position[1];
    const Rational reach = body.size + large.size;
    return x * x + y * y <= reach * reach;
  });
  system.bodies.push_back(large);
}

/// @param large_radius  of one more disc; 0 for none
BodySystem gas(std::uint32_t number, double large_radius) {
  BodySystem system = disc_gas(number);
  if (large_radius > 0) put_into(system, large_radius);
  return system;
}

/// @param skip  collisions before the clock starts
/// @return collisions a second
template <typename Step>
double rate_of(Step step, std::int64_t skip) {
  for (std::int64_t k = 0; k < skip; ++k) step();
  const Stopwatch stopwatch;
  std::int64_t collisions = 0;
  double seconds = 0;
  while (seconds < kSeconds / kRuns) {
    for (int k = 0; k < 1000; ++k) step();
    collisions += 1000;
    seconds = stopwatch.seconds();
  }
  return static_cast<double>(collisions) / seconds;
}

void measure(std::uint32_t number, double large_radius = 0) {
  const BodySystem system = gas(number, large_radius);
  std::vector<double> setups;
  std::vector<double> certain_rates;
  std::vector<double> rates;
  std::vector<double> general_rates;
  std::int64_t certain = 0;
  for (int run = 0; run < kRuns; ++run) {
    const Stopwatch setup;
    const auto stepper = make_disc_stepper(system);
    setups.push_back(setup.seconds() * 1e3);
    const Stopwatch stopwatch;
    certain = 0;
    while (stepper->certainty().until == Certainty::kForEver && certain < 3'000'000) {
      stepper->step();
      ++certain;
    }
    certain_rates.push_back(static_cast<double>(certain) / stopwatch.seconds());
    rates.push_back(rate_of([&] { stepper->step(); }, 5 * number));
    if (number > 1000) continue;
    EventSimulator<double, 2> simulator(
        particles_with_round_walls<double>(system, kWallRadius, to_double));
    general_rates.push_back(rate_of([&] { simulator.step(); }, 5));
  }
  const std::string name = large_radius > 0 ? fmt::format("{}, one of them {} times as large",
                                                          system.bodies.size(), large_radius)
                                            : std::to_string(number);
  fmt::print("| {} | {:.2f} | {} | {:.0f} | {:.0f} | {} |\n", name, *median(setups), certain,
             *median(certain_rates), *median(rates),
             general_rates.empty() ? "–" : fmt::format("{:.0f}", *median(general_rates)));
}

}  // namespace
}  // namespace piblocks::benchmark

int main() {
  using namespace piblocks::benchmark;
  fmt::print(
      "| Discs | set-up, ms | certain collisions | while certain, 1/s | then, 1/s | "
      "EventSimulator, 1/s |\n");
  for (const std::uint32_t number : {1u, 2u, 10u, 100u, 1000u, 10'000u, 100'000u}) measure(number);
  measure(10'000, 50);
}
