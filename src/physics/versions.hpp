// Which libraries of numbers the program was linked with.
#pragma once

#include <string>
#include <vector>

namespace piblocks {

/// Name and version of each library of numbers that is linked, such as "MPFR 4.2.0".
std::vector<std::string> physics_library_versions();

}  // namespace piblocks
