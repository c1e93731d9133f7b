// Two blocks and a wall: what a run begins with.
// In: exact masses, positions, velocities. Out: everything that is wrong with them; their turn.
#pragma once

#include <piblocks/exact.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace piblocks {

/// A block that slides without friction along the x axis. Lengths, times and masses are in the
/// scene's own units.
struct Block {
  Rational mass;      ///< > 0
  Rational position;  ///< of the block's centre at time 0
  Rational velocity;  ///< at time 0; positive away from the wall
  Rational width;     ///< > 0
};

/// Two blocks beside something immovable, seen from there: order along the x axis is wall face,
/// blue block, red block. Touching is allowed.
struct TwoBlocks {
  Rational wall_face = 0;  ///< where the wall ends; blue never passes it
  Block blue = {1, 2, 0, 1};
  Block red = {10000, 5, -1, 1};
  /// Coefficients of restitution: what share of the speed at which two bodies approach each other
  /// they have when they part; 0 (they stay together) … 1 (elastic).
  Rational blocks_restitution = 1;
  Rational wall_restitution = 1;  ///< of blue and the wall
  // Which bodies of a BodySystem they are, numbered as in BodyCollision.
  std::uint32_t blue_id = 0;
  std::uint32_t red_id = 1;
  std::uint32_t wall_id = 2;  ///< a body or a wall
  int side = 1;               ///< -1: in the system the wall is on the right

  /// The gaps at time 0, between the wall and blue and between blue and red.
  Rational blue_gap() const { return blue.position - blue.width / 2 - wall_face; }
  Rational blocks_gap() const {
    return red.position - red.width / 2 - (blue.position + blue.width / 2);
  }
};

/// Whether collisions keep the energy, so that the motion unfolds to a straight line and its past
/// is known.
inline bool is_elastic(const TwoBlocks& system) {
  return system.blocks_restitution == 1 && system.wall_restitution == 1;
}

/// When the blocks are nearest to the corner of wall and blocks, as the plane with axes
/// (sqrt(m) x gap) measures it: the middle of all collisions. It may be before time 0. Nothing if
/// neither block moves. With restitution below 1: when red is nearest to the wall, from time 0 on.
std::optional<Rational> turn_of(const TwoBlocks& system);

inline constexpr int kMaxDigits = 100'000;

/// The mass ratio at which the collisions count pi to digits - 1 places after the point:
/// base^(2 (digits - 1)). In base 10 these are its first `digits` digits; in base 2 and 3, where
/// pi's whole part has two digits, there is one more.
/// @throws UsageError unless 1 <= digits <= kMaxDigits and kMinBase <= base <= kMaxBase.
Rational mass_ratio_of(int digits, int base = kUsualBase);

/// The article's blocks, with red that many times as heavy as blue.
/// @throws UsageError as mass_ratio_of()
TwoBlocks article_blocks(int digits, int base = kUsualBase);

/// What is wrong with one value of a scene.
struct Problem {
  std::string key;     ///< as in a scene file: "red.mass"
  std::string reason;  ///< with the value: "= -1: must be greater than 0"
};

}  // namespace piblocks
