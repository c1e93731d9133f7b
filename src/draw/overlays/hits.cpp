#include "draw/overlays/hits.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include "core/rounded.hpp"
#include "draw/overlays/overlays.hpp"
#include "draw/overlays/zoom.hpp"

namespace piblocks {
namespace {

/// Radius of an arc when it appears, in parts of its final radius.
constexpr double kFirstRadius = 0.3;
/// Directions in which an arc is drawn: without the first and the last, it keeps clear of the
/// bodies.
constexpr std::size_t kDirections = 13;
/// Width of an arc's line, in widths of the wall's line.
constexpr double kMarkLine = 1.2;
/// Of concentric discs that make a glow: their number, the greatest opacity of each, and the radius
/// of the largest in parts of an arc's final radius.
constexpr int kGlowDiscs = 7;
constexpr double kGlowAlpha = 0.24;
constexpr double kGlowReach = 0.8;
/// The strength of a glow goes from the least one at kMaxHitsPerSecond towards 1. It is half-way
/// when the rate has doubled so many times.
constexpr double kLeastGlow = 0.4;
constexpr double kHalfGlow = 6;
/// Strengths that are told apart, from kLeastGlow to 1: one for each of its opacities.
constexpr int kGlows = 38;

/// Which of the kGlows strengths the rate has, from 0, the weakest.
int glow_of(double hits_per_s) {
  const double doublings = straight_log2(hits_per_s / kMaxHitsPerSecond);
  return static_cast<int>(std::lround((kGlows - 1) * doublings / (doublings + kHalfGlow)));
}

double opacity_of_glow(int glow) {
  return kGlowAlpha * (kLeastGlow + (1 - kLeastGlow) * glow / (kGlows - 1));
}

/// From one angle to another, counter-clockwise from the right.
std::vector<Point> directions_of(double from, double to) {
  std::vector<Point> directions;
  for (std::size_t i = 0; i < kDirections; ++i) {
    const double angle = from + (to - from) * double(i) / double(kDirections - 1);
    const auto [sine, cosine] = rounded::sin_cos(angle);
    directions.push_back({cosine, -sine});
  }
  return directions;
}

}  // namespace

HitMarks::HitMarks(const DrawingContext& context, const BlockDimensions& dimensions,
                   double most_reach_px)
    : reach_px_(std::min(most_reach_px, style::kHitReach * context.sizes.short_side)),
      glow_px_(std::min(kGlowReach * reach_px_, dimensions.blue_width_px / 2)),
      line_px_(kMarkLine * context.sizes.wall_line) {
  constexpr double kUp = std::numbers::pi / 2;
  const Palette& palette = context.palette;
  wall_ = {dimensions.floor_px - dimensions.blue_height_px,
           directions_of(0, kUp),
           palette.blue.line,
           {}};
  const bool is_left_free = dimensions.blue_height_px <= dimensions.red_height_px;
  const bool is_right_free = dimensions.red_height_px <= dimensions.blue_height_px;
  blocks_ = {dimensions.floor_px - std::min(dimensions.blue_height_px, dimensions.red_height_px),
             directions_of(is_right_free ? 0 : kUp, is_left_free ? 2 * kUp : kUp),
             palette.red.line,
             {}};
  set_glows(wall_);
  set_glows(blocks_);
}

void HitMarks::add_arc(ItemId id, const Hit& hit, double x_px, std::vector<DrawItem>& items) const {
  const MarkSector& sector = sector_of(hit);
  const std::span directions(sector.directions);
  const double left = 1 - hit.age_s / kHitLife_s;  // of its life
  const double radius = reach_px_ * (1 - (1 - kFirstRadius) * left * left);
  std::vector<Point> arc;
  for (const Point& direction : directions.subspan(1, kDirections - 2)) {
    arc.push_back({x_px + radius * direction.x, sector.y_px + radius * direction.y});
  }
  items.emplace_back(PathItem{id, std::move(arc), false, std::nullopt,
                              Stroke{faded(sector.color, left), line_px_}});
}

void HitMarks::set_glows(MarkSector& sector) const {
  std::vector<Points> outlines;
  for (int disc = 1; disc <= kGlowDiscs; ++disc) {
    const double radius_px = glow_px_ * disc / kGlowDiscs;
    std::vector<Point> outline = {{0, sector.y_px}};
    for (const Point& direction : sector.directions) {
      outline.push_back({radius_px * direction.x, sector.y_px + radius_px * direction.y});
    }
    outlines.emplace_back(std::move(outline));
  }
  for (int glow = 0; glow < kGlows; ++glow) {
    const Color color = faded(sector.color, opacity_of_glow(glow));
    Plate plate;
    for (const Points& outline : outlines) {
      plate.items.emplace_back(PathItem{ItemId::hits, outline, true, color, std::nullopt});
    }
    sector.glows.push_back(std::make_shared<const Plate>(std::move(plate)));
  }
}

void HitMarks::add_glow(double hits_per_s, const ContactPositions& contacts,
                        std::vector<DrawItem>& items) const {
  if (hits_per_s <= kMaxHitsPerSecond) return;
  const auto glow = static_cast<std::size_t>(glow_of(hits_per_s));
  const double reach_px = std::ceil(glow_px_) + 1;
  std::size_t n = 0;
  for (const auto& [sector, x_px] :
       {std::pair(&wall_, contacts.wall_x_px), {&blocks_, contacts.blocks_x_px}}) {
    const double x = std::round(x_px);
    items.emplace_back(
        PlateItem{nth(ItemId::hits, n++),
                  {x - reach_px, std::floor(sector->y_px) - reach_px, 2 * reach_px, reach_px + 1},
                  sector->glows[glow],
                  {x, 0}});
  }
}

Drawable hit_marks(const DrawingContext& context) {
  context.needs.hits = true;
  const Scene& scene = context.scene;
  const Layout& layout = context.layout;
  // A mass above the taller block may be wider than this.
  const bool has_mass =
      scene.show.has(Overlay::masses) && has_mass_above(scene, layout, context.font);
  const double step_px = std::abs(layout.red.height_px - layout.blue.height_px);
  const HitMarks marks(context,
                       {layout.floor_px, layout.blue.height_px, layout.red.height_px,
                        layout.blue.width * layout.scale},
                       has_mass ? step_px : HUGE_VAL);
  const double wall_x_px = layout.at(to_double(scene.system.wall_face), 0).x;
  return [=, layout = context.layout](const FrameState& shown, std::vector<DrawItem>& items) {
    const double blocks_x_px = layout.at(layout.red, shown.state.bodies[1].position[0]).x;
    const auto x_of = [&](const Hit& hit) { return layout.at(hit.contact[0], 0).x; };
    marks.add(shown, {wall_x_px, blocks_x_px}, x_of, items);
  };
}

}  // namespace piblocks
