// Which number libraries the physics computes with.
// In: nothing. Out: names and versions, for reports of problems.
#pragma once

#include <string>
#include <vector>

namespace piblocks {

/// Name and version of each number library that is linked, such as "MPFR 4.2.0".
std::vector<std::string> physics_library_versions();

}  // namespace piblocks
