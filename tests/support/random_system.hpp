// Systems of two blocks for property tests.
// In: random numbers. Out: blocks that do not overlap, of any width, wherever the wall is.
#pragma once

#include <piblocks/two_blocks.hpp>

#include <cmath>

#include "support/property.hpp"

namespace piblocks {

/// Draws all but the masses and red's velocity.
inline void place_blocks(Random& random, TwoBlocks& system) {
  system.wall_face = random.rational(-3, 3, 4);
  system.blue.width = random.rational(1, 3, 5);
  system.red.width = random.rational(1, 3, 5);
  system.blue.position = system.wall_face + system.blue.width / 2 + random.rational(0, 4, 9);
  system.red.position = system.blue.position + (system.blue.width + system.red.width) / 2 +
                        random.rational(0, 4, 9) + Rational(1, 11);
  system.blue.velocity = random.rational(-3, 3, 8);
}

/// Red moves. @param least_log, most_log  of the mass ratio, to base e
inline TwoBlocks random_system(Random& random, double least_log, double most_log) {
  TwoBlocks system;
  system.blue.mass = random.rational(1, 50, 7);
  system.red.mass = system.blue.mass * Rational(std::exp(random.uniform(least_log, most_log)));
  place_blocks(random, system);
  system.red.velocity = random.rational(-3, 3, 8);
  if (system.red.velocity == 0) system.red.velocity = -1;
  return system;
}

}  // namespace piblocks
