// Systems of discs for property tests.
// In: random numbers. Out: discs that overlap neither each other nor the walls.
#pragma once

#include <piblocks/system.hpp>

#include <cmath>
#include <cstdint>
#include <vector>

#include "support/property.hpp"

namespace piblocks {

inline std::vector<Wall> box(const Rational& width, const Rational& height) {
  return {{"left", {0, 0}, {1, 0}},
          {"right", {width, 0}, {-1, 0}},
          {"bottom", {0, 0}, {0, 1}},
          {"top", {0, height}, {0, -1}}};
}

/// Many discs on a lattice of squares whose sides are 2.5.
/// @param ratio  of the largest radius, 1, to the least
inline System random_gas(Random& random, std::uint32_t number, double ratio = 1.5) {
  const auto columns = static_cast<std::uint32_t>(std::ceil(std::sqrt(number)));
  System system{.dimensions = 2};
  for (std::uint32_t i = 0; i < number; ++i) {
    Body body;
    body.size = Rational(random.uniform(1 / ratio, 1));
    body.mass = Rational(random.uniform(0.1, 10));
    body.position = {Rational(2.5 * (i % columns) + random.uniform(1.05, 1.45)),
                     Rational(2.5 * (i / columns) + random.uniform(1.05, 1.45))};
    body.velocity = {Rational(random.uniform(-1, 1)), Rational(random.uniform(-1, 1))};
    system.bodies.push_back(body);
  }
  const Rational side = Rational(5 * columns, 2);
  system.walls = box(side, side);
  return system;
}

namespace detail {

/// @param radius  of a disc that shall have room at the point
inline bool has_room(const System& system, const ExactVector& point, const Rational& radius) {
  for (const Body& other : system.bodies) {
    const Rational x = point[0] - other.position[0];
    const Rational y = point[1] - other.position[1];
    const Rational reach = radius + other.size;
    if (x * x + y * y < reach * reach) return false;
  }
  for (const Wall& wall : system.walls) {
    const Rational x = point[0] - wall.point[0];
    const Rational y = point[1] - wall.point[1];
    const Rational along = x * wall.normal[0] + y * wall.normal[1];
    const Rational square = wall.normal[0] * wall.normal[0] + wall.normal[1] * wall.normal[1];
    if (along < 0 || along * along < radius * radius * square) return false;
  }
  return true;
}

inline std::vector<Wall> random_walls(Random& random) {
  switch (random.integer(0, 3)) {
    case 0:
      return {};
    case 1:  // a triangle with slanted sides
      return {{"bottom", {0, 0}, {0, 1}},
              {"left", {0, 0}, {random.rational(2, 4, 7), random.rational(-2, -1, 5)}},
              {"right", {12, 0}, {random.rational(-4, -2, 7), random.rational(-2, -1, 5)}}};
    default:
      return box(random.rational(8, 14, 3), random.rational(8, 14, 7));
  }
}

}  // namespace detail

/// 2 to 8 discs of different sizes and masses, some of them immovable, some at rest; in a box, in a
/// triangle or in the open, where they fly towards the middle.
inline System random_discs(Random& random) {
  System system{.dimensions = 2, .bodies = {}, .walls = detail::random_walls(random)};
  const std::int64_t number = random.integer(2, 8);
  const double heaviest = random.integer(0, 3) == 0 ? 1e6 : 10;
  for (int attempt = 0; std::ssize(system.bodies) < number && attempt < 200; ++attempt) {
    Body body;
    body.size = Rational(random.uniform(0.1, random.integer(0, 4) == 0 ? 3 : 1));
    body.position = {Rational(random.uniform(0, 12)), Rational(random.uniform(0, 12))};
    if (!detail::has_room(system, body.position, body.size)) continue;
    body.mass = Rational(std::pow(heaviest, random.uniform(-0.5, 0.5)));
    if (random.integer(0, 9) == 0) body.mass.reset();
    if (body.mass && random.integer(0, 9) > 0) {
      const double inward = system.walls.empty() ? 0.2 : 0;
      for (std::size_t axis : {0u, 1u}) {
        body.velocity[axis] =
            Rational(random.uniform(-1, 1) + inward * (6 - body.position[axis].get_d()));
      }
    }
    system.bodies.push_back(body);
  }
  return system;
}

/// Collisions lose energy, by their own coefficients here and there; walls and immovable discs
/// move.
inline System with_loss_and_motion(Random& random, System system) {
  const auto loss = [&]() -> Rational { return random.rational(0, 1, 7); };
  system.restitution = loss();
  system.wall_restitution = random.integer(0, 2) == 0 ? loss() : Rational(1);
  const auto change = [&](auto& one) {
    if (random.integer(0, 4) == 0) one.restitution = loss();
  };
  for (Body& body : system.bodies) {
    change(body);
    if (body.mass) continue;
    for (Rational& part : body.velocity) part = random.rational(-1, 1, 9) / 4;
  }
  for (Wall& wall : system.walls) {
    change(wall);
    if (random.integer(0, 1) == 0) continue;
    for (Rational& part : wall.velocity) part = random.rational(-1, 1, 9) / 10;
  }
  return system;
}

/// Positions, radii and velocities are few tenths, masses few whole numbers: discs graze, touch at
/// the start, and meet several others at once, as far as numbers that no double holds tell.
inline System random_coincidences(Random& random) {
  System system{.dimensions = 2, .bodies = {}, .walls = {}};
  const int choice = static_cast<int>(random.integer(0, 2));
  if (choice == 1) system.walls = box(Rational(51, 10), Rational(51, 10));
  if (choice == 2) system.walls = {{"slope", {0, 0}, {1, 2}}, {"bottom", {0, 0}, {0, 1}}};
  const std::int64_t number = random.integer(2, 8);
  for (int attempt = 0; std::ssize(system.bodies) < number && attempt < 200; ++attempt) {
    Body body;
    body.size = Rational(random.integer(3, 5), 10);
    body.position = {Rational(random.integer(0, 17) * 3, 10),
                     Rational(random.integer(0, 17) * 3, 10)};
    body.size.canonicalize();
    for (Rational& part : body.position) part.canonicalize();
    if (!detail::has_room(system, body.position, body.size)) continue;
    body.mass = Rational(random.integer(1, 3));
    for (Rational& part : body.velocity) {
      part = Rational(random.integer(-3, 3), 10);
      part.canonicalize();
    }
    system.bodies.push_back(body);
  }
  return system;
}

/// Unit discs on places of a hexagonal lattice, their centres in doubles, some moving, some of them
/// on a floor; and one that comes from the left along a row or between two.
inline System random_rack(Random& random) {
  System system{.dimensions = 2, .restitution = random.rational(1, 2, 4) / 2};
  for (int row = 0; row < 3; ++row) {
    for (int k = 0; k < 3; ++k) {
      if (random.integer(0, 3) == 0) continue;
      Body body{1, {2 * k + row % 2, Rational(std::sqrt(3) * row)}};
      body.mass = random.integer(1, 3);
      if (random.integer(0, 9) == 0) body.mass.reset();
      const bool moves = body.mass && random.integer(0, 9) == 0;
      if (moves) body.velocity = {random.rational(-1, 1, 4), random.rational(-1, 1, 4)};
      system.bodies.push_back(body);
    }
  }
  if (random.integer(0, 1) == 0) system.walls = {{"floor", {0, -1}, {0, 1}}};
  const Rational height(std::sqrt(3) * 0.5 * static_cast<double>(random.integer(0, 4)));
  system.bodies.push_back({1, {-7, height}, {1, 0}});
  return system;
}

}  // namespace piblocks
