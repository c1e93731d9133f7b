#include "scene/scene_keys.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/instant.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <sstream>
#include <utility>

namespace piblocks {
namespace {

int parse_side(std::string_view text) {
  int side = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), side);
  if (error != std::errc{} || end != text.data() + text.size()) {
    throw UsageError("must be two whole numbers of pixels, as 1920x1080");
  }
  return side;
}

FrameSize parse_size(const Values& values) {
  Values sides = values;
  if (values.size() == 1) {
    const std::size_t cross = values.front().find('x');
    if (cross != std::string::npos) {
      sides = {values.front().substr(0, cross), values.front().substr(cross + 1)};
    }
  }
  if (sides.size() != 2) throw UsageError("must be two whole numbers of pixels, as 1920x1080");
  return {parse_side(sides[0]), parse_side(sides[1])};
}

/// A list, or one text with commas.
Values list_of(const Values& values) {
  if (values.size() != 1) return values;
  Values list;
  std::istringstream text(values.front());
  for (std::string value; std::getline(text >> std::ws, value, ',');) {
    value.erase(value.find_last_not_of(" \t") + 1);
    list.push_back(value);
  }
  return list;
}

/// Each of a list; messages name the one that is wrong.
template <typename Value>
std::vector<Value> parse_each(const Values& values, Value (*parse)(std::string_view text)) {
  std::vector<Value> parsed;
  for (const std::string& value : values) {
    try {
      parsed.push_back(parse(value));
    } catch (const UsageError& error) {
      throw UsageError(fmt::format("'{}' {}", value, error.what()));
    }
  }
  return parsed;
}

// read() sets a value from its texts, texts_of() gives them back.

void read(Rational& target, const Values& values) { target = parse_rational(single(values)); }
void read(Instant& target, const Values& values) { target = parse_instant(single(values)); }
void read(Theme& target, const Values& values) { target = parse_theme(single(values)); }
void read(std::string& target, const Values& values) { target = single(values); }
void read(Values& target, const Values& values) { target = list_of(values); }
void read(std::optional<FrameSize>& target, const Values& values) { target = parse_size(values); }
void read(std::vector<Freeze>& target, const Values& values) {
  target = parse_each(list_of(values), parse_freeze);
}
void read(std::vector<Overlay>& target, const Values& values) {
  target = parse_each(list_of(values), parse_overlay);
}
void read(std::vector<Panel>& target, const Values& values) {
  target = parse_each(list_of(values), parse_panel);
}
void read(Range& target, const Values& values) {
  if (values.size() != 2) throw UsageError("must be two numbers, as [-1, 12]");
  target = {parse_rational(values[0]), parse_rational(values[1])};
}
void read(bool& target, const Values& values) {
  const std::string& text = single(values);
  if (text != "true" && text != "false") throw UsageError("must be true or false");
  target = text == "true";
}
void read(Background& target, const Values& values) {
  const std::string& name = single(values);
  if (name != "opaque" && name != "transparent") throw UsageError("must be opaque or transparent");
  target = name == "opaque" ? Background::opaque : Background::transparent;
}

Values texts_of(const Rational& value) { return {value.get_str()}; }
Values texts_of(const Instant& value) { return {exact_text(value)}; }
Values texts_of(Theme value) { return {exact_text(value)}; }
Values texts_of(const std::string& value) { return {value}; }
Values texts_of(const Values& value) { return value; }
Values texts_of(const Range& value) { return {value.low.get_str(), value.high.get_str()}; }
Values texts_of(bool value) { return {value ? "true" : "false"}; }
Values texts_of(Background value) {
  return {value == Background::opaque ? "opaque" : "transparent"};
}
Values texts_of(const FrameSize& value) {
  return {fmt::format("{}x{}", value.width_px, value.height_px)};
}
template <typename Value>
Values texts_of(const std::optional<Value>& value) {
  return value ? texts_of(*value) : Values();
}
template <typename Value>
Values texts_of(const std::vector<Value>& list) {
  Values texts;
  for (const Value& value : list) texts.push_back(exact_text(value));
  return texts;
}

/// A key for one member of a scene. @param member  returns a reference to it.
template <typename Member>
constexpr SceneKey key_of(const char* name, Member /*member*/) {
  return {name, [](Scene& scene, const Values& values) { read(Member{}(scene), values); },
          [](const Scene& scene) { return texts_of(Member{}(scene)); }};
}

void set_size(Scene& scene, const Values& values) {
  const FrameSize size = parse_size(values);
  scene.view.width_px = size.width_px;
  scene.view.height_px = size.height_px;
}
Values size_of(const Scene& scene) {
  return texts_of(FrameSize{scene.view.width_px, scene.view.height_px});
}

/// Replaces a duration that was set before.
void set_speed(Scene& scene, const Values& values) {
  read(scene.time.speed, values);
  scene.pacing.duration_s.reset();
}
Values speed_of(const Scene& scene) { return texts_of(scene.time.speed); }

/// Replaces a speed that was set before.
void set_duration(Scene& scene, const Values& values) {
  scene.pacing.duration_s = parse_rational(single(values));
  scene.time.speed = 1;
}
Values duration_of(const Scene& scene) { return texts_of(scene.pacing.duration_s); }

void set_slow_motion(Scene& scene, const Values& values) {
  Values windows = list_of(values);
  scene.pacing.automatic_slow_motion = std::erase(windows, "auto") > 0;
  scene.pacing.slow_motion = parse_each(windows, parse_slow_motion);
}
Values slow_motion_of(const Scene& scene) {
  Values texts = texts_of(scene.pacing.slow_motion);
  if (scene.pacing.automatic_slow_motion) texts.insert(texts.begin(), "auto");
  return texts;
}

constexpr auto kKeys = std::to_array<SceneKey>({
    key_of(
        "wall.face", [](auto& s) -> auto& { return s.system.wall_face; }),
    key_of(
        "blue.mass", [](auto& s) -> auto& { return s.system.blue.mass; }),
    key_of(
        "blue.position", [](auto& s) -> auto& { return s.system.blue.position; }),
    key_of(
        "blue.velocity", [](auto& s) -> auto& { return s.system.blue.velocity; }),
    key_of(
        "blue.width", [](auto& s) -> auto& { return s.system.blue.width; }),
    key_of(
        "red.mass", [](auto& s) -> auto& { return s.system.red.mass; }),
    key_of(
        "red.position", [](auto& s) -> auto& { return s.system.red.position; }),
    key_of(
        "red.velocity", [](auto& s) -> auto& { return s.system.red.velocity; }),
    key_of(
        "red.width", [](auto& s) -> auto& { return s.system.red.width; }),
    key_of(
        "view.x", [](auto& s) -> auto& { return s.view.x; }),
    key_of(
        "view.y", [](auto& s) -> auto& { return s.view.y; }),
    SceneKey{"view.size", set_size, size_of},
    key_of(
        "view.fps", [](auto& s) -> auto& { return s.view.frame_rate; }),
    key_of(
        "view.shutter", [](auto& s) -> auto& { return s.view.shutter; }),
    key_of(
        "view.background", [](auto& s) -> auto& { return s.view.background; }),
    key_of(
        "view.theme", [](auto& s) -> auto& { return s.view.theme; }),
    key_of(
        "time.from", [](auto& s) -> auto& { return s.time.from; }),
    key_of(
        "time.to", [](auto& s) -> auto& { return s.time.to; }),
    SceneKey{"time.speed", set_speed, speed_of},
    SceneKey{"time.duration", set_duration, duration_of},
    SceneKey{"time.slow-motion", set_slow_motion, slow_motion_of},
    key_of(
        "time.freeze", [](auto& s) -> auto& { return s.pacing.freezes; }),
    key_of(
        "time.hold-start", [](auto& s) -> auto& { return s.pacing.hold_start_s; }),
    key_of(
        "time.hold-end", [](auto& s) -> auto& { return s.pacing.hold_end_s; }),
    key_of(
        "time.loop", [](auto& s) -> auto& { return s.pacing.loop; }),
    key_of(
        "sound.on", [](auto& s) -> auto& { return s.sound.on; }),
    key_of(
        "show.overlays", [](auto& s) -> auto& { return s.show.overlays; }),
    key_of(
        "show.panels", [](auto& s) -> auto& { return s.show.panels; }),
    key_of(
        "show.title", [](auto& s) -> auto& { return s.show.title; }),
    key_of(
        "show.caption", [](auto& s) -> auto& { return s.show.caption; }),
    key_of(
        "show.logo", [](auto& s) -> auto& { return s.show.logo; }),
    key_of(
        "golden.frames", [](auto& s) -> auto& { return s.golden.frames; }),
    key_of(
        "golden.size", [](auto& s) -> auto& { return s.golden.size; }),
});

}  // namespace

std::span<const SceneKey> scene_keys() { return kKeys; }

bool is_film_key(std::string_view key) {
  constexpr std::array<std::string_view, 5> kOfFilm = {"view.size", "view.fps", "view.background",
                                                       "view.theme", "sound.on"};
  return key.starts_with("golden.") || std::ranges::count(kOfFilm, key) > 0;
}

const std::string& single(const Values& values) {
  if (values.size() != 1) throw UsageError("must be one value");
  return values.front();
}

std::string joined(const Values& values) {
  return values.size() == 1 ? values.front() : fmt::format("[{}]", fmt::join(values, ", "));
}

std::vector<std::pair<std::string, std::string>> describe(const Scene& scene) {
  std::vector<std::pair<std::string, std::string>> values;
  for (const SceneKey& key : scene_keys()) {
    values.emplace_back(key.name, fmt::format("{}", fmt::join(key.get(scene), ", ")));
  }
  return values;
}

}  // namespace piblocks
