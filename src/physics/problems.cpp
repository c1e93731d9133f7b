#include "physics/problems.hpp"

#include <piblocks/error.hpp>

namespace piblocks {

void require_valid(const std::vector<Problem>& problems) {
  if (!problems.empty()) throw SceneError(problems);
}

}  // namespace piblocks
