#include "draw/composition.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "draw/layout.hpp"
#include "draw/look.hpp"
#include "draw/number_text.hpp"
#include "draw/overlays/counter.hpp"
#include "draw/overlays/hits.hpp"
#include "draw/overlays/loupe.hpp"
#include "draw/overlays/overlays.hpp"
#include "draw/panels/panels.hpp"
#include "draw/region.hpp"
#include "scene/schedule.hpp"

namespace piblocks {
namespace {

/// A smaller logo is a speck.
constexpr double kLeastLogo_px = 1;
constexpr double kLeastLogoLength_px = 3;

void check(bool is_finite, const Rational& time) {
  if (is_finite) return;
  throw UsageError(
      fmt::format("frame: at time {} a position exceeds the range of a double (about "
                  "1.8e308); show another time, or use less extreme positions, velocities and "
                  "widths",
                  short_text(time)));
}

bool is_finite(const Motion& motion) {
  return std::isfinite(motion.position) && std::isfinite(motion.velocity);
}

/// The logo as large as fits, in the lower right corner of its place. @throws UsageError
ImageItem place_logo(const Rectangle& place, std::shared_ptr<const Image> logo) {
  const double scale = std::min(place.width / logo->width_px, place.height / logo->height_px);
  const double width = scale * logo->width_px;
  const double height = scale * logo->height_px;
  if (std::min(width, height) < kLeastLogo_px || std::max(width, height) < kLeastLogoLength_px) {
    throw UsageError(fmt::format(
        "show.logo: a picture of {}x{} would be {:.1f}x{:.1f} pixels here; leave it out, make the "
        "frame larger, or use a picture of another shape",
        logo->width_px, logo->height_px, width, height));
  }
  return {ItemId::logo,
          {place.x + place.width - width, place.y + place.height - height, width, height},
          std::move(logo)};
}

}  // namespace

Composition::Composition(const Scene& scene, const CollisionLog& log,
                         std::shared_ptr<const Image> logo)
    : empty_{scene.view.width_px, scene.view.height_px, background_of(scene.view), {}} {
  const Fonts fonts;
  const Font& font = fonts.of(text_face_of(scene.view.theme));
  const Palette palette = palette_of(scene.view.theme, scene.system);
  const Sizes sizes(scene.view);
  Layout layout;  // made below: what else there is decides it
  const DrawingContext context{.scene = scene,
                               .log = log,
                               .palette = palette,
                               .fonts = fonts,
                               .font = font,
                               .layout = layout,
                               .sizes = sizes,
                               .needs = needs_};
  const bool is_article = scene.view.theme == Theme::article;
  const std::string pi = pi_count(scene, log);
  ReadOutRows rows(context);
  std::optional<CounterRoom> room;
  if (!is_article) {
    room = counter_room(context, pi);
    room->slow_motion_px = rows.lone_slow_motion_px();
  }
  const FramePlan plan = plan_frame(context, room, rows.height());
  layout = is_article ? lay_out_article(scene, longest_count(scene, log), plan.stage, font)
                      : lay_out_stage(scene, plan.stage, font, plan.has_low_floor);

  const Show& show = scene.show;
  const std::shared_ptr<const LoupeInset> loupe = LoupeInset::make(context, plan);
  Drawable behind;
  if (loupe) {
    behind = [=](const FrameState& shown, std::vector<DrawItem>& items) {
      loupe->add_lines(shown, items);
    };
    if (loupe->shows_slow_motion()) {
      rows.leave_slow_motion_to([=](const FrameState& shown) { return loupe->opacity(shown); });
    }
  }
  if (is_article) {
    drawables_.push_back(article_stage(context, pi, std::move(behind)));
  } else {
    drawables_.push_back(stage(context, std::move(behind)));
    drawables_.push_back(counter(context, plan.counter, pi));
  }
  if (show.has(Overlay::masses)) drawables_.push_back(mass_labels(context));
  if (show.has(Overlay::velocities)) drawables_.push_back(velocity_arrows(context));
  if (show.hits && !is_article) drawables_.push_back(hit_marks(context));
  if (show.has(Overlay::ruler)) drawables_.push_back(ruler(context));
  rows.move(plan.read_outs_px, plan.counter.slow_motion);
  drawables_.emplace_back(std::move(rows));
  if (loupe) {
    drawables_.emplace_back(
        [=](const FrameState& shown, std::vector<DrawItem>& items) { (*loupe)(shown, items); });
  }
  std::vector<DrawItem> lines(plan.lines.begin(), plan.lines.end());
  if (logo) lines.emplace_back(place_logo(plan.logo, std::move(logo)));
  drawables_.push_back(unchanging(std::move(lines)));
  // In the order of Panel.
  constexpr std::array kPanels = {velocity_panel, position_panel,     unfolded_panel,
                                  time_panel,     count_panel,        ellipse_panel,
                                  mirrors_panel,  conservation_panel, certainty_panel};
  for (std::size_t i = 0; i < show.panels.size(); ++i) {
    const auto make_panel = kPanels.at(static_cast<std::size_t>(show.panels[i]));
    const auto first_id = ItemId{static_cast<std::uint32_t>(ItemId::panels) +
                                 ids_from(static_cast<std::uint32_t>(i))};
    drawables_.push_back(make_panel(context, {plan.panels[i], first_id, show.panels[i]}));
  }
}

DrawList Composition::frame(const FrameState& shown) const {
  check(is_finite(shown.state.blue) && is_finite(shown.state.red), shown.time);
  DrawList list = empty_;
  for (const Drawable& drawable : drawables_) drawable(shown, list.items);
  check(are_finite(list.items), shown.time);
  return list;
}

}  // namespace piblocks
