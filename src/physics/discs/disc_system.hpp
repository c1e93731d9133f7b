// Discs and walls as the engine for discs keeps them, in units in which the largest radius and the
// greatest speed are between 1 and 2.
// In: a System, exact. Out: doubles, how far each may be from what was given, and where a disc is
// at any time of its flight.
#pragma once

#include <piblocks/system.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace piblocks::discs {

inline constexpr double kNever = std::numeric_limits<double>::infinity();
inline constexpr std::uint32_t kNobody = std::numeric_limits<std::uint32_t>::max();

struct Vector {
  double x = 0;
  double y = 0;
};

inline Vector operator+(Vector a, Vector b) { return {a.x + b.x, a.y + b.y}; }
inline Vector operator-(Vector a, Vector b) { return {a.x - b.x, a.y - b.y}; }
inline Vector operator*(double factor, Vector a) { return {factor * a.x, factor * a.y}; }
inline double dot(Vector a, Vector b) { return a.x * b.x + a.y * b.y; }
inline double cross(Vector a, Vector b) { return a.x * b.y - a.y * b.x; }
inline double length(Vector a) { return std::sqrt(dot(a, a)); }

/// One line of the cache.
struct Disc {
  Vector position;  ///< of the centre, at `time`
  Vector velocity;  ///< since then
  double time = 0;  ///< of the last meeting, or 0
  double radius = 0;
  std::uint32_t next = kNobody;      ///< in the list of its cell
  std::uint32_t previous = kNobody;  ///< there
  std::uint32_t meetings = 0;        ///< so far; an immovable disc counts none
  std::uint32_t last = kNobody;      ///< what it met last: a disc, or the number of discs + a wall
};

inline Vector position_at(const Disc& disc, double time) {
  return disc.position + (time - disc.time) * disc.velocity;
}

/// Centres keep dot(normal, centre) - offset - speed time >= radius.
struct WallLine {
  Vector normal;  ///< of length 1
  double offset = 0;
  double speed = 0;         ///< along the normal
  double normal_error = 0;  ///< bound of the length of the normal's error
  double offset_error = 0;
  double speed_error = 0;
};

/// The engine's units in those of the caller: powers of two, so that changing units rounds nothing.
struct Units {
  double length = 1;
  double speed = 1;
  double time = 1;
};

/// How far the true flight of a disc may be from the computed one, position + (t - time) velocity.
/// src/physics/README.md, "Discs", derives how the bounds grow.
struct Bound {
  double position = 0;  ///< at Disc::time
  double velocity = 0;
  double time_error = 0;  ///< the true last meeting is at most this far from Disc::time
};

/// The computed flight, and its bounds.
struct Flight {
  const Disc& disc;
  const Bound& bound;
};

struct DiscSystem {
  std::vector<Disc> discs = {};
  std::vector<double> masses = {};  ///< relative to the heaviest; kNever: immovable
  std::vector<Bound> bounds = {};
  std::vector<WallLine> walls = {};
  /// Of discs, then of walls, each at most: beside something movable, beside something immovable.
  /// Empty if all collisions are elastic.
  std::vector<std::array<double, 2>> restitutions = {};
  Units units = {};
  bool has_immovable = false;  ///< whether any disc is immovable

  // A body is a disc, or the number of discs + a wall.
  bool is_movable(std::uint32_t body) const {
    return body < discs.size() && (!has_immovable || masses[body] != kNever);
  }
  Flight flight(std::uint32_t disc) const { return {discs[disc], bounds[disc]}; }
  double restitution(std::uint32_t first, std::uint32_t second) const;
};

/// @param system  has no problems.
/// @throws SimulationError if doubles cannot hold all of its lengths, speeds or masses together.
DiscSystem disc_system_of(const System& system);

}  // namespace piblocks::discs
