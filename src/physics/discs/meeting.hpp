// When two discs, or a disc and a wall, meet, and what their velocities are then.
// In: the states just after the last meetings of both. Out: a time, velocities.
// A time depends on these states alone, not on when it is computed: however the engine searches, it
// finds the same number.
#pragma once

#include <piblocks/contact.hpp>

#include <algorithm>
#include <cmath>

#include "physics/discs/disc_system.hpp"

namespace piblocks::discs {

/// Two discs in flight, seen from the first at the time of the later one's last meeting.
struct Encounter {
  double start;
  Vector distance;
  Vector velocity;
  double reach;  ///< sum of the radii

  Encounter(const Disc& a, const Disc& b)
      : start(std::max(a.time, b.time)),
        distance(position_at(b, start) - position_at(a, start)),
        velocity(b.velocity - a.velocity),
        reach(a.radius + b.radius) {}
};

/// The time at which two discs touch; kNever if they recede, keep their distance, pass by or graze.
///
/// The first root of |d + w s| = R, as the product of both roots over the larger one (Press et al.,
/// Numerical Recipes, 5.6). The discriminant is taken from d x w, which is as exact as d and w are,
/// instead of from the difference of (d.w)^2 and |d|^2 |w|^2. Swapping a and b changes signs only.
inline double meeting_time(const Disc& a, const Disc& b) {
  const Encounter seen(a, b);
  const double approach = -dot(seen.distance, seen.velocity);
  if (!(approach > 0)) return kNever;
  const double moment = cross(seen.distance, seen.velocity);
  const double reach2 = seen.reach * seen.reach;
  const double chord2 = reach2 * dot(seen.velocity, seen.velocity) - moment * moment;
  if (!(chord2 > 0)) return kNever;
  const double gap = dot(seen.distance, seen.distance) - reach2;
  if (gap <= 0) return seen.start;
  return seen.start + gap / (approach + std::sqrt(chord2));
}

/// How far a disc's edge is from a wall at a time.
inline double gap_to(const WallLine& wall, const Disc& disc, double time) {
  return dot(wall.normal, position_at(disc, time)) - (wall.offset + wall.speed * time) -
         disc.radius;
}

inline double closing_speed(const WallLine& wall, const Disc& disc) {
  return wall.speed - dot(wall.normal, disc.velocity);
}

inline double meeting_time(const Disc& disc, const WallLine& wall) {
  const double gap = gap_to(wall, disc, disc.time);
  return disc.time + time_to_contact(gap, closing_speed(wall, disc)).value_or(kNever);
}

/// Velocities after a collision. Nothing happens if rounding has made the discs recede.
/// @param apart  from the centre of a to that of b
inline void collide(Disc& a, double mass_a, Disc& b, double mass_b, Vector apart,
                    double restitution) {
  const Vector normal = (1 / length(apart)) * apart;
  const double closing_speed = dot(a.velocity - b.velocity, normal);
  if (!(closing_speed > 0)) return;
  const double share_a = share_of_change(mass_a, mass_b);
  const double share_b = share_of_change(mass_b, mass_a);
  a.velocity = a.velocity - velocity_change(closing_speed, share_a, restitution) * normal;
  b.velocity = b.velocity + velocity_change(closing_speed, share_b, restitution) * normal;
}

inline void reflect(Disc& disc, const WallLine& wall, double restitution) {
  const double closing = closing_speed(wall, disc);
  if (!(closing > 0)) return;
  disc.velocity = disc.velocity + velocity_change(closing, 1.0, restitution) * wall.normal;
}

}  // namespace piblocks::discs
