// Collisions a second of discs in a box, by the engine for discs and by the general one.
// In: nothing. Out: a table. Build it with the preset release.
#include <fmt/format.h>
#include <piblocks/event_simulator.hpp>

#include <cmath>
#include <ctime>
#include <random>
#include <string>
#include <vector>

#include "median.hpp"
#include "physics/discs/disc_stepper.hpp"

namespace piblocks::benchmark {
namespace {

constexpr double kPacking = 0.3;
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
void put_into(BodySystem& system, double radius, const Rational& width, const Rational& height) {
  const Body large = {Rational(radius * radius), {width / 2, height / 2}, {0, 0}, Rational(radius)};
  std::erase_if(system.bodies, [&](const Body& body) {
    const Rational x = body.position[0] - large.position[0];
    const Rational y = body.position[1] - large.position[1];
    const Rational reach = body.size + large.size;
    return x * x + y * y <= reach * reach;
  });
  system.bodies.push_back(large);
}

/// Discs of radius 1 on a square lattice, with random velocities, between four walls.
/// @param large_radius  of one more disc; 0 for none
BodySystem gas(std::uint32_t number, double large_radius) {
  std::mt19937_64 engine(number);
  const auto uniform = [&] { return static_cast<double>(engine() >> 11) * 0x1p-52 - 1; };
  const auto columns = static_cast<std::uint32_t>(std::ceil(std::sqrt(number)));
  const std::uint32_t rows = (number + columns - 1) / columns;
  const double spacing = std::sqrt(3.14159265 / kPacking * number / (columns * rows));
  BodySystem system{.dimensions = 2};
  for (std::uint32_t i = 0; i < number; ++i) {
    Body body;
    body.position = {Rational((i % columns + 0.5) * spacing),
                     Rational((i / columns + 0.5) * spacing)};
    body.velocity = {Rational(uniform()), Rational(uniform())};
    system.bodies.push_back(body);
  }
  const Rational width(columns * spacing);
  const Rational height(rows * spacing);
  system.walls = {{"left", {0, 0}, {1, 0}},
                  {"right", {width, 0}, {-1, 0}},
                  {"bottom", {0, 0}, {0, 1}},
                  {"top", {0, height}, {0, -1}}};
  if (large_radius > 0) put_into(system, large_radius, width, height);
  return system;
}

/// The same with balls instead of walls: the general engine knows no lines. Their radius is such
/// that they bulge by no more than rounding.
EventSimulator<double, 2> general(const BodySystem& system) {
  std::vector<Particle<double, 2>> balls;
  for (const Body& body : system.bodies) {
    balls.push_back({1,
                     1,
                     {body.position[0].get_d(), body.position[1].get_d()},
                     {body.velocity[0].get_d(), body.velocity[1].get_d()}});
  }
  constexpr double kRadius = 1e9;
  for (const Wall& wall : system.walls) {
    const Eigen::Vector2d point(wall.point[0].get_d(), wall.point[1].get_d());
    const Eigen::Vector2d normal(wall.normal[0].get_d(), wall.normal[1].get_d());
    balls.push_back({kInfiniteMass<double>, kRadius, point - kRadius * normal, {0, 0}});
  }
  return EventSimulator<double, 2>(balls);
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
    EventSimulator<double, 2> simulator = general(system);
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
