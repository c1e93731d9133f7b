#include "web/choices.hpp"

#include <piblocks/error.hpp>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "draw/composition.hpp"
#include "scene/scene_keys.hpp"
#include "web/json.hpp"
#include "web/opening.hpp"

namespace piblocks::web {
namespace {

/// Why the scene cannot be shown; nothing if it can.
std::optional<std::string> refusal_of(const Scene& scene, const LiveScript& live) {
  for (const Problem& problem : problems_of(scene)) return reason_alone(problem);
  std::optional<std::string> reason;
  // What does not fit on the screen may still fit into the scene's own size.
  for (const View* const size : {&live.view(), &scene.view}) {
    Scene seen = scene;
    seen.view.width_px = size->width_px;
    seen.view.height_px = size->height_px;
    try {
      const Composition composition(seen, live.run()->log());
      return std::nullopt;
    } catch (const UsageError& error) {
      reason = reason_alone(error.problems().front());
    } catch (const Error& error) {
      reason = error.what();
    }
  }
  return reason;
}

/// @param list  of the names that are shown
std::string refusals(const LiveScript& live, const char* key, const std::string& names,
                     const Values& list) {
  const auto* const scene_key =
      std::ranges::find(scene_keys(), std::string_view(key), &SceneKey::name).base();
  std::vector<std::pair<std::string, std::string>> members;
  for (const std::string& name : list_of({names})) {
    if (std::ranges::count(list, name) > 0) continue;
    Values longer = list;
    longer.push_back(name);
    Scene scene = std::get<Scene>(live.script());
    scene_key->set(scene, longer);
    if (const auto reason = refusal_of(scene, live)) members.emplace_back(name, json_text(*reason));
  }
  return json_object(members);
}

}  // namespace

std::string choices_json(const LiveScript& live) {
  const auto* const scene = std::get_if<Scene>(&live.script());
  if (scene == nullptr) return R"({"show.panels":{},"show.overlays":{}})";
  Values panels;
  for (const Panel panel : scene->show.panels) panels.push_back(exact_text(panel));
  Values overlays;
  for (const Overlay overlay : overlays_of(*scene)) overlays.push_back(exact_text(overlay));
  return fmt::format(R"({{"show.panels":{},"show.overlays":{}}})",
                     refusals(live, "show.panels", panel_names(), panels),
                     refusals(live, "show.overlays", overlay_names(), overlays));
}

}  // namespace piblocks::web
