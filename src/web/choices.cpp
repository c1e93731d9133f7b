#include "web/choices.hpp"

#include <piblocks/error.hpp>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "draw/composition.hpp"
#include "scene/scene_keys.hpp"
#include "web/facts.hpp"
#include "web/json.hpp"
#include "web/opening.hpp"
#include "web/room.hpp"

namespace piblocks::web {
namespace {

std::optional<std::string> reason_against(Scene scene, const LiveScript& live,
                                          const FrameSize& size) {
  scene.view.width_px = size.width_px;
  scene.view.height_px = size.height_px;
  try {
    const Composition composition(scene, live.run()->log());
    return std::nullopt;
  } catch (const UsageError& error) {
    return reason_alone(error.problems().front());
  } catch (const Error& error) {
    return error.what();
  }
}

/// Why the scene cannot be shown; nothing if it can.
std::optional<std::string> reason_against(const Scene& scene, const LiveScript& live) {
  for (const Problem& problem : problems_of(scene)) return reason_alone(problem);
  const View& view = live.view();
  std::optional<std::string> reason = reason_against(scene, live, {view.width_px, view.height_px});
  const FrameSize own{scene.view.width_px, scene.view.height_px};
  const bool is_other = own.width_px != view.width_px || own.height_px != view.height_px;
  // What does not fit on the screen may still fit into the scene's own size.
  return reason && is_other ? reason_against(scene, live, own) : reason;
}

/// @param list  of the names that are shown
std::string reasons_against(const LiveScript& live, const char* key, const std::string& names,
                            const Values& list) {
  const SceneKey* const scene_key = find_scene_key(key);
  std::vector<std::pair<std::string, std::string>> members;
  for (const std::string& name : list_of({names})) {
    if (std::ranges::count(list, name) > 0) continue;
    Values longer = list;
    longer.push_back(name);
    Scene scene = std::get<Scene>(live.script());
    scene_key->set(scene, longer);
    if (const auto reason = reason_against(scene, live))
      members.emplace_back(name, json_text(*reason));
  }
  return json_object(members);
}

}  // namespace

std::string choices_json(const LiveScript& live) {
  const auto* const scene = std::get_if<Scene>(&live.script());
  if (scene == nullptr) return R"({"show.panels":{},"show.overlays":{},"room":null})";
  Values panels;
  for (const Panel panel : scene->show.panels) panels.push_back(exact_text(panel));
  Values overlays;
  for (const Overlay overlay : overlays_of(*scene)) overlays.push_back(exact_text(overlay));
  std::optional<Body> room;
  if (scene->system.bodies.size() <= kMaxBodyRows) room = body_with_room(*scene);
  return fmt::format(R"({{"show.panels":{},"show.overlays":{},"room":{}}})",
                     reasons_against(live, "show.panels", panel_names(), panels),
                     reasons_against(live, "show.overlays", overlay_names(), overlays),
                     room ? body_json(*room, {}, scene->system.dimensions) : "null");
}

}  // namespace piblocks::web
