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
  /// Where two blocks touch, or the centre of one of other bodies, along x: at one collision; of
  /// several, a place between.
  double position = 0;
};

}  // namespace piblocks
