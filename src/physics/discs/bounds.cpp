#include "physics/discs/bounds.hpp"

#include <algorithm>
#include <cmath>

#include "physics/discs/meeting.hpp"

namespace piblocks::discs {
namespace {

constexpr double kDown = 1 - 0x1p-45;
/// More than what underflow takes from any product here.
constexpr double kTiny = 0x1p-900;

double size_of(Vector a) { return std::abs(a.x) + std::abs(a.y); }

/// What a wall's motion adds to the errors of its place and of a closing speed; 0 if it rests.
double place_error(const WallLine& wall, double time) {
  return (wall.speed_error + 8 * kUnit * std::abs(wall.speed)) * time;
}
double speed_error(const WallLine& wall) {
  return wall.speed_error + 4 * kUnit * std::abs(wall.speed);
}

/// A bound for the error of the gap between a disc and a wall.
/// @param error  of the disc's position, or of the gap without the wall's own errors
double wall_gap_error(double error, const Disc& disc, const WallLine& wall, double time) {
  const double place = size_of(position_at(disc, time));
  return (error + place * wall.normal_error + wall.offset_error +
          8 * kUnit * (place + std::abs(wall.offset) + disc.radius) + place_error(wall, time)) *
         kUp;
}

/// At least |w|, even if its square underflows.
double speed_above(Vector w) { return length(w) * kUp + 0x1p-440; }

/// What is known of two discs at the time of the later one's last meeting.
struct Sight {
  Encounter seen;
  double distance;  ///< |d|
  double speed;     ///< |w|, at least
  double e;         ///< |D - d|, the radii's errors and the rounding of |d| - R, at most
  double b;         ///< |W - w|, at most

  Sight(const Flight& one, const Flight& other)
      : seen(one.disc, other.disc),
        distance(length(seen.distance)),
        speed(speed_above(seen.velocity)),
        e((drift(one, seen.start) + drift(other, seen.start) +
           8 * kUnit * (distance + seen.reach)) *
          kUp),
        b((one.bound.velocity + other.bound.velocity + 2 * kUnit * speed) * kUp) {
    // Equal velocities are subtracted without rounding.
    if (seen.velocity.x == 0 && seen.velocity.y == 0) {
      b = (one.bound.velocity + other.bound.velocity) * kUp;
    }
  }
};

/// start - time_error, rounded down: less than start, if only by rounding, unless both are 0.
double time_before(double start, double time_error) {
  return start - time_error * kUp - 2 * kUnit * start;
}

/// Whether the flights before and after each other's last meeting cannot be confused.
bool are_in_order(const Flight& a, const Flight& b) {
  const auto ends_before = [](const Flight& first, const Flight& second) {
    const double time = first.disc.time;
    const double error = first.bound.time_error;
    return (time == 0 && error == 0) || time + error * kUp + 2 * kUnit * time <=
                                            time_before(second.disc.time, second.bound.time_error);
  };
  return ends_before(a, b) || ends_before(b, a);
}

/// Whether D.W > 0 since the flights began: the discs were apart then and move away.
bool surely_recede(const Sight& sight, double time_error) {
  const double product = dot(sight.seen.distance, sight.seen.velocity);
  const double speed = sight.speed + sight.b;
  const double doubt = sight.e * speed + sight.b * sight.distance + speed * speed * time_error +
                       8 * kUnit * sight.distance * speed + kTiny;
  return product > doubt * kUp;
}

/// For b <= |w| / 2: the root of |d + w s| = R + b s, at most, or less.
double earliest_approach(const Sight& sight, double reach) {
  const Vector d = sight.seen.distance;
  const Vector w = sight.seen.velocity;
  const double w2 = dot(w, w);
  const double approach = -dot(d, w);
  const double b_over_w = sight.b / std::sqrt(w2);
  // The bound is taken where the centres are nearest; behind that point it grows more slowly than
  // the distance if the miss is this much larger.
  const double nearest = std::max(approach / w2, 0.0);
  const double wide =
      (reach + sight.b * nearest) * (1 + b_over_w * b_over_w) * kUp + 64 * kUnit * sight.distance;
  if (approach <= 0) return sight.distance > wide ? kNever : 0;
  const double moment = cross(d, w);
  if (std::abs(moment) > wide * std::sqrt(w2)) return kNever;
  if (sight.distance <= wide) return 0;
  const double chord2 = std::max(wide * wide * w2 - moment * moment, 0.0);
  // What is added to `wide` covers the rounding of all but d.w.
  const double rounding = 8 * kUnit * sight.distance * sight.speed;
  return (sight.distance - wide) * (sight.distance + wide) /
         (approach + std::sqrt(chord2) + rounding) * kDown;
}

/// start + wait, rounded down
double time_after(double start, double wait) {
  const double time = start + wait;
  return time == kNever ? kNever : time - 2 * kUnit * (start + std::abs(wait));
}

/// How a disc moves towards a wall since its last meeting.
struct Approach {
  double b;        ///< the error of the closing speed, at most
  double fastest;  ///< the closing speed, at most
  double gap;      ///< at the last meeting, at least

  Approach(const Flight& flight, const WallLine& wall)
      : gap(gap_to(wall, flight.disc, flight.disc.time) -
            gap_error(flight, wall, flight.disc.time)) {
    const auto& [disc, bound] = flight;
    const Vector v = disc.velocity;
    // A product with 0 is exact, so a disc that flies along a horizontal wall has no error here.
    const double rounding =
        4 * kUnit * (std::abs(wall.normal.x * v.x) + std::abs(wall.normal.y * v.y));
    b = (bound.velocity + size_of(v) * wall.normal_error + rounding + speed_error(wall)) * kUp;
    const double closing = closing_speed(wall, disc);
    fastest = b + closing;
  }

  bool never_meets() const { return fastest < 0 || (fastest == 0 && b == 0); }
  /// The earliest time of contact. @param start  of the last meeting
  double time_from(double start) const {
    if (fastest == 0) return kNever;
    return time_after(start, gap / fastest * (gap > 0 ? kDown : kUp));
  }
};

}  // namespace

double drift(const Flight& flight, double time) {
  const auto& [disc, bound] = flight;
  const double duration = std::abs(time - disc.time);
  if (duration == 0) return bound.position;
  const Vector there = position_at(disc, time);
  const double rounding = 4 * kUnit * (size_of(there) + size_of(disc.velocity) * duration);
  return (bound.position + bound.velocity * duration + rounding) * kUp + kTiny;
}

double gap_error(const Flight& a, const Flight& b, double time) {
  const double distance = length(position_at(b.disc, time) - position_at(a.disc, time));
  return (drift(a, time) + drift(b, time) +
          8 * kUnit * (distance + a.disc.radius + b.disc.radius)) *
         kUp;
}

double gap_error(const Flight& flight, const WallLine& wall, double time) {
  return wall_gap_error(drift(flight, time), flight.disc, wall, time);
}

double earliest_meeting(const Flight& a, const Flight& b, double top_speed, bool is_one_event) {
  const Sight sight(a, b);
  const Vector w = sight.seen.velocity;
  const double time_error = a.bound.time_error + b.bound.time_error;
  // Exactly at rest to each other.
  if (w.x == 0 && w.y == 0 && sight.b == 0 && time_error == 0) return kNever;
  const bool is_ordered = is_one_event || are_in_order(a, b);
  if (is_ordered && surely_recede(sight, time_error)) return kNever;
  const double reach = sight.seen.reach + sight.e;
  const double gap = sight.distance - reach;
  if (!(gap > 8 * top_speed * time_error)) return time_before(sight.seen.start, time_error);
  if (sight.b > sight.speed / 2 || dot(w, w) < kTiny) {
    return time_after(sight.seen.start, gap / (sight.speed + sight.b) * kDown);
  }
  return time_after(sight.seen.start, earliest_approach(sight, reach));
}

double earliest_meeting(const Flight& flight, const WallLine& wall, double top_speed) {
  const auto& [disc, bound] = flight;
  const Approach approach(flight, wall);
  if (approach.never_meets()) return kNever;
  if (!(approach.gap > 8 * top_speed * bound.time_error)) {
    return time_before(disc.time, bound.time_error);
  }
  return approach.time_from(disc.time);
}

double earliest_meeting_aside(const Flight& flight, const WallLine& wall) {
  const auto& [disc, bound] = flight;
  const Approach approach(flight, wall);
  if (approach.never_meets()) return kNever;
  // What came before the last meeting was ordered when it was planned.
  return std::max(approach.time_from(disc.time), time_before(disc.time, bound.time_error));
}

std::optional<MeetingError> error_of_meeting(const Flight& a, const Flight& b, double time) {
  const Vector d = position_at(b.disc, time) - position_at(a.disc, time);
  const Vector w = b.disc.velocity - a.disc.velocity;
  const double distance = length(d);
  const double reach = a.disc.radius + b.disc.radius;
  const double speed = speed_above(w);
  MeetingError meeting;
  meeting.drift_a = drift(a, time);
  meeting.drift_b = drift(b, time);
  meeting.speed = speed;
  const double e = (meeting.drift_a + meeting.drift_b + 2 * kUnit * distance) * kUp;
  const double gap = (std::abs(distance - reach) + 8 * kUnit * (distance + reach)) * kUp;
  const double velocity_error = (a.bound.velocity + b.bound.velocity + 2 * kUnit * speed) * kUp;
  const double surely = -dot(w, d) / distance - 8 * kUnit * speed - velocity_error;
  if (!(surely > 0)) return std::nullopt;
  const double root2 = surely * surely - 2 * (e + gap) * speed * speed / distance * kUp;
  if (!(root2 > 0)) return std::nullopt;
  meeting.time_error = 2 * (e + gap) / (surely + std::sqrt(root2)) * kUp;
  const double shift = (e + (velocity_error + speed) * meeting.time_error) * kUp;
  if (!(shift < distance / 2)) return std::nullopt;
  const double sideways = std::abs(cross(w, d)) / distance + 8 * kUnit * speed;
  meeting.normal_error = (e + (velocity_error + sideways) * meeting.time_error) / reach * kUp;
  meeting.residual = (gap + distance * meeting.normal_error * meeting.normal_error) * kUp;
  if (!(meeting.normal_error < 0.5)) return std::nullopt;
  return meeting;
}

std::optional<MeetingError> error_of_meeting(const Flight& flight, const WallLine& wall,
                                             double time) {
  const auto& [disc, bound] = flight;
  MeetingError meeting;
  meeting.drift_a = drift(flight, time);
  meeting.speed = speed_above(disc.velocity) + std::abs(wall.speed) * kUp;
  meeting.normal_error = wall.normal_error;
  meeting.residual = wall_gap_error(std::abs(gap_to(wall, disc, time)), disc, wall, time);
  const double error =
      (bound.velocity + meeting.speed * (wall.normal_error + 4 * kUnit) + speed_error(wall)) * kUp;
  const double surely = closing_speed(wall, disc) - error;
  if (!(surely > 0)) return std::nullopt;
  meeting.time_error = (meeting.drift_a + meeting.residual) / surely * kUp;
  return meeting;
}

namespace {

/// What a reflection leaves of two error vectors: of the own one and 2 share times a projection of
/// their difference. It keeps the sum of the squares, each times the mass.
double reflected(double own, double other, double share, double other_share) {
  if (other == 0) return own;
  const double by_mass = std::sqrt(own * own + share / other_share * other * other);
  return std::min(own + 2 * share * other, by_mass);
}

}  // namespace

void widen(const MeetingError& meeting, DiscSystem& system, std::uint32_t a, std::uint32_t b) {
  const double mass_a = system.masses[a];
  const double mass_b = system.masses[b];
  const double share_a = share_of_change(mass_a, mass_b);
  const double share_b = share_of_change(mass_b, mass_a);
  const double turned = meeting.speed * (meeting.normal_error + 32 * kUnit);
  const auto after = [&](const Bound& own, const Bound& other, double share, double other_share,
                         std::uint32_t disc) {
    const double position =
        reflected(own.position, other.position, share, other_share) + 2 * share * meeting.residual;
    const double velocity = reflected(own.velocity, other.velocity, share, other_share) +
                            2 * share * turned + 2 * kUnit * size_of(system.discs[disc].velocity);
    return Bound{position * kUp + kTiny, velocity * kUp + kTiny, meeting.time_error};
  };
  const Bound before_a = {meeting.drift_a, system.bounds[a].velocity, 0};
  const Bound before_b = {meeting.drift_b, system.bounds[b].velocity, 0};
  if (mass_a != kNever) system.bounds[a] = after(before_a, before_b, share_a, share_b, a);
  if (mass_b != kNever) system.bounds[b] = after(before_b, before_a, share_b, share_a, b);
}

void widen(const MeetingError& meeting, const WallLine& wall, double restitution, Bound& bound) {
  // Elastic upright and level walls at rest negate one part of the velocity, which rounds nothing.
  if (wall.normal_error > 0 || wall.speed != 0 || restitution != 1) {
    const double turned = meeting.speed * (5 * wall.normal_error + 16 * kUnit);
    bound.velocity = (bound.velocity + turned + 2 * speed_error(wall)) * kUp + kTiny;
  }
  bound.position = (meeting.drift_a + 2 * meeting.residual) * kUp + kTiny;
  bound.time_error = meeting.time_error;
}

}  // namespace piblocks::discs
