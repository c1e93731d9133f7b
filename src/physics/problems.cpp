#include "physics/problems.hpp"

#include <piblocks/error.hpp>

namespace piblocks {

void require_valid(const std::vector<Problem>& problems) {
  if (problems.empty()) return;
  std::vector<std::string> lines;
  lines.reserve(problems.size());
  for (const auto& [key, reason] : problems) lines.push_back(fmt::format("{} {}", key, reason));
  throw SceneError(std::move(lines));
}

}  // namespace piblocks
