// Discs in a box to measure with, and the same for the general engine.
// In: how many. Out: a System; particles of EventSimulator.
#pragma once

#include <piblocks/event_simulator.hpp>
#include <piblocks/system.hpp>

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace piblocks::benchmark {

/// Discs of radius 1 on a square lattice, with random velocities, between four walls.
inline System disc_gas(std::uint32_t number) {
  constexpr double kPacking = 0.3;
  std::mt19937_64 engine(number);
  const auto uniform = [&] { return static_cast<double>(engine() >> 11) * 0x1p-52 - 1; };
  const auto columns = static_cast<std::uint32_t>(std::ceil(std::sqrt(number)));
  const std::uint32_t rows = (number + columns - 1) / columns;
  const double spacing = std::sqrt(3.14159265 / kPacking * number / (columns * rows));
  System system{.dimensions = 2};
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
  return system;
}

/// The same with balls instead of walls: the general engine knows no lines. They bulge, and their
/// own size leaves rounding in all distances from them.
/// @param number_of  makes a Number of a Rational
template <typename Number, typename NumberOf>
std::vector<Particle<Number, 2>> particles_with_round_walls(const System& system,
                                                            const Number& wall_radius,
                                                            NumberOf number_of) {
  using Vector = typename Particle<Number, 2>::Vector;
  const auto vector = [&](const ExactVector& exact) {
    return Vector(number_of(exact[0]), number_of(exact[1]));
  };
  std::vector<Particle<Number, 2>> balls;
  for (const Body& body : system.bodies) {
    const Number mass = body.mass ? number_of(*body.mass) : kInfiniteMass<Number>;
    balls.push_back({mass, number_of(body.size), vector(body.position), vector(body.velocity)});
  }
  for (const Wall& wall : system.walls) {
    balls.push_back({kInfiniteMass<Number>, wall_radius,
                     Vector(vector(wall.point) - wall_radius * vector(wall.normal)),
                     Vector::Zero()});
  }
  return balls;
}

}  // namespace piblocks::benchmark
