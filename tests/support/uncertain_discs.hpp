// A scene that tests in C++ and in Python share.
// In: uncertain_discs.toml. Out: its text.
#pragma once

#include <fstream>
#include <iterator>
#include <string>

namespace piblocks::testing_support {

/// Three discs whose order of collisions double precision knows for a while only, until time 200.
inline std::string uncertain_discs() {
  std::ifstream file;
  file.exceptions(std::ios::failbit | std::ios::badbit);
  file.open(PIBLOCKS_UNCERTAIN_DISCS);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace piblocks::testing_support
