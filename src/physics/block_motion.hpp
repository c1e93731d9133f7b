// A block that meets nothing, now and in the past.
// In: a Block with exact values. Out: where it is, in doubles.
#pragma once

#include <piblocks/two_blocks.hpp>

namespace piblocks {

inline BlockMotion motion_of(const Block& block) {
  return {to_double(block.position), to_double(block.velocity)};
}

/// The motion at a time until which the block meets nothing, rounded once.
inline BlockMotion motion_at(const Block& block, const Rational& time) {
  return {to_double(block.position + block.velocity * time), to_double(block.velocity)};
}

inline BlockMotion reversed(const BlockMotion& motion) {
  return {motion.position, -motion.velocity};
}

/// The same blocks with opposite velocities: what they do is the past of `system`, backwards.
inline TwoBlocks reversed(TwoBlocks system) {
  system.blue.velocity = -system.blue.velocity;
  system.red.velocity = -system.red.velocity;
  return system;
}

}  // namespace piblocks
