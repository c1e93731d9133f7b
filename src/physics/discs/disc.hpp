// Discs and walls as the disc engine keeps them.
// In: doubles in units in which the largest radius and the greatest speed are between 1 and 2.
// Out: where a disc is at any time of its flight.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

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

}  // namespace piblocks::discs
