#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "draw/overlays/loupe.hpp"
#include "draw/stage/stage.hpp"
#include "scene/pacing.hpp"

namespace piblocks {
namespace {

constexpr const char* kLoupeKey = "show.loupe";
/// Of positions, which are doubles; gaps of two blocks beside something immovable are known better.
constexpr int kMaxZoomOfPositions = 1'000'000'000;

double most_gap_px(const LayoutContext& context) {
  return style::kMaxLoupeGap * context.sizes.short_side;
}

/// Walls may be at its ends, and places of collisions are rounded.
bool is_in_view(double x, const View& view) {
  const double low = to_double(view.x.low);
  const double high = to_double(view.x.high);
  const double rounding = 1e-9 * (high - low);
  return low - rounding <= x && x <= high + rounding;
}

/// The face of what is immovable beside two blocks, and room beside it.
bool shows_face(const LayoutContext& context) {
  const auto& [low, high] = context.scene.view.x;
  const TwoBlocks& blocks = context.two_blocks().blocks();
  const Rational face = blocks.side * blocks.wall_face;
  return blocks.side > 0 ? low <= face && face < high : low < face && face <= high;
}

/// The gap between wall and red when it is about least; infinite if that cannot be told.
/// @param within  the times of interest; if empty, all
double least_gap(const PairLog& log, const std::optional<Span>& within = {}) {
  const auto is_within = [&](const Rational& time) {
    return !within || (time >= within->from && time <= within->to);
  };
  const Rational turn = turn_of(log.blocks()).value_or(0);
  try {
    double least = HUGE_VAL;
    if (is_within(turn)) least = log.gaps_at(turn).y2;
    // A light red is nearest at a collision beside the turn.
    const Integer before = log.blocks_at(turn).count;
    for (const Integer& k : {before, Integer(before + 1)}) {
      if (k < log.first_index() || k > log.last()) continue;
      if (!is_within(to_rational(log.blocks_collision(k).time))) continue;
      least = std::min(least, log.gaps_at_collision(k).y2);
    }
    if (!within) return least;
    // Red comes nearer all the time up to then, and goes away all the time from then on.
    return std::min({least, log.gaps_at(within->from).y2, log.gaps_at(within->to).y2});
  } catch (const SimulationError&) {  // beyond the range of a double
    return HUGE_VAL;
  }
}

std::optional<Span> span_of_window(const Loupe& loupe, const Log& log) {
  if (!loupe.window) return std::nullopt;
  const Span span{time_of(loupe.window->from, kLoupeKey, log),
                  time_of(loupe.window->to, kLoupeKey, log)};
  if (span.from < span.to) return span;
  throw UsageError(kLoupeKey, fmt::format("its window from {} to {} must end after it begins",
                                          to_text(span.from), to_text(span.to)));
}

/// The part of the window that the scene shows. @throws UsageError if there is none.
Span shown_part(const LayoutContext& context, const Span& window) {
  if (!has_span(context.scene, context.log)) return window;
  const Span span = span_of(context.scene, context.log);
  Span shown{std::max(window.from, span.from), std::min(window.to, span.to)};
  if (shown.from < shown.to) return shown;
  throw UsageError(
      kLoupeKey,
      fmt::format("its window from {} to {} is outside of what is shown, {} to {}; move it "
                  "there, or leave the loupe out",
                  to_text(window.from), to_text(window.to), to_text(span.from), to_text(span.to)));
}

std::optional<LoupeGap> gap_of_pair(const DrawingContext& context, const Loupe& loupe) {
  const PairLog& log = context.two_blocks();
  const TwoBlocks& blocks = log.blocks();
  if (!shows_face(context)) {
    if (!loupe.window) return std::nullopt;
    throw UsageError(
        kLoupeKey,
        fmt::format("the loupe enlarges the gap beside what is immovable, and the view does "
                    "not show its face; let view.x contain position {} and what is beside it, or "
                    "leave the loupe out",
                    to_text(blocks.side * blocks.wall_face)));
  }
  const double most_px = most_gap_px(context);
  LoupeGap gap{.anchor = blocks.wall_id,
               .outer = blocks.red_id,
               .between = blocks.blue_id,
               .side = blocks.side,
               .least_px = least_gap(log) * context.layout.scale,
               .window = span_of_window(loupe, log),
               .is_stage = loupe.is_stage};
  if (!gap.window && gap.least_px < most_px) return gap;
  if (!gap.window && !gap.is_stage) return std::nullopt;
  if (!gap.window) {
    throw UsageError(
        kLoupeKey,
        fmt::format(
            "the gap is never below {:.4g} pixels, and the loupe is seen below {:.4g}; use more "
            "digits, or leave the loupe out",
            gap.least_px, most_px));
  }
  const Span shown = shown_part(context, *gap.window);
  const double shown_px = least_gap(log, shown) * context.layout.scale;
  if (shown_px < most_px) return gap;
  throw UsageError(
      kLoupeKey,
      fmt::format("in its window from {} to {} the gap is never below "
                  "{:.4g} pixels, and the loupe is seen below {:.4g}; move the window to the turn, "
                  "use more digits, or leave the loupe out",
                  to_text(gap.window->from), to_text(gap.window->to), shown_px, most_px));
}

/// A wall keeps its place in the picture, else what is immovable, else the body on the left.
LoupeGap gap_between(const Collision& met, const System& system) {
  const auto is_wall = [&](std::size_t id) { return id >= system.bodies.size(); };
  const auto is_fixed = [&](std::size_t id) { return is_immovable(system, id); };
  LoupeGap gap{.anchor = met.first, .outer = met.second};
  const double way = met.second_after.position[0] - met.first_after.position[0];
  gap.side = way > 0 ? 1 : -1;
  if (is_fixed(gap.outer) || (!is_fixed(gap.anchor) && gap.side < 0)) {
    std::swap(gap.anchor, gap.outer);
    gap.side = -gap.side;
  }
  const double reach = to_double(system.bodies[gap.outer].size / 2);
  gap.meeting =
      (gap.outer == met.first ? met.first_after : met.second_after).position[0] - gap.side * reach;
  if (is_wall(gap.anchor)) {
    const Wall& wall = system.walls[gap.anchor - system.bodies.size()];
    if (is_moving(wall)) {
      throw UsageError(kLoupeKey, "does not follow a wall that moves; leave it out");
    }
    gap.face = to_double(wall.point[0]);
  }
  return gap;
}

/// @throws UsageError if no two bodies meet in the window, or where the view does not show it.
LoupeGap gap_of_bodies(const DrawingContext& context, const Loupe& loupe) {
  const Log& log = context.log;
  const Span window = span_of_window(loupe, log).value();
  if (loupe.window->zoom > kMaxZoomOfPositions) {
    throw UsageError(kLoupeKey, "enlarges these bodies at most 1e9 times; choose a smaller factor");
  }
  const Span shown = shown_part(context, window);
  const Integer first = log.first_since(shown.from);
  if (!log.has(first) || to_rational(log.collision_time(first)) > shown.to) {
    throw UsageError(
        kLoupeKey,
        fmt::format("no bodies meet in its window from {} to {}; move it to a collision, or "
                    "leave the loupe out",
                    to_text(shown.from), to_text(shown.to)));
  }
  const Collision met = log.collision(first);
  LoupeGap gap = gap_between(met, context.scene.system);
  gap.window = window;
  gap.least_px = most_gap_px(context);  // the gap closes; the window limits the zoom
  if (is_in_view(gap.meeting, context.scene.view)) return gap;
  throw UsageError(
      kLoupeKey,
      fmt::format("the first bodies that meet in its window from {} to {} do so at position "
                  "{:.4g}, which the view does not show; change view.x, or move the window",
                  to_text(shown.from), to_text(shown.to), gap.meeting));
}

std::optional<Loupe> loupe_of(const LayoutContext& context) {
  if (context.is_plane()) return std::nullopt;
  const Scene& scene = context.scene;
  Loupe loupe = scene.show.loupe.value_or(Loupe{.is_on = is_lecture(scene.view.theme)});
  // Only two blocks beside something immovable have a turn.
  if (!loupe.is_on || (!loupe.window && context.pair() == nullptr)) return std::nullopt;
  return loupe;
}

}  // namespace

MetPair LoupeGap::meeting_pair() const noexcept {
  const auto [low, high] = std::minmax({between.value_or(anchor), outer});
  return {static_cast<std::uint32_t>(low), static_cast<std::uint32_t>(high)};
}

Gaps LoupeGap::gaps_in(const FrameState& shown, const Layout& layout) const {
  if (between) return shown.gaps;
  const std::vector<Motion>& bodies = shown.state.bodies;
  const bool is_wall = anchor >= bodies.size();
  const double from = is_wall ? face : bodies[anchor].position[0];
  const double reach =
      layout.shapes[outer].width / 2 + (is_wall ? 0 : layout.shapes[anchor].width / 2);
  const double gap = std::max(0.0, side * (bodies[outer].position[0] - from) - reach);
  return {gap, gap};
}

std::optional<LoupeGap> loupe_gap(const DrawingContext& context) {
  const std::optional<Loupe> loupe = loupe_of(context);
  if (!loupe) return std::nullopt;
  return context.pair() != nullptr ? gap_of_pair(context, *loupe) : gap_of_bodies(context, *loupe);
}

bool may_show_loupe(const LayoutContext& context, const AxisPlace& axis) {
  if (!loupe_of(context)) return false;
  if (context.pair() == nullptr) return true;
  return shows_face(context) && least_gap(context.two_blocks()) * axis.scale < most_gap_px(context);
}

}  // namespace piblocks
