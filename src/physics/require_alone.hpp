// Collisions that happen together have no instant between them.
// In: a collision, and the last one of those at the same time. Out: nothing, or an exception.
#pragma once

#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/exact.hpp>

namespace piblocks {

/// @throws UsageError unless the two are the same.
inline void require_alone(const Integer& index, const Integer& last) {
  if (index == last) return;
  throw UsageError(
      fmt::format("collision #{}: happens at the same time as all up to #{}; name the last of them",
                  index.get_str(), last.get_str()));
}

}  // namespace piblocks
