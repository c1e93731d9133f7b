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
  /// Of blue, or of one of the bodies, along x: at one collision; of several, a place between.
  double position = 0;
};

/// The collisions of this kind among first … last, which are indices of the log; nothing if there
/// are none.
std::optional<Impact> impact(const CollisionLog& log, CollisionKind kind, const Integer& first,
                             const Integer& last);

/// The count of state_at(), except that collisions within the rounding of `time` and of the engine
/// may count as earlier or later. The cost does not depend on the number of collisions.
Integer count_near(const CollisionLog& log, const Time& time);

/// The same of any log. What meets an immovable body has met a wall. The impulse of bodies is mass
/// times velocity.
std::optional<Impact> impact(const Timeline& log, CollisionKind kind, const Integer& first,
                             const Integer& last);
Integer count_near(const Timeline& log, const Time& time);

/// By which the impulses of a run are divided to be heard: of bodies, what a body of mean mass gets
/// from a wall that it meets at the mean speed; else 1. Its cost grows with the number of bodies.
double impulse_unit(const Timeline& log);

}  // namespace piblocks
