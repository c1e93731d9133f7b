// The right answers, to a hundred digits.
// In: a number of digits of pi. Out: the article's system, and events and positions of it.
#pragma once

#include <piblocks/two_blocks.hpp>

#include <vector>

#include "accuracy/method.hpp"

namespace piblocks::benchmark {

struct ReferenceRun {
  int digits = 1;
  TwoBlocks system;
  std::int64_t count = 0;
  std::vector<std::int64_t> indices;  ///< of `events`, ascending
  std::vector<LoggedEvent> events;
  Instants instants;
  std::vector<Reference> blue;  ///< at the instants

  bool has_every_event() const { return std::ssize(events) == count; }
};

/// Events come from the closed form in a hundred digits: every one up to five digits of pi,
/// beyond it some 39,000. Some of them, and all positions at instants, are from the oracle.
/// @throws SimulationError if the closed form and the oracle disagree.
ReferenceRun reference_run(int digits);

}  // namespace piblocks::benchmark
