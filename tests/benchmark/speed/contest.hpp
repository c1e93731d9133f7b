// Commands measured in turn, so that what else the machine does slows no one of them alone.
// In: contenders, the first of which the others are compared with. Out: one row for each.
#pragma once

#include <functional>
#include <vector>

#include "speed/process.hpp"
#include "speed/report.hpp"
#include "speed/workbench.hpp"

namespace piblocks::benchmark {

struct Contender {
  Subject subject;
  Command command;
  /// Looks at what the command has written.
  std::function<Quality()> judge = {};
};

/// A warm-up of all, then `rounds` rounds over all. Who fails in the warm-up is left out, with a
/// note, unless it is the first.
void hold_contest(const Workbench& bench, const std::vector<Contender>& contenders, int rounds);

}  // namespace piblocks::benchmark
