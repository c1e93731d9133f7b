// Every key of a scene: how its value is read, and how it is written.
// In: a key and the texts of its value. Out: that value in the scene, or its texts again.
#pragma once

#include <piblocks/scene.hpp>

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace piblocks {

/// One text, or the texts of a list.
using Values = std::vector<std::string>;

struct SceneKey {
  const char* name;
  void (*set)(Scene& scene, const Values& values);  ///< @throws UsageError
  Values (*get)(const Scene& scene);                ///< exact: read back, they give the same value
};

std::span<const SceneKey> scene_keys();

/// Whether the key is for a whole film and not for a segment of a storyboard.
bool is_film_key(std::string_view key);

/// The value of a key that takes one. @throws UsageError if there are more.
const std::string& single(const Values& values);

/// The values as one text for a message.
std::string joined(const Values& values);

}  // namespace piblocks
