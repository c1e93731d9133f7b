// Any number of bodies: blocks on a line or discs in a plane, between walls.
// In: exact masses, positions, velocities. Out: everything that is wrong with them.
#pragma once

#include <piblocks/error.hpp>
#include <piblocks/exact.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace piblocks {

/// x and y. On a line y is 0.
using ExactVector = std::array<Rational, 2>;

/// A block on a line or a disc in a plane. It does not rotate; collisions are without friction.
struct Body {
  std::optional<Rational> mass = 1;  ///< > 0; nothing for a body that no collision moves
  ExactVector position = {};         ///< of the centre, at time 0
  ExactVector velocity = {};         ///< at time 0; without mass at all times
  Rational size = 1;                 ///< > 0; the width of a block, the radius of a disc
  std::string name = {};             ///< in keys and messages, as "blue"; else its number
  /// In place of the system's coefficients, 0 … 1. See restitution_of().
  std::optional<Rational> restitution = {};
};

/// A straight wall that no collision moves. Bodies are on the side to which the normal points.
struct Wall {
  std::string name;    ///< in logs and messages, as "left"
  ExactVector point;   ///< on the wall, at time 0
  ExactVector normal;  ///< not 0, of any length
  ExactVector velocity = {};
  std::optional<Rational> restitution = {};  ///< as of a Body
};

enum class Contacts : std::uint8_t {
  at_once,  ///< bodies that touch take part in each other's collisions, all at one instant
  in_order  ///< two at a time, in the order of TieRank (contact.hpp)
};

/// Bodies do not overlap each other nor the walls. Touching is allowed, and so is an overlap within
/// a few roundings of the coordinates to doubles, save of two_blocks_of().
struct System {
  int dimensions = 1;  ///< 1: blocks on the x axis; 2: discs
  std::vector<Body> bodies = {};
  std::vector<Wall> walls = {};
  /// Coefficients of restitution: what share of the speed at which two bodies approach each other
  /// they have when they part; 0 (they stay together) … 1 (elastic).
  Rational restitution = 1;       ///< of two bodies that collisions move
  Rational wall_restitution = 1;  ///< of a body and something immovable
  /// Nothing: at once for discs, in order for blocks.
  std::optional<Contacts> contacts = {};
};

/// Whether contacts are at once, as the system says or by default.
bool are_at_once(const System& system);

/// The coefficient of restitution of two that meet: the lower one of both. A body or a wall without
/// its own has that of the system for their kind.
/// @param first, second  as of Collision
Rational restitution_of(const System& system, std::size_t first, std::size_t second);

/// Whether all collisions keep the relative speed: all coefficients are 1.
bool is_elastic(const System& system);

/// Whether no collision moves it. @param id  as in Collision
bool is_immovable(const System& system, std::size_t id);

bool is_moving(const Wall& wall);
/// Whether something moves that no collision moves, such as a piston. It gives or takes energy.
bool is_driven(const System& system);

/// Whether the system is the usual one: blue, red, and a wall on their left. Scene files, tables
/// and messages then use these names.
bool has_short_names(const System& system);

inline constexpr int kMaxDigits = 100'000;

/// The mass ratio at which the collisions count pi to digits - 1 places after the point:
/// base^(2 (digits - 1)). In base 10 these are its first `digits` digits; in base 2 and 3, where
/// pi's whole part has two digits, there is one more.
/// @throws UsageError unless 1 <= digits <= kMaxDigits and kMinBase <= base <= kMaxBase.
Rational mass_ratio_of(int digits, int base = kUsualBase);

/// The article's system, with red that many times as heavy as blue.
/// @throws UsageError as mass_ratio_of()
System article_system(int digits, int base = kUsualBase);

/// Most bodies of a system. A scene file has room for fewer: kMaxSceneFile_bytes in script.hpp.
inline constexpr std::size_t kMaxBodies = 100'000;
inline constexpr std::size_t kMaxWalls = 16;

/// "body 3" for a body without a name: they are counted from 1. Or a name of this kind.
std::string body_key(const System& system, std::size_t body);

/// Everything that is wrong with a system; empty if nothing is. Keys are "body 3.mass", as of
/// body_key(), or "blue.mass" of a body with that name; "wall 1.normal", "body" and "wall". If
/// discs overlap, it names some; the others do not overlap. It takes about n log n steps for n
/// bodies, whatever their places and sizes are.
std::vector<Problem> problems_of(const System& system);

/// Whether collisions may never end: a body is in a closed box, or can return to two immovable
/// objects for ever.
bool may_never_end(const System& system);

}  // namespace piblocks
