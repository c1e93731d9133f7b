#include "render/scene_text.hpp"

#include <fmt/format.h>

#include "draw/number_text.hpp"

namespace piblocks {
namespace {

std::string motion_of(const Block& block) {
  if (block.velocity == 0) return "rests";
  return block.velocity < 0 ? "slides towards the wall" : "slides away from the wall";
}

std::string collisions(const Integer& count) {
  return fmt::format("{} {}", with_thousands_separators(count),
                     count == 1 ? "collision" : "collisions");
}

std::string reached(const VideoCount& count) {
  const std::string number = with_thousands_separators(count.at_end);
  if (count.at_end < 0) {
    const Integer left = -count.at_end;
    return fmt::format("{}: {} {} to go until time 0", number, collisions(left),
                       left == 1 ? "is" : "are");
  }
  if (count.total == 0) return number + ": there are no collisions from time 0 on";
  if (count.at_end == count.total) return collisions(count.total) + ", which is all there are";
  return fmt::format("{} of {}", number, collisions(count.total));
}

}  // namespace

std::string title_of(const Scene& scene, const VideoCount& count) {
  if (!scene.show.title.empty()) return scene.show.title;
  return fmt::format("Masses {} and {}: {}", short_text(scene.system.blue.mass),
                     short_text(scene.system.red.mass), collisions(count.total));
}

std::string describe_video(const Scene& scene, const VideoCount& count) {
  const BlockSystem& system = scene.system;
  return fmt::format(
      "Two blocks slide along a line without friction: the inner one, beside a wall on the left, "
      "has mass {}, the outer one mass {}. At time 0 the inner one {} and the outer one {}. All "
      "collisions are elastic, and a counter reaches {}.",
      short_text(system.blue.mass), short_text(system.red.mass), motion_of(system.blue),
      motion_of(system.red), reached(count));
}

}  // namespace piblocks
