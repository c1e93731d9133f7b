#include "render/logo.hpp"

#include "media/png/png_reader.hpp"

namespace piblocks {

std::shared_ptr<const Image> read_logo(const Scene& scene) {
  if (scene.show.logo.empty()) return nullptr;
  return std::make_shared<const Image>(read_png(scene.show.logo));
}

std::vector<std::string> logos_of(const Script& script) {
  std::vector<std::string> logos;
  const auto add = [&](const Scene& scene) {
    if (!scene.show.logo.empty()) logos.push_back(scene.show.logo);
  };
  if (const auto* const scene = std::get_if<Scene>(&script)) {
    add(*scene);
    return logos;
  }
  for (const Segment& segment : std::get<Storyboard>(script).segments) {
    if (const auto* const runs = std::get_if<Runs>(&segment.content)) {
      for (const Scene& run : *runs) add(run);
    }
  }
  return logos;
}

}  // namespace piblocks
