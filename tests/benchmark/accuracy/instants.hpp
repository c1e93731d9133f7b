// The times at which the methods are asked for blue's position.
// In: nothing. Out: the same ascending times in every run, in both forms that methods take.
#pragma once

#include <piblocks/exact.hpp>

#include <algorithm>
#include <vector>

#include "support/property.hpp"

namespace piblocks::benchmark {

inline constexpr double kLastInstant_s = 15;
inline constexpr int kInstants = 600;

/// The same numbers twice: a method takes those that it would be given in use. The program gets its
/// times as fractions (frame n is at n/60), a formula or a loop gets doubles.
struct Instants {
  std::vector<double> seconds;
  std::vector<Rational> exact;
};

inline Instants random_instants() {
  Random random(1618034);
  Instants instants;
  for (int i = 0; i < kInstants; ++i) instants.seconds.push_back(random.uniform(0, kLastInstant_s));
  std::ranges::sort(instants.seconds);
  instants.exact = {instants.seconds.begin(), instants.seconds.end()};
  return instants;
}

}  // namespace piblocks::benchmark
