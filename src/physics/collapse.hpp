// Bodies that lose all speed relative to each other in infinitely many collisions.
// In: a System, and the steps that a log has stored. Out: which bodies collapse with the last one.
// README.md, "Collapse", tells when.
#pragma once

#include <piblocks/log.hpp>

#include <cstdint>
#include <optional>
#include <vector>

#include "physics/stepper.hpp"

namespace piblocks {

/// Numbers of steps, ascending.
using StepNumbers = std::vector<std::uint32_t>;

inline double flight(const Time& from, const Time& to) {
  return (to.hi - from.hi) + (to.lo - from.lo);
}

/// The share of all time in which bodies that collapse have met very often.
inline constexpr double kCollapseWindow = 0x1p-48;

/// What cannot be stepped on.
struct EndOfSteps {
  std::vector<std::uint32_t> bodies;  ///< as Collapse::bodies
  bool is_collapse = true;            ///< false where doubles cannot tell whether it is one
};

/// The end that the last step is; nothing if the run goes on.
/// @param of_body   the numbers of each body's steps
/// @param window    the time in which its bodies have met very often
/// @param is_exact  whether the last step was in rational numbers
std::optional<EndOfSteps> end_of_steps(const System& system, const std::vector<StoredStep>& steps,
                                       const std::vector<StepNumbers>& of_body, double window,
                                       bool is_exact);

}  // namespace piblocks
