// Any number of bodies: blocks on a line or discs in a plane, between walls, and all their
// collisions.
// In: a BodySystem. Out: collisions and states by index and by time; up to when they are certain.
#pragma once

#include <piblocks/exact.hpp>
#include <piblocks/run.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace piblocks {

/// x and y. On a line y is 0.
using ExactVector = std::array<Rational, 2>;

/// A block on a line or a disc in a plane. It does not rotate; collisions are elastic and without
/// friction.
struct Body {
  std::optional<Rational> mass = 1;  ///< > 0; nothing for a body that no collision moves
  ExactVector position = {};         ///< of the centre, at time 0
  ExactVector velocity = {};         ///< at time 0; 0 for a body without mass
  Rational size = 1;                 ///< > 0; the width of a block, the radius of a disc
};

/// A straight wall that no collision moves. Bodies are on the side to which the normal points.
struct Wall {
  std::string name;    ///< in logs and messages, as "left"
  ExactVector point;   ///< on the wall
  ExactVector normal;  ///< not 0, of any length
};

/// Bodies do not overlap each other nor the walls. Touching is allowed.
struct BodySystem {
  int dimensions = 1;  ///< 1: blocks on the x axis; 2: discs
  std::vector<Body> bodies = {};
  std::vector<Wall> walls = {};
};

inline constexpr std::size_t kMaxBodies = 100'000;
inline constexpr std::size_t kMaxWalls = 16;

/// Everything that is wrong with a system; empty if nothing is. Keys are "body 3.mass", counted
/// from 1, "wall 1.normal" and "body".
std::vector<Problem> problems_of(const BodySystem& system);

/// The centre and the velocity of a body at one instant.
struct BodyMotion {
  std::array<double, 2> position = {};
  std::array<double, 2> velocity = {};
  bool operator==(const BodyMotion&) const = default;
};

/// What two bodies, or a body and a wall, are just after they have met.
struct BodyCollision {
  Integer index;       ///< as Timeline counts
  Time time;           ///< as exact as the engine knows it
  std::uint32_t first = 0;   ///< place of a body in BodySystem::bodies
  std::uint32_t second = 0;  ///< of another, > first; or bodies.size() and the place of a wall
  BodyMotion first_after;
  BodyMotion second_after;  ///< of a wall: nothing but zeros
};

/// All bodies at one instant.
struct BodiesState {
  Integer count;  ///< index of the last collision until then
  std::vector<BodyMotion> bodies;
};
}  // namespace piblocks
