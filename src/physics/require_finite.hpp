// Numbers that a double cannot hold are an error, never an infinity in somebody's frame.
// In: what is known of one instant. Out: nothing, or an exception.
#pragma once

#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/run.hpp>

#include <cmath>

namespace piblocks {

/// @param engine  who computed it, for the message
/// @throws SimulationError if a number is not finite.
inline void require_finite(const Time& time, const Motion& blue, const Motion& red,
                           const char* engine) {
  for (const double number : {time.hi, blue.position, blue.velocity, red.position, red.velocity}) {
    if (std::isfinite(number)) continue;
    throw SimulationError(
        fmt::format("{}: a time, position or velocity is beyond the range of a double (about "
                    "1.8e308)",
                    engine));
  }
}

}  // namespace piblocks
