#include "web/settings.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <cstddef>
#include <span>

#include "core/text.hpp"
#include "scene/body_keys.hpp"
#include "scene/scene_keys.hpp"

namespace piblocks::web {
namespace {

/// Whether the key, or the body that it is a property of, has its default from this line on.
bool resets(const Setting& setting, const std::string& key) {
  if (setting.texts) return false;
  return set_same_value(setting.key, key) || key.starts_with(setting.key + '.');
}

/// The key of a setting, of which later ones may have reset a half.
std::string key_left(const Setting& setting, std::span<const Setting> later) {
  if (setting.key != "restitution") return setting.key;
  const auto is_reset = [&](std::string_view key) {
    return std::ranges::any_of(later,
                               [&](const Setting& one) { return !one.texts && one.key == key; });
  };
  if (is_reset("blocks.restitution")) return "wall.restitution";
  return is_reset("wall.restitution") ? "blocks.restitution" : setting.key;
}

bool is_left_out(const std::vector<LeftOut>& left_out, const std::string& key) {
  return std::ranges::any_of(left_out, [&](const LeftOut& out) {
    return out.part == 0 && out.item.empty() && out.key == key;
  });
}

std::unique_ptr<ScriptBuilder> read(std::string_view text, const std::vector<Setting>& settings,
                                    const std::vector<LeftOut>& left_out) {
  if (text.size() > kMaxSceneFile_bytes) {
    throw SceneError(fmt::format("scene: longer than {} bytes, the most that a scene file may have",
                                 kMaxSceneFile_bytes));
  }
  auto builder = std::make_unique<ScriptBuilder>();
  for (const Setting& setting : settings) {
    if (!setting.texts) builder->leave_out(setting.key);
  }
  for (const LeftOut& out : left_out) {
    if (out.part > 0) {
      builder->leave_out_of_part(out.part, out.key, out.item);
    } else if (out.item.empty()) {
      builder->leave_out(out.key);
    } else {
      builder->leave_out(out.key, out.item);
    }
  }
  builder->read_text("scene", text);
  for (auto setting = settings.begin(); setting != settings.end(); ++setting) {
    const std::string key = key_left(*setting, {setting, settings.end()});
    const auto is_reset = [&](const Setting& later) { return resets(later, key); };
    if (!setting->texts || is_left_out(left_out, key)) continue;
    if (std::any_of(setting, settings.end(), is_reset)) continue;
    builder->set(setting->key, key, *setting->texts);
  }
  return builder;
}

/// The text of blue, red and a wall of finite mass as bodies; nothing if the scene is another one.
std::optional<std::string> text_with_wall(std::string_view text,
                                          const std::vector<Setting>& settings,
                                          const std::vector<LeftOut>& left_out) {
  try {
    const Scene scene = read(text, settings, left_out)->build_scene();
    const bool has_names = scene.system.bodies.front().name == "blue";
    if (!has_names || has_short_names(scene.system)) return std::nullopt;
    return scene_toml(scene);
  } catch (const SceneError&) {
    return std::nullopt;  // it may be right with other bodies
  }
}

}  // namespace

std::vector<Setting> settings_of(std::string_view lines) {
  std::vector<Setting> settings;
  if (lines.size() > kMaxSceneFile_bytes) throw UsageError("page: too many settings");
  for (const std::string& line : split(lines, '\n')) {
    if (line.empty()) continue;
    const std::size_t equals = line.find('=');
    Setting& setting = settings.emplace_back(Setting{line.substr(0, equals), {}});
    if (equals == std::string::npos) continue;
    setting.texts = split(std::string_view(line).substr(equals + 1), '\t');
  }
  return settings;
}

std::unique_ptr<ScriptBuilder> builder_of(std::string_view text,
                                          const std::vector<Setting>& settings,
                                          const std::vector<LeftOut>& left_out) {
  std::vector<Setting> of_bodies;
  std::vector<Setting> others;
  for (const Setting& setting : settings) {
    (number_in(setting.key, "body ") > 0 ? of_bodies : others).push_back(setting);
  }
  if (!of_bodies.empty()) {
    if (const auto with_bodies = text_with_wall(text, others, left_out)) {
      return read(*with_bodies, of_bodies, left_out);
    }
  }
  return read(text, settings, left_out);
}

}  // namespace piblocks::web
