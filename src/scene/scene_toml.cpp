#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <functional>
#include <string_view>

#include "scene/body_keys.hpp"
#include "scene/scene_keys.hpp"

namespace piblocks {
namespace {

using KeyFilter = std::function<bool(std::string_view key)>;

/// A basic string of TOML. Bytes that are no UTF-8 stay, and are refused when the text is read.
std::string toml_string(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    const bool is_control = (c >= 0 && c < ' ') || c == '\x7f';
    if (c == '"' || c == '\\') {
      result += fmt::format("\\{}", c);
    } else if (is_control) {
      result += fmt::format("\\u{:04X}", static_cast<unsigned char>(c));
    } else {
      result += c;
    }
  }
  return result + '"';
}

/// Small whole numbers and bools are read as their texts, with or without quotes.
bool is_plain(std::string_view text) {
  constexpr std::size_t kSmall = 18;
  if (text == "true" || text == "false" || text == "0") return true;
  const std::string_view digits = text.starts_with('-') ? text.substr(1) : text;
  return !digits.empty() && digits.size() <= kSmall && digits.front() != '0' &&
         digits.find_first_not_of("0123456789") == std::string_view::npos;
}

std::string scalar(std::string_view text) {
  return is_plain(text) ? std::string(text) : toml_string(text);
}

std::string value_of(const Values& values) {
  if (values.size() == 1) return scalar(values.front());
  std::string list;
  for (const std::string& value : values) list += (list.empty() ? "" : ", ") + scalar(value);
  return '[' + list + ']';
}

Values values_of(const SceneKey& key, const Scene& scene) {
  Values values = key.get(scene);
  const bool is_path = std::string_view(key.name) == "show.logo" && !scene.show.logo.empty();
  if (is_path) values = {std::filesystem::absolute(scene.show.logo).string()};
  return values;
}

std::string vector_of(const ExactVector& vector, int dimensions) {
  return value_of(coordinates_of(vector, dimensions));
}

std::string body_text(const Scene& scene, std::size_t number) {
  const int dimensions = scene.system.dimensions;
  const Body& body = scene.system.bodies[number];
  const BodyStyle& style = scene.styles[number];
  std::string text =
      fmt::format("{{ mass = {}, position = {}, velocity = {}, {} = {}",
                  scalar(body.mass ? body.mass->get_str() : "inf"),
                  vector_of(body.position, dimensions), vector_of(body.velocity, dimensions),
                  dimensions == 1 ? "width" : "radius", scalar(body.size.get_str()));
  if (style.color) text += ", color = " + toml_string(color_text(style));
  if (!style.label.empty()) text += ", label = " + toml_string(style.label);
  if (style.path) text += ", path = true";
  if (body.restitution) text += ", restitution = " + scalar(body.restitution->get_str());
  return text + " }";
}

std::string wall_text(const Wall& wall) {
  std::string text = fmt::format("{{ point = {}, normal = {}", vector_of(wall.point, 2),
                                 vector_of(wall.normal, 2));
  if (is_moving(wall)) text += ", velocity = " + vector_of(wall.velocity, 2);
  if (wall.restitution) text += ", restitution = " + scalar(wall.restitution->get_str());
  return text + " }";
}

/// The bodies, the sides of their box, and the walls that are not of it.
void add_bodies(const Scene& scene, std::vector<std::string>& entries) {
  std::array<Values, 2> box = {Values{"-inf", "inf"}, Values{"-inf", "inf"}};
  std::array<Values, 2> velocities = {Values{"0", "0"}, Values{"0", "0"}};
  std::vector<std::string> slanted;
  for (const Wall& wall : scene.system.walls) {
    const bool is_of_x = wall.name == "left" || wall.name == "right";
    if (is_of_x || wall.name == "lower" || wall.name == "upper") {
      const std::size_t axis = is_of_x ? 0 : 1;
      const std::size_t end = wall.name == "left" || wall.name == "lower" ? 0 : 1;
      box.at(axis).at(end) = wall.point.at(axis).get_str();
      velocities.at(axis).at(end) = wall.velocity.at(axis).get_str();
    } else {
      slanted.push_back(wall_text(wall));
    }
  }
  for (const std::size_t axis : {0U, 1U}) {
    if (box.at(axis) == Values{"-inf", "inf"}) continue;
    const char name = axis == 0 ? 'x' : 'y';
    entries.push_back(fmt::format("box.{} = {}", name, value_of(box.at(axis))));
    if (velocities.at(axis) == Values{"0", "0"}) continue;
    entries.push_back(fmt::format("box.{}-velocity = {}", name, value_of(velocities.at(axis))));
  }
  if (!slanted.empty()) entries.push_back(fmt::format("wall = [{}]", fmt::join(slanted, ", ")));
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < scene.system.bodies.size(); ++i) {
    texts.push_back(body_text(scene, i));
  }
  entries.push_back(fmt::format("body = [{}]", fmt::join(texts, ", ")));
}

/// A list of scene keys that differ from the default, one "key = value" each.
std::vector<std::string> entries_of(const Scene& scene, const KeyFilter& is_wanted) {
  Scene usual;
  const bool has_bodies = !has_short_names(scene.system);
  if (has_bodies) show_all(scene.system, scene.time, usual.view);
  // The lecture themes have another default.
  const bool has_other_shutter = is_lecture(scene.view.theme);
  std::vector<std::string> entries;
  for (const SceneKey& key : scene_keys()) {
    const std::string_view name = key.name;
    if (!is_wanted(name)) continue;
    if (has_bodies && is_short_key(name)) continue;
    const bool is_usual = key.get(scene) == key.get(usual);
    if (is_usual && !(has_other_shutter && name == "view.shutter")) continue;
    if (name == "time.speed" && scene.pacing.duration_s) continue;
    entries.push_back(fmt::format("{} = {}", name, value_of(values_of(key, scene))));
  }
  if (has_bodies && is_wanted("body")) add_bodies(scene, entries);
  return entries;
}

/// What the film sets wins, so that "view.size" and the like are not repeated in its parts.
bool is_of_segment(std::string_view key) { return !is_film_key(key); }

std::string compared(const Scenes& scenes) {
  const auto is_of_run = [](std::string_view key) {
    return is_of_segment(key) && !key.starts_with("time.");
  };
  std::string tables;
  for (const Scene& scene : scenes) {
    tables += fmt::format("  {{ {} }},\n", fmt::join(entries_of(scene, is_of_run), ", "));
  }
  return fmt::format("compare = [\n{}]\n", tables);
}

std::string scenes_text(const Segment& segment, const Scenes& scenes) {
  if (scenes.size() == 1) {
    return fmt::format("{}\n", fmt::join(entries_of(scenes.front(), is_of_segment), "\n"));
  }
  const auto is_of_clock = [](std::string_view key) { return key.starts_with("time."); };
  return fmt::format("split = {}\n{}\n{}", toml_string(exact_text(segment.split)),
                     fmt::join(entries_of(scenes.front(), is_of_clock), "\n"), compared(scenes));
}

std::string part_of(const Segment& segment) {
  std::string text = "\n[[part]]\n";
  if (segment.fade_s != 0) text += fmt::format("fade = {}\n", scalar(segment.fade_s.get_str()));
  if (const auto* card = std::get_if<Card>(&segment.content)) {
    text += fmt::format("card = {}\n", value_of(card->lines));
    if (!card->becomes.empty()) text += fmt::format("becomes = {}\n", value_of(card->becomes));
    return text + fmt::format("seconds = {}\n", scalar(card->length_s.get_str()));
  }
  return text + scenes_text(segment, std::get<Scenes>(segment.content));
}

}  // namespace

std::string scene_toml(const Script& script) {
  if (const auto* scene = std::get_if<Scene>(&script)) {
    const auto any = [](std::string_view) { return true; };
    return fmt::format("{}\n", fmt::join(entries_of(*scene, any), "\n"));
  }
  const auto& story = std::get<Storyboard>(script);
  Scene film;
  film.view = story.view;
  film.sound = story.sound;
  film.golden = story.golden;
  // Of the view, parts have their own range and shutter.
  std::string text = fmt::format("{}\n", fmt::join(entries_of(film, is_film_key), "\n"));
  for (const Segment& segment : story.segments) text += part_of(segment);
  return text;
}

}  // namespace piblocks
