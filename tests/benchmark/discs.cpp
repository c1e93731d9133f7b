// Collisions a second of discs in a box, by the engine for discs and by the general one.
// In: nothing. Out: a table. Build it with the preset release.
#include <fmt/format.h>
#include <piblocks/event_simulator.hpp>
#include <piblocks/system.hpp>

#include <cstdint>
#include <string>
#include <vector>

#include "accuracy/deadline.hpp"
#include "disc_gas.hpp"
#include "median.hpp"
#include "physics/stepper.hpp"

namespace piblocks::benchmark {
namespace {

/// The balls that are walls for EventSimulator then bulge by no more than rounding.
constexpr double kWallRadius = 1e9;
constexpr double kSeconds = 1;
constexpr int kRuns = 5;

/// @param skip  collisions before the clock starts
/// @return collisions a second
template <typename Step>
double rate_of(Step step, std::int64_t skip) {
  for (std::int64_t k = 0; k < skip; ++k) step();
  const double start_s = thread_seconds();
  std::int64_t collisions = 0;
  double seconds = 0;
  while (seconds < kSeconds / kRuns) {
    for (int k = 0; k < 1000; ++k) step();
    collisions += 1000;
    seconds = thread_seconds() - start_s;
  }
  return static_cast<double>(collisions) / seconds;
}

void measure(std::uint32_t number) {
  const System system = disc_gas(number);
  std::vector<double> setups;
  std::vector<double> certain_rates;
  std::vector<double> rates;
  std::vector<double> general_rates;
  std::int64_t certain = 0;
  for (int run = 0; run < kRuns; ++run) {
    const double begin_s = thread_seconds();
    const auto stepper = make_disc_stepper(system);
    const double start_s = thread_seconds();
    setups.push_back((start_s - begin_s) * 1e3);
    certain = 0;
    while (stepper->certain_until() == kForEver && certain < 3'000'000) {
      stepper->step();
      ++certain;
    }
    certain_rates.push_back(static_cast<double>(certain) / (thread_seconds() - start_s));
    rates.push_back(rate_of([&] { stepper->step(); }, 5 * number));
    if (number > 1000) continue;
    EventSimulator<double, 2> simulator(
        particles_with_round_walls<double>(system, kWallRadius, to_double));
    general_rates.push_back(rate_of([&] { simulator.step(); }, 5));
  }
  fmt::print("| {} | {:.2f} | {} | {:.0f} | {:.0f} | {} |\n", number, *median(setups), certain,
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
}
