// A block's motion as doubles, and a system whose time runs backwards.
// In: exact blocks. Out: what every engine makes of them at its start.
#pragma once

#include <piblocks/exact.hpp>
#include <piblocks/run.hpp>

namespace piblocks {

inline Motion motion_of(const Block& block) {
  return {to_double(block.position), to_double(block.velocity)};
}

/// The motion at a time until which the block meets nothing, rounded once.
inline Motion motion_at(const Block& block, const Rational& time) {
  return {to_double(block.position + block.velocity * time), to_double(block.velocity)};
}

/// The same blocks with opposite velocities: what they do is the past of `system`, backwards.
inline BlockSystem reversed(BlockSystem system) {
  system.blue.velocity = -system.blue.velocity;
  system.red.velocity = -system.red.velocity;
  return system;
}

}  // namespace piblocks
