#include "draw/composition.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "draw/extent.hpp"
#include "draw/layout.hpp"
#include "draw/look.hpp"
#include "draw/number_text.hpp"
#include "draw/overlays/loupe.hpp"
#include "draw/overlays/overlays.hpp"
#include "draw/panels/panels.hpp"
#include "draw/stage/hits.hpp"
#include "draw/stage/stage.hpp"

namespace piblocks {
namespace {

void check(bool is_finite, const Rational& time) {
  if (is_finite) return;
  throw UsageError(
      fmt::format("frame: at time {} a position exceeds the range of a double (about "
                  "1.8e308); show another time, or use less extreme positions, velocities and "
                  "widths",
                  short_text(time)));
}

bool is_finite(const Motion& motion) {
  const auto is_number = [](double value) { return std::isfinite(value); };
  return std::ranges::all_of(motion.position, is_number) &&
         std::ranges::all_of(motion.velocity, is_number);
}

const TwoBlocks* two_blocks_of(const Log& log) {
  return log.pair() != nullptr ? &log.pair()->blocks() : nullptr;
}

FrameNeeds needs_of(const std::vector<Drawable>& drawables) {
  FrameNeeds needs;
  for (const Drawable& drawable : drawables) needs |= drawable.needs;
  return needs;
}

/// The logo as large as fits, in the lower right corner of its place.
/// @throws UsageError if it would be a speck.
ImageItem place_logo(const Rect& place, std::shared_ptr<const Image> logo) {
  constexpr double kLeastLogo_px = 1;
  constexpr double kLeastLogoLength_px = 3;
  const double scale = std::min(place.width / logo->width_px, place.height / logo->height_px);
  const double width = scale * logo->width_px;
  const double height = scale * logo->height_px;
  if (std::min(width, height) < kLeastLogo_px || std::max(width, height) < kLeastLogoLength_px) {
    throw UsageError(
        "show.logo",
        fmt::format("a picture of {}x{} would be {:.1f}x{:.1f} pixels here; leave it out, make the "
                    "frame larger, or use a picture of another shape",
                    logo->width_px, logo->height_px, width, height));
  }
  return {ItemId::logo,
          {place.right() - width, place.bottom() - height, width, height},
          std::move(logo)};
}

/// Places all that a scene shows, and makes its drawables in the order of their ids.
class Composer {
 public:
  Composer(const Scene& scene, const Log& log)
      : scene_(scene),
        is_article_(scene.view.theme == Theme::article && scene.system.dimensions == 1),
        colors_(colors_of(scene, two_blocks_of(log))),
        palette_(log.pair() != nullptr ? palette_of(scene.view, log.pair()->blocks(), colors_)
                                       : palette_of(scene.view)),
        sizes_(scene.view),
        looks_{.scene = scene,
               .log = log,
               .palette = palette_,
               .colors = colors_,
               .fonts = fonts_,
               .font = fonts_.of(text_face_of(scene.view.theme)),
               .sizes = sizes_},
        pi_(pi_count(looks_)),
        read_outs_(looks_),
        plan_(plan_frame(looks_, counter_room_beside_read_outs(), read_outs_.height())),
        layout_(lay_out()),
        context_{looks_, layout_},
        loupe_(LoupeInset::make(context_, plan_)) {}

  const Layout& layout() const { return layout_; }

  std::vector<Drawable> run(std::shared_ptr<const Image> logo) {
    add_stage();
    add_read_outs();
    add_loupe();
    add_lines(std::move(logo));
    add_panels();
    return std::move(drawables_);
  }

 private:
  std::optional<CounterRoom> counter_room_beside_read_outs() const {
    if (is_article_) return std::nullopt;
    CounterRoom room = counter_room(looks_, pi_);
    room.slow_motion_px = read_outs_.lone_slow_motion_px();
    return room;
  }

  Layout lay_out() const {
    if (!is_article_) return lay_out_stage(looks_, plan_);
    return lay_out_article(looks_, longest_count(scene_, looks_.log), plan_.stage);
  }

  /// Walls, floor and bodies, what is over them, and the count.
  void add_stage() {
    add(unchanging(stage_walls(context_)));
    if (auto walls = moving_walls(context_)) add(std::move(*walls));
    if (loupe_) {
      add({[loupe = loupe_](const FrameState& shown, std::vector<DrawItem>& items) {
        loupe->add_lines(shown, items);
      }});
    }
    add(is_article_ ? article_blocks(context_, pi_) : bodies(context_));
    if (context_.is_plane()) {
      add_overlays();
      drawables_ = {window(std::move(drawables_))};
    }
    if (!is_article_) add(counter(context_, plan_.counter, pi_));
    if (context_.is_plane()) return;
    add_overlays();
    if (scene_.show.has(Overlay::ruler)) add(ruler(context_));
  }

  /// What is over the bodies.
  void add_overlays() {
    const Show& show = scene_.show;
    if (has_labels(context_)) add(body_labels(context_));
    if (show.has(Overlay::velocities)) add(velocity_arrows(context_));
    if (context_.shows_hits()) add(hit_marks(context_));
  }

  /// Discs that leave what is shown are cut off at its edge, so that they hide no text.
  Drawable window(std::vector<Drawable> inside) const {
    const FrameNeeds needs = needs_of(inside);
    return {[inside = std::move(inside), bounds = layout_.window,
             background = background_of(scene_.view)](const FrameState& shown,
                                                      std::vector<DrawItem>& items) {
              DrawList list{int(bounds.width), int(bounds.height), background, {}};
              for (const Drawable& drawable : inside) drawable.add(shown, list.items);
              items.emplace_back(GroupItem{ItemId::wall, bounds,
                                           std::make_shared<const DrawList>(std::move(list))});
            },
            needs};
  }

  void add_read_outs() {
    if (loupe_ && loupe_->shows_slow_motion()) {
      read_outs_.leave_slow_motion_to(
          [loupe = loupe_](const FrameState& shown) { return loupe->opacity(shown); });
    }
    read_outs_.move(plan_.read_outs_top_px, plan_.counter.slow_motion);
    add({std::move(read_outs_)});
  }

  void add_loupe() {
    if (!loupe_) return;
    add({[loupe = loupe_](const FrameState& shown, std::vector<DrawItem>& items) {
           (*loupe)(shown, items);
         },
         loupe_->needs()});
  }

  /// Title, caption and logo.
  void add_lines(std::shared_ptr<const Image> logo) {
    std::vector<DrawItem> lines(plan_.lines.begin(), plan_.lines.end());
    if (logo) lines.emplace_back(place_logo(plan_.logo, std::move(logo)));
    add(unchanging(std::move(lines)));
  }

  void add_panels() {
    // In the order of Panel.
    constexpr std::array kPanels = {velocity_panel, position_panel,     unfolded_panel,
                                    time_panel,     count_panel,        velocity_panel,
                                    unfolded_panel, conservation_panel, certainty_panel,
                                    speeds_panel,   separation_panel};
    const std::vector<Panel>& panels = scene_.show.panels;
    for (std::size_t i = 0; i < panels.size(); ++i) {
      const auto make_panel = kPanels.at(static_cast<std::size_t>(panels[i]));
      const auto first_id = ItemId{static_cast<std::uint32_t>(ItemId::panels) +
                                   ids_from(static_cast<std::uint32_t>(i))};
      try {
        add(make_panel(context_, {plan_.panels[i], first_id, panels[i]}));
      } catch (const UsageError& error) {
        throw of_panel(error, panels[i]);
      }
    }
  }

  /// An error that also names the diagram which it is about.
  static UsageError of_panel(const UsageError& error, Panel panel) {
    std::vector<Problem> problems = error.problems();
    for (Problem& problem : problems) {
      if (problem.key == "show.panels") problem.item = exact_text(panel);
    }
    return UsageError(std::move(problems));
  }

  void add(Drawable drawable) { drawables_.push_back(std::move(drawable)); }

  const Scene& scene_;
  bool is_article_;
  Fonts fonts_;
  std::vector<BlockColors> colors_;  ///< of the bodies
  Palette palette_;
  Sizes sizes_;
  LayoutContext looks_;
  std::string pi_;  ///< the count, if it is digits of pi
  ReadOutRows read_outs_;
  FramePlan plan_;
  Layout layout_;
  DrawingContext context_;
  std::shared_ptr<const LoupeInset> loupe_;  ///< may be empty
  std::vector<Drawable> drawables_;
};

}  // namespace

Composition::Composition(const Scene& scene, const Log& log, std::shared_ptr<const Image> logo)
    : empty_{scene.view.width_px, scene.view.height_px, background_of(scene.view), {}} {
  Composer composer(scene, log);
  layout_ = std::make_shared<const Layout>(composer.layout());
  drawables_ = composer.run(std::move(logo));
  needs_ = needs_of(drawables_);
}

DrawList Composition::frame(const FrameState& shown) const {
  for (const Motion& body : shown.state.bodies) check(is_finite(body), shown.time);
  DrawList list = empty_;
  for (const Drawable& drawable : drawables_) drawable.add(shown, list.items);
  check(are_finite(list.items), shown.time);
  return list;
}

}  // namespace piblocks
