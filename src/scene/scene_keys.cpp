#include "scene/scene_keys.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <piblocks/error.hpp>
#include <piblocks/instant.hpp>

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>
#include <sstream>
#include <utility>

#include "core/nearest_name.hpp"
#include "core/text.hpp"
#include "core/whole_number.hpp"
#include "scene/body_keys.hpp"

namespace piblocks {
namespace {

/// The values as one text for a message.
std::string joined(const Values& values) {
  if (values == Values{""}) return "''";
  return shortened(values.size() == 1 ? values.front()
                                      : fmt::format("[{}]", fmt::join(values, ", ")));
}

int parse_side(std::string_view text) {
  const std::optional<Integer> side = whole_number(text);
  if (side && side->fits_sint_p()) return static_cast<int>(side->get_si());
  throw UsageError("must be two whole numbers of pixels, as 1920x1080");
}

FrameSize parse_size(const Values& values) {
  Values sides = values;
  const std::size_t cross = values.size() == 1 ? values.front().find('x') : std::string::npos;
  if (cross != std::string::npos) {
    sides = {values.front().substr(0, cross), values.front().substr(cross + 1)};
  }
  if (sides.size() != 2) throw UsageError("must be two whole numbers of pixels, as 1920x1080");
  return {parse_side(sides[0]), parse_side(sides[1])};
}

/// Parses each value of a list; messages name the one that is wrong.
template <typename Value>
std::vector<Value> parse_each(const Values& values, Value (*parse)(std::string_view text)) {
  std::vector<Value> parsed;
  for (const std::string& value : values) {
    try {
      parsed.push_back(parse(value));
    } catch (const UsageError& error) {
      throw UsageError(fmt::format("'{}' {}", shortened(value), error.what()));
    }
  }
  return parsed;
}
template <typename Value>
std::vector<Value> parse_list(const Values& values, Value (*parse)(std::string_view text)) {
  return parse_each(list_of(values), parse);
}

// read() sets a value from its texts, texts_of() gives them back.

void read(Rational& target, const Values& values) { target = parse_rational(single(values)); }
void read(Instant& target, const Values& values) { target = parse_instant(single(values)); }
void read(Theme& target, const Values& values) { target = parse_theme(single(values)); }
void read(std::optional<Contacts>& target, const Values& values) {
  target = parse_contacts(single(values));
}
void read(std::string& target, const Values& values) { target = single(values); }
void read(Values& target, const Values& values) { target = list_of(values); }
void read(std::optional<FrameSize>& target, const Values& values) { target = parse_size(values); }
void read(std::optional<RgbColor>& target, const Values& v) { target = parse_color(single(v)); }
void read(std::optional<Loupe>& target, const Values& v) { target = parse_loupe(single(v)); }
void read(std::vector<Freeze>& list, const Values& v) { list = parse_list(v, parse_freeze); }
void read(std::optional<std::vector<Overlay>>& list, const Values& values) {
  list = values == Values{"none"} ? std::vector<Overlay>() : parse_list(values, parse_overlay);
}
void read(std::vector<Panel>& list, const Values& v) { list = parse_list(v, parse_panel); }
void read(Range& target, const Values& values) {
  if (values.size() != 2) throw UsageError("must be two numbers, as [-1, 12]");
  target = {parse_rational(values[0]), parse_rational(values[1])};
}
void read(bool& target, const Values& values) { target = parse_bool(values); }

Values texts_of(const Rational& value) { return {value.get_str()}; }
Values texts_of(const Instant& value) { return {exact_text(value)}; }
Values texts_of(Theme value) { return {exact_text(value)}; }
Values texts_of(Contacts value) { return {exact_text(value)}; }
Values texts_of(const std::string& value) { return {value}; }
Values texts_of(const Values& value) { return value; }
Values texts_of(const Range& value) { return {value.low.get_str(), value.high.get_str()}; }
Values texts_of(bool value) { return {value ? "true" : "false"}; }
Values texts_of(const RgbColor& value) { return {exact_text(value)}; }
Values texts_of(const Loupe& value) { return {exact_text(value)}; }
Values texts_of(const FrameSize& value) {
  return {fmt::format("{}x{}", value.width_px, value.height_px)};
}
template <typename Value>
Values texts_of(const std::vector<Value>& list) {
  Values texts;
  for (const Value& value : list) texts.push_back(exact_text(value));
  return texts;
}
template <typename Value>
Values texts_of(const std::optional<Value>& value) {
  return value ? texts_of(*value) : Values();
}
/// An empty list is "none". Without a list the theme chooses the overlays.
Values texts_of(const std::optional<std::vector<Overlay>>& list) {
  return list && list->empty() ? Values{"none"} : texts_of<std::vector<Overlay>>(list);
}

/// A key for one member of a scene, given by pointers to members.
template <auto... Path>
constexpr SceneKey key(const char* name) {
  return {name, [](Scene& scene, const Values& values) { read((scene.*....*Path), values); },
          [](const Scene& scene) { return texts_of((scene.*....*Path)); }};
}

/// A mass, which may be a longer number than others.
void read(std::optional<Rational>& target, const Values& values) {
  target = parse_rational(single(values), kMaxMassBits);
}
/// A vector of a line.
void read(ExactVector& target, const Values& values) { read(target[0], values); }
Values texts_of(const ExactVector& value) { return texts_of(value[0]); }

struct WallFace {
  auto& operator()(auto& system) const { return system.walls[0].point; }
};
template <std::size_t Index, auto Member>
struct BodyValue {
  auto& operator()(auto& system) const { return system.bodies[Index].*Member; }
};

/// A key of a part of the system that only short names have.
template <typename PartOf>
constexpr SceneKey short_key(const char* name) {
  return {name, [](Scene& scene, const Values& values) { read(PartOf()(scene.system), values); },
          [](const Scene& scene) {
            return has_short_names(scene.system) ? texts_of(PartOf()(scene.system)) : Values();
          }};
}
template <auto Member>
constexpr SceneKey blue_key(const char* name) {
  return short_key<BodyValue<0, Member>>(name);
}
template <auto Member>
constexpr SceneKey red_key(const char* name) {
  return short_key<BodyValue<1, Member>>(name);
}

/// The color of blue or red.
template <std::size_t Index>
constexpr SceneKey color_key(const char* name) {
  return {name, [](Scene& scene, const Values& values) { read(scene.styles[Index].color, values); },
          [](const Scene& scene) {
            return has_short_names(scene.system) ? texts_of(scene.styles[Index].color) : Values();
          }};
}

void set_size(Scene& scene, const Values& values) {
  const FrameSize size = parse_size(values);
  scene.view.width_px = size.width_px;
  scene.view.height_px = size.height_px;
}
Values size_of(const Scene& scene) {
  return texts_of(FrameSize{scene.view.width_px, scene.view.height_px});
}

void set_background(Scene& scene, const Values& values) {
  const std::string& text = single(values);
  View& view = scene.view;
  view.background = text == "transparent" ? Background::transparent : Background::opaque;
  view.colors.background.reset();
  if (text.starts_with('#')) {
    read(view.colors.background, values);
  } else if (text != "opaque" && text != "transparent") {
    throw UsageError(must_be_one_of(
        text, {"opaque", "transparent", "a colour as \"#1f77b4\": # and six hexadecimal digits"}));
  }
}
Values background_of(const Scene& scene) {
  const View& view = scene.view;
  if (view.background == Background::transparent) return {"transparent"};
  return view.colors.background ? texts_of(*view.colors.background) : Values{"opaque"};
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

/// Rates of broadcasting by their decimals, in which people write them: 29.97 is 30000/1001, and
/// 23.976 and 23.98 are 24000/1001 (SMPTE ST 2036-1).
Rational parse_frame_rate(std::string_view text) {
  Rational rate = parse_rational(text);
  const Integer whole = ceil(rate);
  const bool is_exact = rate == whole || text.find('/') != std::string_view::npos;
  if (is_exact || (whole % 24 != 0 && whole % 30 != 0)) return rate;
  const Rational of_broadcasting = Rational(whole) * 1000 / 1001;
  return abs(rate - of_broadcasting) < Rational(1, 200) ? of_broadcasting : rate;
}

void set_frame_rate(Scene& scene, const Values& values) {
  scene.view.frame_rate = parse_frame_rate(single(values));
}
Values frame_rate_of(const Scene& scene) { return texts_of(scene.view.frame_rate); }

void set_base(Scene& scene, const Values& values) {
  scene.show.base = parse_int(single(values), kMinBase, kMaxBase);
}
Values base_of(const Scene& scene) { return {fmt::format("{}", scene.show.base)}; }

constexpr auto kKeys = std::to_array<SceneKey>({
    SceneKey{"base", set_base, base_of},
    short_key<WallFace>("wall.face"),
    blue_key<&Body::mass>("blue.mass"),
    blue_key<&Body::position>("blue.position"),
    blue_key<&Body::velocity>("blue.velocity"),
    blue_key<&Body::size>("blue.width"),
    color_key<0>("blue.color"),
    red_key<&Body::mass>("red.mass"),
    red_key<&Body::position>("red.position"),
    red_key<&Body::velocity>("red.velocity"),
    red_key<&Body::size>("red.width"),
    color_key<1>("red.color"),
    key<&Scene::system, &System::restitution>("blocks.restitution"),
    key<&Scene::system, &System::wall_restitution>("wall.restitution"),
    key<&Scene::system, &System::contacts>("contacts"),
    key<&Scene::view, &View::x>("view.x"),
    key<&Scene::view, &View::y>("view.y"),
    SceneKey{"view.size", set_size, size_of},
    SceneKey{"view.fps", set_frame_rate, frame_rate_of},
    key<&Scene::view, &View::shutter>("view.shutter"),
    SceneKey{"view.background", set_background, background_of},
    key<&Scene::view, &View::theme>("view.theme"),
    key<&Scene::view, &View::colors, &Colors::ink>("view.colors.ink"),
    key<&Scene::view, &View::colors, &Colors::accent>("view.colors.accent"),
    key<&Scene::view, &View::colors, &Colors::muted>("view.colors.muted"),
    key<&Scene::view, &View::colors, &Colors::done>("view.colors.done"),
    key<&Scene::view, &View::colors, &Colors::grid>("view.colors.grid"),
    key<&Scene::time, &TimeSpan::from>("time.from"),
    key<&Scene::time, &TimeSpan::to>("time.to"),
    SceneKey{"time.speed", set_speed, speed_of},
    SceneKey{"time.duration", set_duration, duration_of},
    key<&Scene::time, &TimeSpan::allow_uncertain>("time.allow-uncertain"),
    SceneKey{"time.slow-motion", set_slow_motion, slow_motion_of},
    key<&Scene::pacing, &Pacing::ease_s>("time.ease"),
    key<&Scene::pacing, &Pacing::freezes>("time.freeze"),
    key<&Scene::pacing, &Pacing::hold_start_s>("time.hold-start"),
    key<&Scene::pacing, &Pacing::hold_end_s>("time.hold-end"),
    key<&Scene::pacing, &Pacing::loop>("time.loop"),
    key<&Scene::sound, &Sound::on>("sound.on"),
    key<&Scene::show, &Show::overlays>("show.overlays"),
    key<&Scene::show, &Show::panels>("show.panels"),
    key<&Scene::show, &Show::title>("show.title"),
    key<&Scene::show, &Show::caption>("show.caption"),
    key<&Scene::show, &Show::logo>("show.logo"),
    key<&Scene::show, &Show::hits>("show.hits"),
    key<&Scene::show, &Show::loupe>("show.loupe"),
    key<&Scene::golden, &Golden::frames>("golden.frames"),
    key<&Scene::golden, &Golden::size>("golden.size"),
});

}  // namespace

std::span<const SceneKey> scene_keys() { return kKeys; }

const SceneKey* find_scene_key(std::string_view name) {
  const auto* const found = std::ranges::find(kKeys, name, &SceneKey::name);
  return found == kKeys.end() ? nullptr : found;
}

std::span<const KeysOfOneValue> keys_of_one_value() {
  static const std::array<KeysOfOneValue, 4> alike = {
      {{"the speed", {"time.speed", "time.duration"}},
       {"the mass of red", {"digits", "mass-ratio", "red.mass"}},
       {"the restitution of the blocks", {"restitution", "blocks.restitution"}},
       {"the restitution of the wall", {"restitution", "wall.restitution"}}}};
  return alike;
}

bool set_same_value(std::string_view one, std::string_view other) {
  return one == other || std::ranges::any_of(keys_of_one_value(), [&](const KeysOfOneValue& of) {
           return std::ranges::count(of.keys, one) > 0 && std::ranges::count(of.keys, other) > 0;
         });
}

bool is_short_key(std::string_view key) {
  return (key.starts_with("blue.") || key.starts_with("red.") || key.starts_with("wall.")) &&
         !key.ends_with(".restitution");
}

bool is_film_key(std::string_view key) {
  constexpr std::array<std::string_view, 5> kOfFilm = {"view.size", "view.fps", "view.background",
                                                       "view.theme", "sound.on"};
  return key.starts_with("golden.") || key.starts_with("view.colors.") ||
         std::ranges::count(kOfFilm, key) > 0;
}

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

const std::string& single(const Values& values) {
  if (values.size() != 1) throw UsageError("must be one value");
  return values.front();
}

bool parse_bool(const Values& values) {
  const std::string& text = single(values);
  if (text != "true" && text != "false") {
    throw UsageError(must_be_one_of(text, {"true", "false"}));
  }
  return text == "true";
}

std::string normalized_item(std::string_view key, const std::string& text) {
  const SceneKey* const found = find_scene_key(key);
  if (found == nullptr) return text;
  try {
    Scene scene;
    found->set(scene, {text});
    const Values values = found->get(scene);
    return values.size() == 1 ? values.front() : text;
  } catch (const UsageError&) {
    return text;
  }
}

Problem problem_of_text(const std::string& key, const Values& values, const std::exception& error) {
  return {.key = key,
          .reason = fmt::format("= {}: {}", joined(values), error.what()),
          .means_nothing = true};
}

std::vector<std::pair<std::string, std::string>> describe(const Scene& scene) {
  std::vector<std::pair<std::string, std::string>> values;
  for (const SceneKey& key : scene_keys()) {
    values.emplace_back(key.name, fmt::format("{}", fmt::join(key.get(scene), ", ")));
  }
  if (!has_short_names(scene.system))
    std::ranges::move(describe_bodies(scene), std::back_inserter(values));
  return values;
}

}  // namespace piblocks
