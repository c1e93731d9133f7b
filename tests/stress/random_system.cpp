#include "stress/random_system.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "stress/log_checks.hpp"

namespace piblocks::stress {
namespace {

bool one_in(Random& random, std::int64_t n) { return random.integer(1, n) == 1; }

/// 10^x for a uniform x.
double decades(Random& random, double low, double high) {
  return std::pow(10.0, random.uniform(low, high));
}

double sign(Random& random) { return one_in(random, 2) ? 1 : -1; }

Rational power_of_two(long exponent) {
  const Rational power_of = power(2, static_cast<unsigned long>(std::labs(exponent)));
  return exponent < 0 ? Rational(1 / power_of) : power_of;
}

void choose_masses(Random& random, TwoBlocks& system) {
  const auto span = random.integer(0, 5);
  system.blue.mass = span == 0 ? decades(random, -300, 300) : decades(random, -3, 3);
  if (span == 0) {
    system.red.mass = decades(random, -300, 300);
  } else if (span == 1) {
    system.red.mass = system.blue.mass;
  } else if (span == 2) {
    const Rational hair = sign(random) * power_of_two(-random.integer(1, 100));
    system.red.mass = system.blue.mass * (1 + hair / 2);
  } else if (span == 3) {
    const auto digits = static_cast<unsigned long>(random.integer(0, 60));
    system.red.mass = system.blue.mass * power(10, digits);
  } else {
    system.red.mass = system.blue.mass * Rational(decades(random, -2, span == 4 ? 3 : 16));
  }
}

/// Each choose_…() takes the unit that its numbers are scattered about.
void choose_places(Random& random, double unit, TwoBlocks& system) {
  const auto length = [&] {
    return one_in(random, 3) ? unit * decades(random, -20, 6) : unit * decades(random, -1, 1);
  };
  const auto gap = [&] { return one_in(random, 6) ? 0.0 : length(); };
  system.blue.width = length();
  system.red.width = length();
  system.wall_face = one_in(random, 2) ? 0 : sign(random) * length();
  system.blue.position = system.wall_face + system.blue.width / 2 + gap();
  system.red.position = system.blue.position + (system.blue.width + system.red.width) / 2 + gap();
}

void choose_velocities(Random& random, double unit, TwoBlocks& system) {
  const auto velocity = [&] {
    const double size = one_in(random, 3) ? decades(random, -10, 6) : decades(random, -1, 1);
    return Rational(sign(random) * unit * size);
  };
  system.blue.velocity = one_in(random, 3) ? Rational(0) : velocity();
  system.red.velocity = one_in(random, 8) ? Rational(0) : velocity();
  if (one_in(random, 12)) system.blue.velocity = system.red.velocity;
  if (one_in(random, 12)) {  // into the corner, or out of it
    const Rational rate = velocity() / Rational(decades(random, -3, 3));
    const Rational y1 = system.blue_gap();
    system.blue.velocity = rate * y1;
    system.red.velocity = rate * (y1 + system.blocks_gap());
  }
}

/// Blue's velocity if it had all the energy.
Wide greatest_velocity(const TwoBlocks& system) {
  const Wide red_over_blue = root(system.red.mass / system.blue.mass);
  return std::fabs(to_wide(system.blue.velocity)) +
         std::fabs(to_wide(system.red.velocity)) * std::max(red_over_blue, Wide(1));
}

}  // namespace

TwoBlocks random_system(Random& random) {
  TwoBlocks system;
  choose_masses(random, system);
  choose_places(random, one_in(random, 4) ? decades(random, -80, 80) : 1, system);
  choose_velocities(random, one_in(random, 4) ? decades(random, -100, 100) : 1, system);
  const Wide greatest = greatest_velocity(system);
  if (greatest > 1e250L) {
    const Rational slower(static_cast<double>(1e200L / greatest));
    system.blue.velocity *= slower;
    system.red.velocity *= slower;
  }
  return system;
}

TwoBlocks random_system_of_any_size(Random& random) {
  constexpr std::array<double, 6> kUnits = {5e-324, 1e-300, 1e-155, 1, 1e155, 1e290};
  const auto unit = [&] { return kUnits[static_cast<std::size_t>(random.integer(0, 5))]; };
  TwoBlocks system;
  do {
    choose_masses(random, system);
    choose_places(random, unit(), system);
    choose_velocities(random, unit(), system);
  } while (!problems_of(system_of(system)).empty());  // a width may have underflowed to zero
  return system;
}

std::string describe(const TwoBlocks& system) {
  const auto block = [](const char* name, const Block& b) {
    return fmt::format("{}: mass {}, position {}, velocity {}, width {}", name, to_double(b.mass),
                       to_double(b.position), to_double(b.velocity), to_double(b.width));
  };
  return fmt::format("wall {}; {}, gap {}; {}, gap {}", to_double(system.wall_face),
                     block("blue", system.blue), to_double(system.blue_gap()),
                     block("red", system.red), to_double(system.blocks_gap()));
}

}  // namespace piblocks::stress
