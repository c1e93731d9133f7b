// States as text.
// In: a state and its time. Out: a JSON object in one line; numbers read back as the same doubles.
#pragma once

#include <piblocks/bodies.hpp>
#include <piblocks/error.hpp>
#include <piblocks/exact.hpp>
#include <piblocks/run.hpp>

#include <array>
#include <cmath>
#include <optional>
#include <string>

namespace piblocks::cli {

/// A number as it is printed: -0 becomes 0.
/// @throws SimulationError if it is not finite: JSON has no infinity.
inline double shown(double value) {
  if (!std::isfinite(value)) {
    throw SimulationError("output: a number is beyond the range of a double (about 1.8e308)");
  }
  return value == 0 ? 0 : value;
}

/// A number, or two in brackets.
std::string vector_text(const BodySystem& system, const std::array<double, 2>& vector);

/// {"time":…,"collisions":"…","blue":{"position":…,"velocity":…},"red":{…}}
/// @param infinite  the count that stands for infinitely many, if one does
/// @param bounds    adds "position_bound" behind each position
std::string state_text(const Rational& time, const BlockState& state,
                       const std::optional<Integer>& infinite,
                       const std::optional<PositionBounds>& bounds = std::nullopt);

/// {"time":…,"collisions":"…","bodies":[{"position":…,"velocity":…},…]}
std::string state_text(const BodySystem& system, const Rational& time, const BodiesState& state);

}  // namespace piblocks::cli
