#include "scene/scene_keys.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/instant.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <sstream>
#include <utility>

namespace piblocks {
namespace {

void set_number(Rational& target, const Values& values) { target = parse_rational(single(values)); }

void set_range(Range& target, const Values& values) {
  if (values.size() != 2) throw UsageError("must be two numbers, as [-1, 12]");
  target = {parse_rational(values[0]), parse_rational(values[1])};
}

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

void set_size(View& view, const Values& values) {
  const FrameSize size = parse_size(values);
  view.width_px = size.width_px;
  view.height_px = size.height_px;
}

void set_background(View& view, const Values& values) {
  const std::string& name = single(values);
  if (name != "opaque" && name != "transparent") throw UsageError("must be opaque or transparent");
  view.background = name == "opaque" ? Background::opaque : Background::transparent;
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

bool parse_bool(const Values& values) {
  const std::string& text = single(values);
  if (text == "true") return true;
  if (text == "false") return false;
  throw UsageError("must be true or false");
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

/// In the place of a duration that was asked for before.
void set_speed(Scene& scene, const Values& values) {
  set_number(scene.time.speed, values);
  scene.pacing.duration_s.reset();
}

/// In the place of a speed that was asked for before.
void set_duration(Scene& scene, const Values& values) {
  scene.pacing.duration_s = parse_rational(single(values));
  scene.time.speed = 1;
}

void set_slow_motion(Pacing& pacing, Values values) {
  values = list_of(values);
  pacing.automatic_slow_motion = std::erase(values, "auto") > 0;
  pacing.slow_motion = parse_each(values, parse_slow_motion);
}

Values number(const Rational& value) { return {value.get_str()}; }
Values range(const Range& value) { return {value.low.get_str(), value.high.get_str()}; }
Values size(const View& view) { return {fmt::format("{}x{}", view.width_px, view.height_px)}; }
Values size(const FrameSize& value) {
  return {fmt::format("{}x{}", value.width_px, value.height_px)};
}
Values background(Background value) {
  return {value == Background::opaque ? "opaque" : "transparent"};
}
Values flag(bool value) { return {value ? "true" : "false"}; }

template <typename Value>
Values each(const std::vector<Value>& list) {
  Values texts;
  for (const Value& value : list) texts.push_back(exact_text(value));
  return texts;
}

Values instant(const Instant& value) { return {exact_text(value)}; }

Values slow_motion(const Pacing& pacing) {
  Values texts = each(pacing.slow_motion);
  if (pacing.automatic_slow_motion) texts.insert(texts.begin(), "auto");
  return texts;
}

constexpr auto kKeys = std::to_array<SceneKey>({
    {"wall.face", [](Scene& s, const Values& v) { set_number(s.system.wall_face, v); },
     [](const Scene& s) { return number(s.system.wall_face); }},
    {"blue.mass", [](Scene& s, const Values& v) { set_number(s.system.blue.mass, v); },
     [](const Scene& s) { return number(s.system.blue.mass); }},
    {"blue.position", [](Scene& s, const Values& v) { set_number(s.system.blue.position, v); },
     [](const Scene& s) { return number(s.system.blue.position); }},
    {"blue.velocity", [](Scene& s, const Values& v) { set_number(s.system.blue.velocity, v); },
     [](const Scene& s) { return number(s.system.blue.velocity); }},
    {"blue.width", [](Scene& s, const Values& v) { set_number(s.system.blue.width, v); },
     [](const Scene& s) { return number(s.system.blue.width); }},
    {"red.mass", [](Scene& s, const Values& v) { set_number(s.system.red.mass, v); },
     [](const Scene& s) { return number(s.system.red.mass); }},
    {"red.position", [](Scene& s, const Values& v) { set_number(s.system.red.position, v); },
     [](const Scene& s) { return number(s.system.red.position); }},
    {"red.velocity", [](Scene& s, const Values& v) { set_number(s.system.red.velocity, v); },
     [](const Scene& s) { return number(s.system.red.velocity); }},
    {"red.width", [](Scene& s, const Values& v) { set_number(s.system.red.width, v); },
     [](const Scene& s) { return number(s.system.red.width); }},
    {"view.x", [](Scene& s, const Values& v) { set_range(s.view.x, v); },
     [](const Scene& s) { return range(s.view.x); }},
    {"view.y", [](Scene& s, const Values& v) { set_range(s.view.y, v); },
     [](const Scene& s) { return range(s.view.y); }},
    {"view.size", [](Scene& s, const Values& v) { set_size(s.view, v); },
     [](const Scene& s) { return size(s.view); }},
    {"view.fps", [](Scene& s, const Values& v) { set_number(s.view.frame_rate, v); },
     [](const Scene& s) { return number(s.view.frame_rate); }},
    {"view.shutter", [](Scene& s, const Values& v) { set_number(s.view.shutter, v); },
     [](const Scene& s) { return number(s.view.shutter); }},
    {"view.background", [](Scene& s, const Values& v) { set_background(s.view, v); },
     [](const Scene& s) { return background(s.view.background); }},
    {"view.theme", [](Scene& s, const Values& v) { s.view.theme = parse_theme(single(v)); },
     [](const Scene& s) { return Values{exact_text(s.view.theme)}; }},
    {"time.from", [](Scene& s, const Values& v) { s.time.from = parse_instant(single(v)); },
     [](const Scene& s) { return instant(s.time.from); }},
    {"time.to", [](Scene& s, const Values& v) { s.time.to = parse_instant(single(v)); },
     [](const Scene& s) { return instant(s.time.to); }},
    {"time.speed", [](Scene& s, const Values& v) { set_speed(s, v); },
     [](const Scene& s) { return number(s.time.speed); }},
    {"time.duration", [](Scene& s, const Values& v) { set_duration(s, v); },
     [](const Scene& s) { return s.pacing.duration_s ? number(*s.pacing.duration_s) : Values(); }},
    {"time.slow-motion", [](Scene& s, const Values& v) { set_slow_motion(s.pacing, v); },
     [](const Scene& s) { return slow_motion(s.pacing); }},
    {"time.freeze",
     [](Scene& s, const Values& v) { s.pacing.freezes = parse_each(list_of(v), parse_freeze); },
     [](const Scene& s) { return each(s.pacing.freezes); }},
    {"time.hold-start", [](Scene& s, const Values& v) { set_number(s.pacing.hold_start_s, v); },
     [](const Scene& s) { return number(s.pacing.hold_start_s); }},
    {"time.hold-end", [](Scene& s, const Values& v) { set_number(s.pacing.hold_end_s, v); },
     [](const Scene& s) { return number(s.pacing.hold_end_s); }},
    {"time.loop", [](Scene& s, const Values& v) { s.pacing.loop = parse_bool(v); },
     [](const Scene& s) { return flag(s.pacing.loop); }},
    {"sound.on", [](Scene& s, const Values& v) { s.sound.on = parse_bool(v); },
     [](const Scene& s) { return flag(s.sound.on); }},
    {"show.overlays",
     [](Scene& s, const Values& v) { s.show.overlays = parse_each(list_of(v), parse_overlay); },
     [](const Scene& s) { return each(s.show.overlays); }},
    {"show.panels",
     [](Scene& s, const Values& v) { s.show.panels = parse_each(list_of(v), parse_panel); },
     [](const Scene& s) { return each(s.show.panels); }},
    {"show.title", [](Scene& s, const Values& v) { s.show.title = single(v); },
     [](const Scene& s) { return Values{s.show.title}; }},
    {"show.caption", [](Scene& s, const Values& v) { s.show.caption = single(v); },
     [](const Scene& s) { return Values{s.show.caption}; }},
    {"show.logo", [](Scene& s, const Values& v) { s.show.logo = single(v); },
     [](const Scene& s) { return Values{s.show.logo}; }},
    {"golden.frames", [](Scene& s, const Values& v) { s.golden.frames = list_of(v); },
     [](const Scene& s) { return s.golden.frames; }},
    {"golden.size", [](Scene& s, const Values& v) { s.golden.size = parse_size(v); },
     [](const Scene& s) { return s.golden.size ? size(*s.golden.size) : Values(); }},
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
