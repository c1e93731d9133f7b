// The discs and walls of a system in units of the engine.
// In: a System, exact. Out: doubles, and how far each may be from what was given.
#pragma once

#include <piblocks/system.hpp>

#include <array>
#include <cstdint>
#include <vector>

#include "physics/discs/disc.hpp"

namespace piblocks::discs {

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

  bool is_movable(std::uint32_t disc) const { return !has_immovable || masses[disc] != kNever; }
  /// @param first   a disc
  /// @param second  a disc, or the number of discs + a wall
  double restitution(std::uint32_t first, std::uint32_t second) const;
};

/// @param system  has no problems.
/// @throws SimulationError if doubles cannot hold all of its lengths, speeds or masses together.
DiscSystem disc_system_of(const System& system);

}  // namespace piblocks::discs
