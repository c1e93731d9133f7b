#include "web/opening.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <new>
#include <span>
#include <utility>

#include "core/text.hpp"
#include "scene/body_keys.hpp"
#include "scene/scene_keys.hpp"
#include "web/choices.hpp"
#include "web/facts.hpp"
#include "web/json.hpp"

namespace piblocks::web {
namespace {

/// A line of settings.
struct Setting {
  std::string key;
  std::optional<std::vector<std::string>> texts;  ///< nothing: the key has its default
};

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
    // Whether a later line resets this key, or the body that has it, to the default.
    const auto is_reset = [&](const Setting& later) {
      return !later.texts && (set_same_value(later.key, key) || key.starts_with(later.key + '.'));
    };
    const auto is_left_out = [&](const LeftOut& out) {
      return out.part == 0 && out.item.empty() && out.key == key;
    };
    if (!setting->texts || std::any_of(setting, settings.end(), is_reset)) continue;
    if (std::ranges::any_of(left_out, is_left_out)) continue;
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

/// @param lines  as Request::settings. @throws UsageError
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

/// Reads the text and, over it, the settings. If the wall has a finite mass, blue, red and wall
/// are bodies 1, 2 and 3. @throws SceneError if it is too long, or no TOML.
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

/// Names and keys that are left out of one scene at most.
constexpr std::size_t kMostLeftOut = 60;

/// When a scene ends that has no other end: nothing happens from time 0 on, or for ever.
constexpr const char* kFixedEnd = "10";

/// The theme with room for counts of any length.
constexpr const char* kPlainTheme = "article";

bool is_body_label(const std::string& key) {
  return number_in(key, "body ") > 0 && key.ends_with(".label");
}

/// What a scene shows, under 0; or what each part of a storyboard shows, under its line.
using Shows = std::map<std::size_t, Show>;

/// The lists and texts of all runs of a part together.
Shows shows_of(const Script& script) {
  if (const auto* const scene = std::get_if<Scene>(&script)) return {{0, scene->show}};
  Shows shows = {{0, {}}};
  for (const Segment& segment : std::get<Storyboard>(script).segments) {
    Show& all = shows[number_in(segment.origin, "scene:")];
    const auto* const scenes = std::get_if<Scenes>(&segment.content);
    if (scenes == nullptr) continue;
    for (const Scene& scene : *scenes) {
      const Show& show = scene.show;
      if (all.panels.empty()) all.panels = show.panels;
      if (!all.overlays || all.overlays->empty()) all.overlays = show.overlays;
      if (all.caption.empty()) all.caption = show.caption;
      if (all.title.empty()) all.title = show.title;
      if (all.logo.empty()) all.logo = show.logo;
    }
  }
  return shows;
}

/// What there is to leave out where everything together has too little room, beginning with what is
/// missed least.
LeftOut least_needed(const Show& show) {
  if (!show.panels.empty()) return {"show.panels"};
  if (show.overlays && !show.overlays->empty()) return {"show.overlays"};
  for (const auto& [key, text] :
       {std::pair("show.caption", &show.caption), std::pair("show.title", &show.title),
        std::pair("show.logo", &show.logo)}) {
    if (!text->empty()) return {key};
  }
  return {"show.loupe"};
}

std::optional<FrameSize> size_of(const std::string& text) {
  if (text.empty()) return std::nullopt;
  try {
    Scene scene;
    find_scene_key("view.size")->set(scene, {text});
    return FrameSize{scene.view.width_px, scene.view.height_px};
  } catch (const UsageError&) {
    return std::nullopt;
  }
}

class Opener {
 public:
  explicit Opener(const Request& request)
      : request_(request),
        settings_(settings_of(request.settings)),
        screen_(size_of(request.screen)),
        changed_(settings_.empty() ? std::string() : settings_.back().key) {}

  OpenedScript run() {
    for (;;) {
      try {
        OpenedScript opening = attempt();
        if (leave_out(opening.live->film_problems())) continue;
        if (!request_.places.empty()) add_picture(opening);
        opening.left_out = left_out_;
        return opening;
      } catch (const UsageError& error) {
        if (!leave_out(error.problems())) throw;
      }
    }
  }

 private:
  OpenedScript attempt() {
    OpenedScript opening{.builder = builder_of(request_.text, settings_, left_out_)};
    if (has_fixed_end_) {
      opening.builder->set("time.from", "time.from", "0");
      opening.builder->set("time.to", "time.to", kFixedEnd);
    }
    if (has_plain_theme_) opening.builder->set("view.theme", "view.theme", kPlainTheme);
    Script script = opening.builder->build();
    shows_ = shows_of(script);
    opening.live = live_of(std::move(script));
    return opening;
  }

  std::unique_ptr<LiveScript> live_of(Script script) const {
    if (screen_) {
      try {
        return std::make_unique<LiveScript>(script, screen_);
      } catch (const UsageError&) {
        // It does not fit, or is wrong at any size.
      }
    }
    return std::make_unique<LiveScript>(std::move(script));
  }

  void add_picture(OpenedScript& opening) const {
    const LiveScript& live = *opening.live;
    const auto show = [&](const LiveScript::Place& place) {
      opening.picture = Picture{place, live.picture(place)};
    };
    for (const std::string& text : split(request_.places, '\n')) {
      try {
        return show(read_place(live, text));
      } catch (const Error& error) {
        const auto* const usage = dynamic_cast<const UsageError*>(&error);
        const auto may_help = [&](const Problem& one) {
          return what_to_leave_out(one).has_value();
        };
        if (usage != nullptr && std::ranges::any_of(usage->problems(), may_help)) throw;
        if (opening.place_problem.empty()) opening.place_problem = error.what();
      }
    }
    show(live.place_of_frame(0));
  }

  /// What to leave out because of this problem; nothing if that is of no use.
  std::optional<LeftOut> what_to_leave_out(const Problem& problem) const {
    if (!can_be_left_out(problem)) return std::nullopt;
    const std::size_t part = part_of(problem);
    const Show& show = shows_.at(part);
    LeftOut out = problem.key == "show" ? least_needed(show) : LeftOut{problem.key, problem.item};
    if (out.item.empty()) out.item = last_of_list(out.key, show);
    if (!is_film_key(out.key) && !is_body_label(out.key)) out.part = part;
    // The part may have it from the whole film.
    if (is_among(did_not_help_, out)) out.part = 0;
    const bool is_of_all = problem.key == "show" && changed_.starts_with("show.");
    if (is_of_all || set_same_value(out.key, changed_) || is_among(did_not_help_, out))
      return std::nullopt;
    out.reason = reason_alone(problem);
    return out;
  }

  /// What to take from a list where it is not known which name is too much.
  static std::string last_of_list(const std::string& key, const Show& show) {
    if (key == "show.panels" && !show.panels.empty()) return exact_text(show.panels.back());
    const bool has_overlays = show.overlays && !show.overlays->empty();
    return key == "show.overlays" && has_overlays ? exact_text(show.overlays->back()) : "";
  }

  /// The line of the part that a problem is of; 0 if it is of none.
  std::size_t part_of(const Problem& problem) const {
    const std::string_view origin = problem.origin;
    const std::size_t line = number_in(origin.substr(0, origin.find(": ")), "scene:");
    return std::prev(shows_.upper_bound(line))->first;
  }

  static bool is_among(const std::vector<LeftOut>& list, const LeftOut& one) {
    return std::ranges::any_of(list, [&](const LeftOut& other) {
      return other.key == one.key && other.item == one.item && other.part == one.part;
    });
  }

  /// Leaves out what these problems are about. What was left out already, and did not help, is
  /// there again. @returns whether another attempt is of use.
  bool leave_out(const std::vector<Problem>& problems) {
    bool has_changed = false;
    const std::vector<LeftOut> before = left_out_;
    for (const Problem& problem : problems) {
      const std::optional<LeftOut> out = what_to_leave_out(problem);
      if (!out || left_out_.size() == kMostLeftOut) continue;
      if (is_among(before, *out) && may_fix_end(*out)) {
        has_fixed_end_ = true;
        const LeftOut end{"time.to", {}, out->reason};
        if (!is_among(left_out_, end)) left_out_.push_back(end);
      } else if (is_among(before, *out) && out->key == "view.theme" && !has_plain_theme_) {
        has_plain_theme_ = true;
      } else if (is_among(before, *out)) {
        if (out->key == "view.theme") has_plain_theme_ = false;
        did_not_help_.push_back(*out);
        std::erase_if(left_out_, [&](const LeftOut& one) { return is_among({*out}, one); });
      } else if (!is_among(left_out_, *out)) {
        left_out_.push_back(*out);
      }
      has_changed = true;
    }
    return has_changed;
  }

  /// Whether the scene may be shown up to a fixed time, since it has no other beginning or end.
  bool may_fix_end(const LeftOut& out) const {
    const bool is_of_span = out.key == "time.from" || out.key == "time.to";
    return is_of_span && !has_fixed_end_ && changed_ != "time.from" && changed_ != "time.to";
  }

  const Request& request_;
  std::vector<Setting> settings_;
  std::optional<FrameSize> screen_;
  std::string changed_;  ///< the key that has just been changed
  std::vector<LeftOut> left_out_;
  std::vector<LeftOut> did_not_help_;
  bool has_fixed_end_ = false;
  bool has_plain_theme_ = false;
  Shows shows_ = {{0, {}}};  ///< of the last attempt
};

std::string problem_json(const Problem& problem) {
  const bool is_named = problem.reason.starts_with(": ");
  return fmt::format(R"({{"origin":{},"key":{},"reason":{}}})", json_text(problem.origin),
                     json_text(problem.key), json_text(problem.reason.substr(is_named ? 2 : 0)));
}

}  // namespace

OpenedScript open_script(const Request& request) { return Opener(request).run(); }

LiveScript::Place read_place(const LiveScript& live, std::string_view text) {
  constexpr std::string_view kFrame = "frame ";
  constexpr std::string_view kInstant = "instant ";
  if (text.starts_with(kInstant)) {
    return live.place_of(parse_instant(text.substr(kInstant.size())));
  }
  if (!text.starts_with(kFrame))
    throw UsageError(fmt::format("page: '{}' is neither a frame nor an instant", text));
  return live.place_of_frame(std::stoll(std::string(text.substr(kFrame.size()))));
}

bool can_be_left_out(const Problem& problem) {
  constexpr std::array<std::string_view, 7> kOthers = {
      "time.from",   "time.to",       "time.slow-motion", "time.ease",
      "time.freeze", "time.duration", "view.theme"};
  if (problem.means_nothing) return false;
  const std::string& key = problem.key;
  return key == "show" || key.starts_with("show.") || key.starts_with("golden.") ||
         std::ranges::count(kOthers, key) > 0 || is_body_label(key);
}

std::string reason_alone(const Problem& problem) {
  std::string_view reason = problem.reason;
  const std::array<std::string, 4> beginnings = {
      ": ", fmt::format("has '{}', which ", problem.item),
      fmt::format("the diagram '{}' ", problem.item), fmt::format("'{}' ", problem.item)};
  for (const std::string& beginning : beginnings) {
    if (reason.starts_with(beginning)) reason.remove_prefix(beginning.size());
  }
  // What would help follows after it, and is to leave it out.
  return std::string(reason.substr(0, reason.find("; ")));
}

std::string facts_of(const OpenedScript& opening) {
  return facts_json(*opening.live, ranges_json(*opening.builder, *opening.live));
}

std::string opened_json(const OpenedScript& opening, std::string_view facts,
                        std::string_view picture) {
  std::vector<std::string> left_out;
  for (const auto& [key, item, reason, part] : opening.left_out) {
    left_out.push_back(fmt::format(R"({{"key":{},"item":{},"reason":{}}})", json_text(key),
                                   json_text(item), json_text(reason)));
  }
  return fmt::format(R"({{"facts":{},"picture":{},"placeProblem":{},"leftOut":{}}})", facts,
                     picture, json_text(opening.place_problem), json_array(left_out));
}

std::string problems_json(const std::exception& error) {
  std::vector<std::string> problems;
  if (const auto* const usage = dynamic_cast<const UsageError*>(&error)) {
    for (const Problem& problem : usage->problems()) problems.push_back(problem_json(problem));
  } else if (dynamic_cast<const std::bad_alloc*>(&error) != nullptr) {
    problems.push_back(problem_json(
        {.reason = "page: there is no memory left for this scene; make the picture smaller"}));
  } else {
    problems.push_back(problem_json({.reason = error.what()}));
  }
  return fmt::format(R"({{"problems":{}}})", json_array(problems));
}

}  // namespace piblocks::web
