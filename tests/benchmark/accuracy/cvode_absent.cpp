#include <fmt/format.h>

#include <cstdio>

#include "accuracy/methods.hpp"

namespace piblocks::benchmark {

std::vector<MethodPtr> cvode_methods() {
  fmt::print(stderr, "accuracy_benchmark: built without SUNDIALS; CVODE is left out\n");
  return {};
}

}  // namespace piblocks::benchmark
