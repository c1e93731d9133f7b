// Whether what the engine for discs calls certain is true.
// In: a System. Out: how much was certain, and everything that was wrong with it.
#pragma once

#include <piblocks/system.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace piblocks {

struct CertaintyCheck {
  std::size_t certain = 0;   ///< collisions before Stepper::certain_until()
  bool is_complete = false;  ///< all collisions are certain, and there are no more
  double widest = 0;         ///< the largest share of a bound that an error takes up
  std::vector<std::string> wrong = {};
};

/// Steps until something is not certain, or the limit, and compares with PreciseDiscs.
CertaintyCheck check_certainty(const System& system, std::size_t limit = 2000);

}  // namespace piblocks
