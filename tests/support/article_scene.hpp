// The article's scene and picture for a number of digits, in frames of any size.
#pragma once

#include <piblocks/scene.hpp>

namespace piblocks::testing_support {

inline Scene article_scene(int digits, int width_px = 1920, int height_px = 1080) {
  Scene scene;
  scene.system = article_system(digits);
  scene.view.width_px = width_px;
  scene.view.height_px = height_px;
  scene.view.theme = Theme::article;
  return scene;
}

}  // namespace piblocks::testing_support
