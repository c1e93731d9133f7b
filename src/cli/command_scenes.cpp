#include <fmt/format.h>

#include <algorithm>

#include "cli/command.hpp"
#include "cli/text_output.hpp"
#include "scene/shipped_scenes.hpp"

namespace piblocks::cli {
namespace {

void list_scenes() {
  const auto length = [](const ShippedScene& scene) { return scene.name.size(); };
  const std::size_t width = std::ranges::max(shipped_scenes(), {}, length).name.size();
  TextOutput out;
  for (const ShippedScene& scene : shipped_scenes()) {
    out.format_line("{:<{}}  {}", scene.name, width, scene.summary());
  }
  out.finish();
}

}  // namespace

void define_scenes(Command& command) {
  command.add_optional_argument("SCENE", "Print the file of this scene, to be saved and edited");
  command.set_footer(
      "A name stands for a scene file in all commands, unless there is a file of this name.\n\n"
      "Examples:\n"
      "  piblocks render lecture -o lecture.mp4\n"
      "  piblocks scenes lecture > my-lecture.toml");
  command.on_run([command] {
    const auto name = command.text("SCENE");
    name ? print_text(find_shipped_scene(*name).text) : list_scenes();
  });
}

}  // namespace piblocks::cli
