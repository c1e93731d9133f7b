#include "web/facts.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>
#include <vector>

#include "core/text.hpp"
#include "draw/layout.hpp"
#include "draw/look.hpp"
#include "draw/stage/stage.hpp"
#include "scene/body_keys.hpp"
#include "scene/run_log.hpp"
#include "scene/scene_keys.hpp"
#include "scene/shipped_scenes.hpp"
#include "web/json.hpp"

namespace piblocks::web {
namespace {

constexpr std::size_t kMostPlaces = 20;
constexpr std::string_view kDigits = "0123456789";

Values decimals_of(Values texts) {
  for (std::string& text : texts) text = with_decimals(text);
  return texts;
}

/// Both ends of the box along an axis.
std::string box_json(const System& system, std::string_view low, std::string_view high,
                     std::size_t axis) {
  std::vector<std::string> ends = {"-inf", "inf"};
  for (const Wall& wall : system.walls) {
    if (wall.name == low) ends[0] = decimal_text(wall.point.at(axis));
    if (wall.name == high) ends[1] = decimal_text(wall.point.at(axis));
  }
  return json_texts(ends);
}

std::string bodies_json(const Scene& scene) {
  const System& system = scene.system;
  std::vector<std::string> rows;
  if (system.bodies.size() <= kMaxBodyRows) {
    for (std::size_t i = 0; i < system.bodies.size(); ++i) {
      rows.push_back(body_json(system.bodies[i], scene.styles[i], system.dimensions));
    }
  }
  return fmt::format(R"({{"count":{},"dimensions":{},"x":{},"y":{},"rows":{}}})",
                     system.bodies.size(), system.dimensions, box_json(system, "left", "right", 0),
                     box_json(system, "lower", "upper", 1), json_array(rows));
}

/// The texts of a key, its numbers as decimals if that means the same value.
Values readable(const SceneKey& key, const Scene& scene) {
  Values exact = key.get(scene);
  Values decimal = decimals_of(exact);
  if (decimal == exact) return exact;
  try {
    Scene trial;
    key.set(trial, decimal);
    if (key.get(trial) == exact) return decimal;
  } catch (const UsageError&) {
    // A name of a file, for one.
  }
  return exact;
}

/// What else sets the masses.
void add_masses(const Scene& scene, std::vector<std::pair<std::string, std::string>>& keys) {
  constexpr int kMostWritten = 4;
  const Rational ratio = mass_ratio_of(scene);
  const int base = scene.show.base;
  const std::optional<int> digits = digits_of(ratio, base);
  keys.emplace_back("digits", json_texts(digits ? Values{fmt::format("{}", *digits)} : Values()));
  keys.emplace_back("mass-ratio", json_texts({digits.value_or(0) > kMostWritten
                                                  ? fmt::format("{}^{}", base * base, *digits - 1)
                                                  : decimal_text(ratio)}));
  keys.emplace_back("wall.mass", json_texts({"inf"}));
}

/// What a scene's keys are, and the overlays that it shows.
/// @param of_film  whether to leave out keys that are not for a whole film.
std::string keys_json(Scene scene, bool of_film) {
  scene.show.overlays = overlays_of(scene);
  std::vector<std::pair<std::string, std::string>> keys;
  for (const SceneKey& key : scene_keys()) {
    if (of_film && !is_film_key(key.name)) continue;
    keys.emplace_back(key.name, json_texts(readable(key, scene)));
  }
  if (!of_film && has_short_names(scene.system)) add_masses(scene, keys);
  return json_object(keys);
}

std::vector<std::string> notes_of(const Scene& scene, const FilmRun& run) {
  std::vector<std::string> notes = convention_notes(scene);
  std::ranges::move(contrast_notes(scene), std::back_inserter(notes));
  const Log& log = run.log();
  const Integer last = has_span(scene, log) ? log.count_at(span_of(scene, log).to) : Integer(0);
  if (auto note = tie_note(log, last)) notes.push_back(*std::move(note));
  return notes;
}

std::string scene_json(const Scene& scene, const FilmRun& run) {
  return fmt::format(R"("hasTurn":{},"bodies":{},"notes":{})", turn_of(run.log()).has_value(),
                     has_short_names(scene.system) ? "null" : bodies_json(scene),
                     json_texts(notes_of(scene, run)));
}

/// @param state  of the place that the picture shows
std::string stage_json(const FilmRun& run, const StateRow& state, const DrawList& picture) {
  const Scene& scene = run.scene();
  if (!has_short_names(scene.system)) return "null";
  const Layout& layout = run.layout();
  std::vector<std::string> blocks;
  for (const std::size_t body : {0U, 1U}) {
    const Rect rect = layout.block_at(body, state.numbers.at(1 + body));  // after the time
    const auto arrow = arrow_in(picture, body, 2);
    blocks.push_back(fmt::format(R"({{"key":"{}","rect":[{},{},{},{}],"arrow":{}}})",
                                 scene.system.bodies[body].name, rect.x, rect.y, rect.width,
                                 rect.height,
                                 arrow ? fmt::format("[{},{},{},{}]", (*arrow)[0].x, (*arrow)[0].y,
                                                     (*arrow)[1].x, (*arrow)[1].y)
                                       : "null"));
  }
  std::optional<ArrowLengths> lengths;
  if (scene.show.has(Overlay::velocities)) lengths.emplace(scene, run.log(), layout);
  return fmt::format(R"({{"scale":{},"blocks":{},"arrowScale":{},"longestArrow":{}}})",
                     layout.scale, json_array(blocks), lengths ? lengths->px_per_speed() : 0,
                     lengths ? lengths->longest_px() : 0);
}

}  // namespace

std::string decimal_text(const Rational& value) {
  Integer rest = value.get_den();
  std::size_t places = 0;
  for (const unsigned long prime : {2UL, 5UL}) {
    const Integer factor = prime;
    places = std::max<std::size_t>(
        places, mpz_remove(rest.get_mpz_t(), rest.get_mpz_t(), factor.get_mpz_t()));
  }
  if (places == 0 || rest != 1 || places > kMostPlaces) return value.get_str();
  const Rational scaled = abs(value) * power(10, places);
  std::string digits = scaled.get_num().get_str();
  if (digits.size() <= places) digits.insert(0, places + 1 - digits.size(), '0');
  digits.insert(digits.size() - places, ".");
  return (value < 0 ? "-" : "") + digits;
}

std::string with_decimals(std::string_view text) {
  std::string result;
  for (;;) {
    const std::size_t begin = text.find_first_of(kDigits);
    if (begin == std::string_view::npos) return result.append(text);
    result.append(text.substr(0, begin));
    text.remove_prefix(begin);
    const std::size_t slash = std::min(text.find_first_not_of(kDigits), text.size());
    std::size_t end = slash;
    if (slash < text.size() && text[slash] == '/') {
      end = std::min(text.find_first_not_of(kDigits, slash + 1), text.size());
    }
    const std::string number(text.substr(0, end));
    const bool is_fraction = end > slash + 1 && number.find_first_not_of('0', slash + 1) < end;
    result += is_fraction ? decimal_text(parse_rational(number, kMaxMassBits)) : number;
    text.remove_prefix(end);
  }
}

Rational mass_ratio_of(const Scene& scene) {
  const std::optional<TwoBlocks> blocks = two_blocks_of(scene.system);
  return blocks ? Rational(blocks->red.mass / blocks->blue.mass) : Rational(1);
}

std::optional<int> digits_of(const Rational& ratio, int base) {
  if (ratio.get_den() != 1 || ratio < 1) return std::nullopt;
  Integer rest;
  const Integer step = base * base;
  const auto power = mpz_remove(rest.get_mpz_t(), ratio.get_num_mpz_t(), step.get_mpz_t());
  if (rest != 1) return std::nullopt;
  return static_cast<int>(power) + 1;
}

std::string body_json(const Body& body, const BodyStyle& style, int dimensions) {
  return fmt::format(R"({{"mass":{},"position":{},"velocity":{},"size":{},"color":{},"label":{}}})",
                     json_text(body.mass ? decimal_text(*body.mass) : "inf"),
                     json_texts(decimals_of(coordinates_of(body.position, dimensions))),
                     json_texts(decimals_of(coordinates_of(body.velocity, dimensions))),
                     json_text(decimal_text(body.size)), json_text(color_text(style)),
                     json_text(style.label));
}

std::string facts_json(const LiveScript& live, std::string_view ranges) {
  const auto* const scene = std::get_if<Scene>(&live.script());
  Scene film;
  film.view = view_of(live.script());
  film.sound = sound_of(live.script());
  const View& view = live.view();
  const std::optional<std::int64_t> frames = live.frame_count();
  const std::vector<Problem>& problems = live.film_problems();
  return fmt::format(
      R"({{"kind":"{}","width":{},"height":{},"rate":[{},{}],"frames":{},"filmProblem":{},)"
      R"("keys":{},"toml":{},"ranges":{}{}{}}})",
      scene == nullptr ? "storyboard" : "scene", view.width_px, view.height_px,
      view.frame_rate.get_num().get_str(), view.frame_rate.get_den().get_str(),
      frames ? fmt::format("{}", *frames) : "null",
      json_text(problems.empty() ? "" : UsageError(problems).what()),
      keys_json(scene ? *scene : film, scene == nullptr), json_text(scene_toml(live.script())),
      ranges, scene ? "," : "", scene ? scene_json(*scene, *live.run()) : "");
}

std::string shown_json(const LiveScript& live, const LiveScript::Place& place,
                       const DrawList& picture) {
  const auto text_of = [](const std::optional<std::int64_t>& number) {
    return number ? fmt::format("{}", *number) : std::string("null");
  };
  const std::optional<StateRow> state = live.state(place);
  return fmt::format(R"({{"frame":{},"nearFrame":{},"state":{},"stage":{}}})", text_of(place.frame),
                     text_of(live.frame_near(place)),
                     state ? json_text(live.state_text(*state)) : "null",
                     state ? stage_json(*live.run(), *state, picture) : "null");
}

std::string program_json() {
  std::vector<std::string> scenes;
  for (const ShippedScene& scene : shipped_scenes()) {
    scenes.push_back(fmt::format(R"({{"name":{},"summary":{},"text":{}}})", json_text(scene.name),
                                 json_text(scene.summary()), json_text(scene.text)));
  }
  std::vector<std::string> alike;
  for (const KeysOfOneValue& of : keys_of_one_value()) alike.push_back(json_texts(of.keys));
  return fmt::format(R"({{"scenes":{},"themes":{},"overlays":{},"panels":{},"alike":{}}})",
                     json_array(scenes), json_texts(list_of({theme_names()})),
                     json_texts(list_of({overlay_names()})), json_texts(list_of({panel_names()})),
                     json_array(alike));
}

}  // namespace piblocks::web
