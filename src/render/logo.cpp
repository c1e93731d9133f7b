#include "render/logo.hpp"

#include "media/frame_reader.hpp"

namespace piblocks {

std::shared_ptr<const Image> read_logo(const Scene& scene) {
  if (scene.show.logo.empty()) return nullptr;
  return std::make_shared<const Image>(read_png(scene.show.logo));
}

}  // namespace piblocks
