// Numbers that a double cannot hold are an error, never an infinity in somebody's frame.
// In: a flight. Out: nothing, or an exception.
#pragma once

#include <fmt/format.h>
#include <piblocks/collision_log.hpp>
#include <piblocks/error.hpp>

#include <cmath>

namespace piblocks {

/// @param engine  who computed it, for the message
/// @throws SimulationError if a number of the flight is not finite.
inline void require_finite(const FreeFlight& flight, const char* engine) {
  for (const double number : {flight.anchor.hi, flight.blue.position, flight.blue.velocity,
                              flight.red.position, flight.red.velocity}) {
    if (std::isfinite(number)) continue;
    throw SimulationError(
        fmt::format("{}: a time, position or velocity is beyond the range of a double (about "
                    "1.8e308)",
                    engine));
  }
}

}  // namespace piblocks
