// What rounding may have done to discs: how their error bounds grow, and which meetings these leave
// possible.
// In: computed flights and their bounds. Out: bounds and times, rounded to the safe side.
// src/physics/README.md, "Discs", derives the formulas under the names that are used here.
#pragma once

#include <cstdint>
#include <optional>

#include "physics/discs/disc_system.hpp"

namespace piblocks::discs {

inline constexpr double kUnit = 0x1p-53;
/// Covers the rounding of the few operations that compute a bound, and of those that are said to be
/// right to a few u where second powers of u are left out.
inline constexpr double kUp = 1 + 0x1p-45;

/// How far the true centre may be from position_at(disc, time), as computed.
double drift(const Flight& flight, double time);

/// How far the true gap may be from gap_to() or from the computed distance less the radii.
double gap_error(const Flight& a, const Flight& b, double time);
double gap_error(const Flight& flight, const WallLine& wall, double time);

/// The time before which two discs truly do not meet, whatever rounding has done; kNever if they do
/// not meet before one of them has met another. It is before the last meeting of one of them if the
/// order of that and of this one is in doubt.
/// @param top_speed  of all discs, at least
/// @param is_one_event  whether the last meetings of both were one, several contacts at once
double earliest_meeting(const Flight& a, const Flight& b, double top_speed, bool is_one_event);
double earliest_meeting(const Flight& flight, const WallLine& wall, double top_speed);
/// The same if the last meeting did not change how the disc moves towards the wall. It may be
/// before that meeting.
double earliest_meeting_aside(const Flight& flight, const WallLine& wall);

/// A meeting that truly happens, with bounds of what is wrong with the computed one.
struct MeetingError {
  double time_error = 0;    ///< tau: how wrong the time may be
  double normal_error = 0;  ///< the sine of the angle between the true normal and the computed one
  double residual = 0;      ///< of |D| - R at the computed time, along the true normal
  double drift_a = 0;       ///< of the first disc at the computed time
  double drift_b = 0;       ///< of the second
  double speed = 0;         ///< |w|: the computed relative speed, at most
};

/// Nothing if it is in doubt that there is a meeting: a graze.
/// @param time  as meeting_time() has it
std::optional<MeetingError> error_of_meeting(const Flight& a, const Flight& b, double time);
std::optional<MeetingError> error_of_meeting(const Flight& flight, const WallLine& wall,
                                             double time);

/// Widens the bounds of two discs, a and b, which have just met. Those of an immovable disc stay.
void widen(const MeetingError& meeting, DiscSystem& system, std::uint32_t a, std::uint32_t b);
void widen(const MeetingError& meeting, const WallLine& wall, double restitution, Bound& bound);

}  // namespace piblocks::discs
