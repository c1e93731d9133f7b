// A rule for every exact value that is drawn or computed with as a double.
// In: a value and its key. Out: a problem if a double cannot hold it.
#pragma once

#include <piblocks/exact.hpp>
#include <piblocks/run.hpp>

#include <vector>

namespace piblocks {

void check_finite(const char* key, const Rational& value, std::vector<Problem>& problems);

}  // namespace piblocks
