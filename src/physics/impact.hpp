// Collisions taken together, for sound, which cannot tell the times of thousands apart.
// In: a collision log and a range of its indices. Out: one impact that stands for all of them.
#pragma once

#include <piblocks/run.hpp>

#include <optional>

namespace piblocks {

/// Collisions of one kind taken together: all their impulses at their mean time.
struct Impact {
  CollisionKind kind = CollisionKind::blocks;
  Time time;  ///< mean of the times, weighted by the impulses
  /// Sum of the impulses. The unit is the impulse that red, had it all the energy of the run, would
  /// give to blue at rest: 2 m_blue m_red / (m_blue + m_red) times its velocity.
  double impulse = 0;
  double blue_position = 0;  ///< of one collision; of several, a position between theirs
};

/// The collisions of this kind among first … last, which are indices of the log; nothing if there
/// are none.
std::optional<Impact> impact(const CollisionLog& log, CollisionKind kind, const Integer& first,
                             const Integer& last);

/// The count of state_at(), except that collisions within the rounding of `time` and of the engine
/// may count as earlier or later. The cost does not depend on the number of collisions.
Integer count_near(const CollisionLog& log, const Time& time);

}  // namespace piblocks
