// Collisions taken together, for sound, which cannot tell the times of thousands apart.
// In: collisions first … last of a log. Out: one impact that stands for all of them.
#pragma once

#include <piblocks/two_blocks.hpp>

#include <optional>

namespace piblocks {

/// Collisions of one kind taken together: all their impulses at their mean time.
///
/// The unit of two blocks is the impulse that red, had it all the energy of the run, would give to
/// blue at rest: 2 m_blue m_red / (m_blue + m_red) times its velocity. That of other bodies is mass
/// times velocity.
struct Impact {
  CollisionKind kind = CollisionKind::blocks;
  Time time;           ///< mean of the times, weighted by the impulses
  double impulse = 0;  ///< sum of the impulses
  /// Of blue, or of one of the bodies, along x: at one collision; of several, a place between.
  double position = 0;
};

/// For sound, a run's impulses are divided by this: 1 for two blocks; for other bodies, the impulse
/// that a wall gives a body of mean mass at the mean speed. Its cost grows with the number of
/// bodies.
double impulse_unit(const Log& log);

}  // namespace piblocks
