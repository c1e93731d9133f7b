#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/instant.hpp>
#include <piblocks/scene.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <sstream>
#include <utility>

#include "scene/toml_file.hpp"

namespace piblocks {
namespace {

using Values = std::vector<std::string>;

const std::string& single(const Values& values) {
  if (values.size() != 1) throw UsageError("must be one value");
  return values.front();
}

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
  if (const auto cross = values.front().find('x');
      values.size() == 1 && cross != std::string::npos) {
    sides = {values.front().substr(0, cross), values.front().substr(cross + 1)};
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
void set_golden_frames(Golden& golden, Values values) {
  if (values.size() == 1) {
    std::istringstream text(values.front());
    values.clear();
    for (std::string value; std::getline(text, value, ',');) values.push_back(value);
  }
  for (const std::string& value : values) {
    // Each has a file of its own.
    if (std::ranges::count(values, value) > 1) {
      throw UsageError(fmt::format("'{}' is named more than once", value));
    }
    try {
      parse_instant(value);
    } catch (const UsageError& error) {
      throw UsageError(fmt::format("'{}' {}", value, error.what()));
    }
  }
  golden.frames = std::move(values);
}

struct Key {
  const char* name;
  void (*set)(Scene& scene, const Values& values);
};

constexpr std::array<Key, 19> kKeys{{
    {"wall.face", [](Scene& s, const Values& v) { set_number(s.system.wall_face, v); }},
    {"blue.mass", [](Scene& s, const Values& v) { set_number(s.system.blue.mass, v); }},
    {"blue.position", [](Scene& s, const Values& v) { set_number(s.system.blue.position, v); }},
    {"blue.velocity", [](Scene& s, const Values& v) { set_number(s.system.blue.velocity, v); }},
    {"blue.width", [](Scene& s, const Values& v) { set_number(s.system.blue.width, v); }},
    {"red.mass", [](Scene& s, const Values& v) { set_number(s.system.red.mass, v); }},
    {"red.position", [](Scene& s, const Values& v) { set_number(s.system.red.position, v); }},
    {"red.velocity", [](Scene& s, const Values& v) { set_number(s.system.red.velocity, v); }},
    {"red.width", [](Scene& s, const Values& v) { set_number(s.system.red.width, v); }},
    {"view.x", [](Scene& s, const Values& v) { set_range(s.view.x, v); }},
    {"view.y", [](Scene& s, const Values& v) { set_range(s.view.y, v); }},
    {"view.size", [](Scene& s, const Values& v) { set_size(s.view, v); }},
    {"view.fps", [](Scene& s, const Values& v) { set_number(s.view.frame_rate, v); }},
    {"view.background", [](Scene& s, const Values& v) { set_background(s.view, v); }},
    {"time.from", [](Scene& s, const Values& v) { set_number(s.time.from, v); }},
    {"time.to", [](Scene& s, const Values& v) { s.time.to = parse_end(single(v)); }},
    {"time.speed", [](Scene& s, const Values& v) { set_number(s.time.speed, v); }},
    {"golden.frames", [](Scene& s, const Values& v) { set_golden_frames(s.golden, v); }},
    {"golden.size", [](Scene& s, const Values& v) { s.golden.size = parse_size(v); }},
}};

std::string joined(const Values& values) {
  return values.size() == 1 ? values.front() : fmt::format("[{}]", fmt::join(values, ", "));
}

}  // namespace

void SceneBuilder::read_file(const std::string& path) {
  for (const TomlEntry& entry : read_toml(path)) {
    const std::string origin = fmt::format("{}:{}", path, entry.line);
    if (entry.problem.empty()) {
      set_values(origin, entry.key, entry.values);
    } else {
      add_problem(origin, fmt::format("{}: {}", entry.key, entry.problem));
    }
  }
}

void SceneBuilder::set(const std::string& origin, const std::string& key, const std::string& text) {
  set_values(origin, key, {text});
}

void SceneBuilder::set_mass_ratio(const std::string& origin, const Rational& ratio) {
  mass_ratio_ = ratio;
  origins_["red.mass"] = origin;
}

void SceneBuilder::set_values(const std::string& origin, const std::string& key,
                              const Values& values) {
  const auto* const found =
      std::find_if(kKeys.begin(), kKeys.end(), [&](const Key& k) { return key == k.name; });
  if (found == kKeys.end()) {
    add_problem(origin, fmt::format("{}: unknown key", key));
    return;
  }
  origins_[key] = origin;
  try {
    found->set(scene_, values);
  } catch (const UsageError& error) {
    add_problem(origin, fmt::format("{} = {}: {}", key, joined(values), error.what()));
  }
}

void SceneBuilder::add_problem(const std::string& origin, const std::string& text) {
  problems_.push_back(fmt::format("{}: {}", origin, text));
}

Scene SceneBuilder::build() const {
  Scene scene = scene_;
  if (mass_ratio_) scene.system.red.mass = scene.system.blue.mass * *mass_ratio_;
  std::vector<std::string> problems = problems_;
  for (const Problem& problem : problems_of(scene)) {
    const auto origin = origins_.find(problem.key);
    const std::string place = origin == origins_.end() ? "scene" : origin->second;
    problems.push_back(fmt::format("{}: {} {}", place, problem.key, problem.reason));
  }
  if (!problems.empty()) throw SceneError(std::move(problems));
  return scene;
}

End parse_end(std::string_view text) {
  constexpr std::string_view kLast = "last";
  if (!text.starts_with(kLast)) return {false, parse_rational(text)};
  const std::string_view offset = text.substr(kLast.size());
  if (offset.empty()) return {true, 0};
  if (offset.front() != '+') throw UsageError("must be a time, 'last' or 'last+S'");
  const Rational after = parse_rational(offset.substr(1));
  if (after < 0) throw UsageError("must not be before the last collision");
  return {true, after};
}

}  // namespace piblocks
