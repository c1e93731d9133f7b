#include "web/facts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string_view>
#include <vector>

#include "core/text.hpp"
#include "draw/look.hpp"
#include "scene/body_keys.hpp"
#include "scene/run_log.hpp"
#include "scene/scene_keys.hpp"
#include "scene/scene_toml.hpp"
#include "scene/shipped_scenes.hpp"

namespace piblocks::web {
namespace {

std::string json_array(const std::vector<std::string>& values) {
  std::string text;
  for (const std::string& value : values) text += (text.empty() ? "" : ",") + value;
  return '[' + text + ']';
}

std::string json_texts(const std::vector<std::string>& values) {
  std::vector<std::string> quoted;
  quoted.reserve(values.size());
  for (const std::string& value : values) quoted.push_back(json_text(value));
  return json_array(quoted);
}

/// The number of digits that this mass ratio counts; nothing if it is not an even power of the
/// base.
std::optional<int> digits_of(const Rational& ratio, int base) {
  if (ratio.get_den() != 1 || ratio < 1) return std::nullopt;
  Integer power = 1;
  int digits = 1;
  for (; power < ratio.get_num(); ++digits) power *= base * base;
  return power == ratio.get_num() ? std::optional(digits) : std::nullopt;
}

std::string row_json(const Scene& scene, std::size_t i) {
  const Body& body = scene.system.bodies[i];
  const BodyStyle& style = scene.styles[i];
  const int dimensions = scene.system.dimensions;
  return fmt::format(R"({{"mass":{},"position":{},"velocity":{},"size":{},"color":{},"label":{},)"
                     R"("path":{}}})",
                     json_text(body.mass ? body.mass->get_str() : "inf"),
                     json_texts(coordinates_of(body.position, dimensions)),
                     json_texts(coordinates_of(body.velocity, dimensions)),
                     json_text(body.size.get_str()), json_text(color_text(style)),
                     json_text(style.label), style.path);
}

/// Both ends of the box along an axis.
std::string box_json(const System& system, std::string_view low, std::string_view high,
                     std::size_t axis) {
  std::vector<std::string> ends = {"-inf", "inf"};
  for (const Wall& wall : system.walls) {
    if (wall.name == low) ends[0] = wall.point.at(axis).get_str();
    if (wall.name == high) ends[1] = wall.point.at(axis).get_str();
  }
  return json_texts(ends);
}

std::string bodies_json(const Scene& scene) {
  const System& system = scene.system;
  std::vector<std::string> rows;
  for (std::size_t i = 0; i < system.bodies.size() && system.bodies.size() <= kMaxBodyRows; ++i) {
    rows.push_back(row_json(scene, i));
  }
  return fmt::format(R"({{"count":{},"dimensions":{},"x":{},"y":{},"rows":{}}})",
                     system.bodies.size(), system.dimensions, box_json(system, "left", "right", 0),
                     box_json(system, "lower", "upper", 1), json_array(rows));
}

/// What a scene's keys are, and the overlays that it shows.
/// @param of_film  whether to leave out keys that are not for a whole film.
std::string keys_json(Scene scene, bool of_film) {
  scene.show.overlays = overlays_of(scene);
  std::vector<std::string> keys;
  for (const SceneKey& key : scene_keys()) {
    if (of_film && !is_film_key(key.name)) continue;
    keys.push_back(fmt::format("{}:{}", json_text(key.name), json_texts(key.get(scene))));
  }
  std::string text = json_array(keys);
  text.front() = '{';
  text.back() = '}';
  return text;
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
  const PairLog* const pair = run.log().pair();
  const Rational ratio =
      pair == nullptr ? Rational(1) : pair->blocks().red.mass / pair->blocks().blue.mass;
  const std::optional<int> digits = digits_of(ratio, scene.show.base);
  return fmt::format(R"("hasTurn":{},"digits":{},"massRatio":{},"bodies":{},"notes":{})",
                     turn_of(run.log()).has_value(), digits ? fmt::format("{}", *digits) : "null",
                     json_text(ratio.get_str()),
                     has_short_names(scene.system) ? "null" : bodies_json(scene),
                     json_texts(notes_of(scene, run)));
}

}  // namespace

std::string facts_json(const LiveScript& live) {
  const auto* const scene = std::get_if<Scene>(&live.script());
  Scene film;
  film.view = view_of(live.script());
  film.sound = sound_of(live.script());
  const View& view = view_of(live.script());
  const std::optional<std::int64_t> frames = live.frame_count();
  return fmt::format(
      R"({{"kind":"{}","width":{},"height":{},"rate":[{},{}],"frames":{},"filmProblem":{},)"
      R"("keys":{},"toml":{}{}{}}})",
      scene == nullptr ? "storyboard" : "scene", view.width_px, view.height_px,
      view.frame_rate.get_num().get_str(), view.frame_rate.get_den().get_str(),
      frames ? fmt::format("{}", *frames) : "null", json_text(live.film_problem()),
      keys_json(scene ? *scene : film, scene == nullptr), json_text(scene_toml(live.script())),
      scene ? "," : "", scene ? scene_json(*scene, *live.run()) : "");
}

std::string shown_json(const LiveScript& live, const LiveScript::Place& place) {
  const auto text_of = [](const std::optional<std::int64_t>& number) {
    return number ? fmt::format("{}", *number) : std::string("null");
  };
  const std::optional<std::string> state = live.state(place);
  return fmt::format(R"({{"frame":{},"nearFrame":{},"state":{}}})", text_of(place.frame),
                     text_of(live.frame_near(place)), state ? json_text(*state) : "null");
}

std::string program_json() {
  std::vector<std::string> scenes;
  for (const ShippedScene& scene : shipped_scenes()) {
    scenes.push_back(fmt::format(R"({{"name":{},"summary":{},"text":{}}})", json_text(scene.name),
                                 json_text(scene.summary()), json_text(scene.text)));
  }
  return fmt::format(R"({{"scenes":{},"themes":{},"overlays":{},"panels":{}}})", json_array(scenes),
                     json_texts(list_of({theme_names()})), json_texts(list_of({overlay_names()})),
                     json_texts(list_of({panel_names()})));
}

}  // namespace piblocks::web
