// A curve that rises smoothly.
// In: a share of the way. Out: the share of the rise.
#pragma once

namespace piblocks {

/// From 0 to 1, level at both ends. @param share  0 … 1
template <typename Number>
Number smooth_step(const Number& share) {
  return share * share * (3 - 2 * share);
}

}  // namespace piblocks
