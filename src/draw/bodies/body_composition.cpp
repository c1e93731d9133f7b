#include <piblocks/bodies.hpp>
#include <piblocks/error.hpp>

#include <utility>

#include "draw/bodies/body_panels.hpp"
#include "draw/bodies/body_stage.hpp"
#include "draw/composition.hpp"
#include "draw/look.hpp"
#include "draw/overlays/counter.hpp"
#include "draw/overlays/overlays.hpp"

namespace piblocks {
namespace {

/// Until when what the film shows is certain; nothing if all of it is.
std::optional<double> certain_until(const Scene& scene, const Log& log) {
  return has_span(scene, log) ? log.certain_until(span_of(scene, log).to) : std::nullopt;
}

using MakePanel = Drawable (*)(const DrawingContext& context, const PanelPlace& place);

/// problems_of() a scene has rejected all others.
MakePanel panel_of(Panel panel) {
  if (panel == Panel::time) return positions_panel;
  if (panel == Panel::speeds) return speeds_panel;
  if (panel == Panel::separation) return separation_panel;
  return count_panel;
}

/// Places all that a scene with bodies shows, and makes its drawables in the order of their ids.
class BodyComposer {
 public:
  BodyComposer(const Scene& scene, const Log& log, FrameNeeds& needs)
      : palette_(palette_of(scene.view.theme)),
        sizes_(scene.view),
        context_{.scene = scene,
                 .timeline = log,
                 .blocks = nullptr,
                 .bodies = &log,
                 .palette = palette_,
                 .fonts = fonts_,
                 .font = fonts_.of(text_face_of(scene.view.theme)),
                 .layout = layout_,
                 .sizes = sizes_,
                 .needs = needs,
                 .certain_until = certain_until(scene, log)},
        read_outs_(context_),
        plan_(plan_frame(context_, room(), read_outs_.height())) {}

  std::vector<Drawable> run(std::shared_ptr<const Image> logo) {
    std::vector<Drawable> drawables;
    drawables.push_back(body_stage(context_, plan_.stage));
    drawables.push_back(counter(context_, plan_.counter, {}));
    read_outs_.move(plan_.read_outs_top_px, plan_.counter.slow_motion);
    drawables.emplace_back(std::move(read_outs_));
    std::vector<DrawItem> lines(plan_.lines.begin(), plan_.lines.end());
    if (logo) lines.emplace_back(place_logo(plan_.logo, std::move(logo)));
    drawables.push_back(unchanging(std::move(lines)));
    add_panels(drawables);
    return drawables;
  }

 private:
  void add_panels(std::vector<Drawable>& drawables) const {
    const std::vector<Panel>& panels = context_.scene.show.panels;
    for (std::size_t i = 0; i < panels.size(); ++i) {
      const auto first_id = ItemId{static_cast<std::uint32_t>(ItemId::panels) +
                                   ids_from(static_cast<std::uint32_t>(i))};
      drawables.push_back(panel_of(panels[i])(context_, {plan_.panels[i], first_id, panels[i]}));
    }
  }

  CounterRoom room() const {
    CounterRoom room = counter_room(context_, {});
    room.slow_motion_px = read_outs_.lone_slow_motion_px();
    return room;
  }

  Fonts fonts_;
  Palette palette_;
  Sizes sizes_;
  Layout layout_;  ///< of two blocks; not used
  DrawingContext context_;
  ReadOutRows read_outs_;
  FramePlan plan_;
};

}  // namespace

Composition::Composition(const Scene& scene, const Log& log, std::shared_ptr<const Image> logo)
    : empty_{scene.view.width_px, scene.view.height_px, background_of(scene.view), {}},
      drawables_(BodyComposer(scene, log, needs_).run(std::move(logo))) {}

}  // namespace piblocks
