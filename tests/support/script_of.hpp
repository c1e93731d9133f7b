// A scene or a storyboard from the text of its file.
#pragma once

#include <piblocks/script.hpp>

#include <string>

namespace piblocks::testing_support {

/// @throws SceneError
inline Script script_of(const std::string& text) {
  ScriptBuilder builder;
  builder.read_text("scene.toml", text);
  return builder.build();
}

}  // namespace piblocks::testing_support
