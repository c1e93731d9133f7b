// The physical system: a wall, a blue block beside it, a red block beyond.
// In: exact numbers from a user. Out: a value that every engine starts from.
#pragma once

#include <piblocks/exact.hpp>

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

/// Order along the x axis: wall face, blue block, red block. Touching is allowed.
struct BlockSystem {
  Rational wall_face = 0;  ///< where the wall ends; blue never passes it
  Block blue = {1, 2, 0, 1};
  Block red = {10000, 5, -1, 1};

  /// Distance from the wall's face to blue's near side, at time 0.
  Rational blue_gap() const { return blue.position - blue.width / 2 - wall_face; }
  /// Distance from blue's far side to red's near side, at time 0.
  Rational blocks_gap() const {
    return red.position - red.width / 2 - (blue.position + blue.width / 2);
  }
};

/// When the blocks are nearest to the corner of wall and blocks, as the plane with axes
/// (sqrt(m) x gap) measures it: the middle of all collisions. It may be before time 0. Nothing if
/// neither block moves.
std::optional<Rational> turn_of(const BlockSystem& system);

/// Most digits that article_system() accepts.
inline constexpr int kMaxDigits = 100'000;

/// The article's system, in which the collisions count the first `digits` digits of pi:
/// m_red / m_blue = 100^(digits - 1).
/// @throws UsageError unless 1 <= digits <= kMaxDigits.
BlockSystem article_system(int digits);

/// What is wrong with one value of a scene.
struct Problem {
  std::string key;     ///< as in a scene file: "red.mass"
  std::string reason;  ///< with the value: "= -1: must be greater than 0"
};

/// Everything that is wrong with a system; empty if nothing is.
std::vector<Problem> problems_of(const BlockSystem& system);

/// One line a problem: key and reason.
std::vector<std::string> describe(const std::vector<Problem>& problems);

/// Text of a value for messages: exact where that is short.
std::string to_text(const Rational& value);

}  // namespace piblocks
