// A scene that a program fills in by hand, instead of a ScriptBuilder, is checked before it is
// used. In: a scene. Out: nothing, or an exception.
#pragma once

#include <piblocks/error.hpp>
#include <piblocks/scene.hpp>

#include <vector>

namespace piblocks {

/// @throws SceneError if problems_of(scene) is not empty.
inline void require_valid(const Scene& scene) {
  const std::vector<Problem> problems = problems_of(scene);
  if (!problems.empty()) throw SceneError(describe(problems));
}

}  // namespace piblocks
