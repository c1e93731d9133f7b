// The methods that are compared.
// In: nothing. Out: one Method for each curve point: method, number type, step or tolerance.
#pragma once

#include <vector>

#include "accuracy/method.hpp"

namespace piblocks::benchmark {

/// All methods, in the order of the results.
std::vector<MethodPtr> all_methods();

MethodPtr product();
/// The tests' oracle; too slow for whole logs.
MethodPtr multiprecision();
/// CVODE's Adams method with root finding, where the benchmark was built with SUNDIALS.
std::vector<MethodPtr> cvode_methods();

}  // namespace piblocks::benchmark
