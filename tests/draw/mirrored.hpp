// Two blocks beside a wall by other names, and with the wall on the right.
// In: a scene with blue, red and a wall. Out: the same motion of bodies.
#pragma once

#include <piblocks/scene.hpp>

namespace piblocks {

/// Two blocks beside a wall, written as [[body]].
inline Scene as_bodies(Scene scene) {
  for (Body& body : scene.system.bodies) body.name.clear();
  return scene;
}

/// The same scene, mirrored left to right.
inline Scene mirrored(const Scene& scene) {
  Scene result = as_bodies(scene);
  System& system = result.system;
  for (Body& body : system.bodies) {
    body.position[0] *= -1;
    body.velocity[0] *= -1;
  }
  system.walls[0] = {"right", {-system.walls[0].point[0]}, {-1}};
  result.view.x = {-scene.view.x.high, -scene.view.x.low};
  return result;
}

}  // namespace piblocks
