#include "scene/shipped_scenes.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "core/nearest_name.hpp"
#include "scene/shipped_scene_texts.hpp"

namespace piblocks {
namespace {

const ShippedScene* shipped_scene(std::string_view name) {
  const auto found = std::ranges::find(shipped_scenes(), name, &ShippedScene::name);
  return found == shipped_scenes().end() ? nullptr : &*found;
}

/// A pipe is a file too.
bool is_file(const std::string& path) {
  std::error_code none;
  const std::filesystem::file_status status = std::filesystem::status(path, none);
  return exists(status) && !is_directory(status);
}

/// "; did you mean 'lecture'? 'piblocks scenes' lists them"
std::string other_names(const std::string& name) {
  const std::string near = did_you_mean(name, shipped_scene_names());
  return fmt::format("{} 'piblocks scenes' lists them", near.empty() ? ";" : near);
}

}  // namespace

std::string_view ShippedScene::summary() const {
  const std::string_view line = text.substr(0, text.find('\n'));
  return line.substr(std::min(line.find_first_not_of("# "), line.size()));
}

std::span<const ShippedScene> shipped_scenes() { return kShippedScenes; }

std::vector<std::string> shipped_scene_names() {
  std::vector<std::string> names;
  for (const ShippedScene& scene : shipped_scenes()) names.emplace_back(scene.name);
  return names;
}

const ShippedScene& find_shipped_scene(const std::string& name) {
  if (const ShippedScene* const scene = shipped_scene(name)) return *scene;
  throw UsageError(fmt::format("scenes: there is no scene '{}'{}", name, other_names(name)));
}

void read_scene(ScriptBuilder& builder, const std::string& scene) {
  const bool is_name = scene.find_first_of("./") == std::string::npos;
  if (!is_name || is_file(scene)) return builder.read_file(scene);
  if (const ShippedScene* const shipped = shipped_scene(scene)) {
    return builder.read_text(fmt::format("{} (shipped)", scene), shipped->text);
  }
  if (scene == "-") {
    throw SceneError("scene: cannot read '-': a file or a name is needed here, not standard input");
  }
  throw SceneError(
      fmt::format("scene: cannot read '{}': there is no such file, and no shipped scene has this "
                  "name{}",
                  scene, other_names(scene)));
}

void claim_scene(OverwriteCheck& check, const std::string& scene) {
  if (shipped_scene(scene) == nullptr || is_file(scene)) check.reads("the scene file", scene);
}

}  // namespace piblocks
