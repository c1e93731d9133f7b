// Several collisions taken together, one by one.
// In: collisions with their impulses. Out: the Impact that stands for all of them.
#pragma once

#include <piblocks/run.hpp>

#include <optional>

#include "core/two_sum.hpp"

namespace piblocks {

class ImpactSum {
 public:
  explicit ImpactSum(CollisionKind kind) { sum_.kind = kind; }

  void add(const Time& time, double impulse, double blue_position) {
    if (sum_.impulse == 0) {
      sum_.time = time;
      sum_.blue_position = blue_position;
      is_empty_ = false;
    }
    // Away from the first: a double-double would be lost in a product.
    sum_.impulse += impulse;
    const double share = sum_.impulse > 0 ? impulse / sum_.impulse : 0;
    delay_ += share * ((time.hi - sum_.time.hi) + (time.lo - sum_.time.lo) - delay_);
    position_ += share * (blue_position - sum_.blue_position - position_);
  }

  std::optional<Impact> result() const {
    if (is_empty_) return std::nullopt;
    Impact result = sum_;
    const Time time = two_sum(sum_.time.hi, delay_);
    result.time = two_sum(time.hi, time.lo + sum_.time.lo);
    result.blue_position += position_;
    return result;
  }

 private:
  Impact sum_;  // but for time and position, which are the first one's
  double delay_ = 0;
  double position_ = 0;
  bool is_empty_ = true;
};

}  // namespace piblocks
