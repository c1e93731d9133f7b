#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "core/rounded.hpp"
#include "draw/number_text.hpp"
#include "draw/stage/stage.hpp"
#include "scene/schedule.hpp"

namespace piblocks {
namespace {

/// A block is higher by this for every factor of ten in mass, in heights of the lightest.
constexpr double kHeightByMass = 0.25;
/// Below a loupe that is as wide as most of the frame blocks are a strip, so high at most, in
/// fractions of the frame's shorter side.
constexpr double kStrip = 0.2;
/// More bodies have no labels, masses or arrows, nor are more drawn at all.
constexpr std::size_t kMostMarked = 10'000;
constexpr std::size_t kMostDrawn = 50'000;

/// @throws UsageError unless the view shows some of what is between the walls.
void check_is_between(const LineWalls& walls, const Range& seen, const View& view) {
  if (seen.high > seen.low) return;
  if (walls.left && view.x.high <= *walls.left) {
    throw UsageError(
        "view.x",
        fmt::format(
            "ends at {}, and the wall's face is at {}; raise its upper end, or move the wall",
            to_text(seen.high), to_text(*walls.left)));
  }
  throw UsageError(
      "view.x",
      fmt::format(
          "begins at {}, and the wall's face is at {}; lower its lower end, or move the wall",
          to_text(seen.low), to_text(seen.high)));
}

/// The heights of blocks, in those of the lightest one.
std::vector<double> height_ratios(const System& system, const Rational& least_mass) {
  std::vector<double> ratios;
  ratios.reserve(system.bodies.size());
  for (const Body& body : system.bodies) {
    ratios.push_back(style::kMaxHeightRatio);
    if (!body.mass) continue;
    const Magnitude ratio = magnitude_of(*body.mass / least_mass);
    const double logarithm = rounded::log10(ratio.mantissa) + double(ratio.exponent);
    ratios.back() = std::min(style::kMaxHeightRatio, 1 + kHeightByMass * logarithm);
  }
  return ratios;
}

/// The lightest block is a square, and others are higher by their mass.
void set_blocks(const System& system, Layout& layout) {
  const Body* lightest = nullptr;
  for (const Body& body : system.bodies) {
    if (body.mass && (lightest == nullptr || *body.mass < *lightest->mass)) lightest = &body;
  }
  if (lightest == nullptr) lightest = &system.bodies.front();
  const double side = to_double(lightest->size) * layout.scale;
  const std::vector<double> ratios = height_ratios(system, lightest->mass.value_or(1));
  for (std::size_t i = 0; i < ratios.size(); ++i) {
    layout.shapes.push_back({to_double(system.bodies[i].size), side * ratios[i]});
  }
}

/// Makes all blocks lower until the tallest one has room. @throws UsageError if there is too little
void fit_heights(double room_px, const View& view, Layout& layout) {
  if (room_px < kLeastHeight * Sizes(view).short_side) {
    throw UsageError(
        "show",
        fmt::format(
            "the blocks would be {:.0f} pixels high in {}x{}; leave something out, or make the "
            "frame larger",
            std::max(0.0, room_px), view.width_px, view.height_px));
  }
  const double shrink = std::min(1.0, room_px / (layout.floor_px - layout.top_px()));
  for (BlockShape& block : layout.shapes) {
    block.height_px = std::max(1.0, std::floor(block.height_px * shrink));
  }
}

Layout lay_out_line(const LayoutContext& context, const FramePlan& plan) {
  const View& view = context.scene.view;
  const Sizes& sizes = context.sizes;
  const Rect& area = plan.stage;
  Layout layout;
  layout.content_right_px = area.right() - sizes.margin;
  layout.visible_right_px = plan.axis.visible_right_px;
  layout.line_px = std::max(1.0, std::round(sizes.data_line));
  layout.corner_px = sizes.corner;
  layout.scale = plan.axis.scale;

  set_blocks(context.scene.system, layout);
  const std::optional<Loupe>& loupe = context.scene.show.loupe;
  const bool is_strip = loupe && loupe->is_stage;
  double above = 0;
  double below = 0;
  double room = 0;
  do {
    above = room_above_px(context, layout);
    below = std::max(kFloorHatch.width * sizes.short_side,
                     sizes.wall_line + room_below_px(context, layout));
    room = area.height - below - std::max(kWallAbove * sizes.short_side, above);
    if (is_strip) room = std::min(room, kStrip * sizes.short_side);
    fit_heights(room, view, layout);
    // If a block is now too low for its label, that moves above or below it and needs room there.
  } while (room_above_px(context, layout) > above ||
           sizes.wall_line + room_below_px(context, layout) > below);
  // What is left over is above and below in equal parts.
  double rest = plan.is_floor_at_bottom ? 0 : (room - (layout.floor_px - layout.top_px())) / 2;
  if (is_strip) rest = std::max(0.0, area.bottom() - below - (view.height_px - sizes.margin));
  layout.floor_px = std::floor(area.bottom() - below - rest);
  layout.origin = {plan.axis.origin_px, layout.floor_px};
  layout.above_px = layout.top_px() - area.y;
  layout.below_px = area.bottom() - layout.floor_px;
  layout.wall_bottom_px = layout.floor_px + sizes.wall_line;
  return layout;
}

void check_radius(double radius_px, const System& system, std::size_t body) {
  constexpr double kMost_px = 0.9 * kFar_px;  // with its line, and far from the picture
  if (radius_px <= kMost_px) return;
  throw UsageError(
      body_key(system, body) + ".radius",
      fmt::format("is {:.4g} pixels, and at most {:.2g} can be painted; make it smaller, show more "
                  "of the plane, or use a wall",
                  radius_px, kMost_px));
}

Layout lay_out_plane(const LayoutContext& context, const Rect& area) {
  const View& view = context.scene.view;
  const Sizes& sizes = context.sizes;
  const System& system = context.scene.system;
  Layout layout;
  layout.line_px = std::max(1.0, std::round(sizes.data_line));
  const double left = std::ceil(area.x);
  const double top = std::ceil(area.y);
  layout.window = {left, top, std::floor(area.right()) - left, std::floor(area.bottom()) - top};
  const double wall = system.walls.empty() ? 0 : style::kWallWidth * sizes.short_side;
  const double margin = std::max(wall, sizes.margin / 2);
  const double width = layout.window.width - 2 * margin;
  const double height = layout.window.height - 2 * margin;
  if (std::min(width, height) < kLeastHeight * sizes.short_side) {
    throw UsageError(
        "show",
        fmt::format(
            "there is too little room for the bodies in {}x{}; leave something out, or make the "
            "frame larger",
            view.width_px, view.height_px));
  }
  layout.scale = std::min(width / to_double(view.x.high - view.x.low),
                          height / to_double(view.y.high - view.y.low));
  check_resolution(view.x, "view.x", layout.scale);
  check_resolution(view.y, "view.y", layout.scale);
  layout.origin = {
      std::round(layout.window.width / 2 - to_double(view.x.high + view.x.low) / 2 * layout.scale),
      std::round(layout.window.height / 2 +
                 to_double(view.y.high + view.y.low) / 2 * layout.scale)};
  for (std::size_t i = 0; i < system.bodies.size(); ++i) {
    // One whose path is shown is seen, however small it is.
    const double least_px =
        context.scene.styles[i].path ? style::kPresentDot * sizes.short_side : 0;
    const double radius_px = std::max(least_px, to_double(system.bodies[i].size) * layout.scale);
    layout.shapes.push_back({2 * radius_px / layout.scale, 2 * radius_px});
    check_radius(radius_px, system, i);
  }
  return layout;
}

void check_number(const LayoutContext& context) {
  const std::size_t count = context.scene.system.bodies.size();
  const bool is_marked = context.scene.show.has(Overlay::velocities) || has_labels(context);
  const std::size_t most = is_marked ? kMostMarked : kMostDrawn;
  if (count <= most) return;
  throw UsageError("body",
                   fmt::format("{} of them cannot be drawn{}; use at most {}", count,
                               is_marked ? " with labels, masses or velocities" : "", most));
}

}  // namespace

Rational twice_energy(const System& system) {
  Rational sum = 0;
  for (const Body& body : system.bodies) {
    const auto& [x, y] = body.velocity;
    if (body.mass) sum += *body.mass * (x * x + y * y);
  }
  return sum;
}

mpf_class twice_energy(const std::vector<mpf_class>& masses, const State& state) {
  mpf_class sum = 0;
  for (std::size_t i = 0; i < masses.size(); ++i) {
    const auto& [x, y] = state.bodies[i].velocity;
    sum += masses[i] * (mpf_class(x) * x + mpf_class(y) * y);
  }
  return sum;
}

std::vector<mpf_class> masses_or_zero(const System& system) {
  std::vector<mpf_class> masses;
  for (const Body& body : system.bodies) masses.emplace_back(body.mass.value_or(0));
  return masses;
}

Rational most_twice_energy(const Scene& scene, const Log& log) {
  Rational most = twice_energy(scene.system);
  if (!is_driven(scene.system) || !has_span(scene, log)) return most;
  const Span span = span_of(scene, log);
  const std::vector<mpf_class> masses = masses_or_zero(scene.system);
  constexpr int kInstants = 64;
  for (int i = 0; i <= kInstants; ++i) {
    const Rational time = span.from + (span.to - span.from) * i / kInstants;
    const State state = log.state_at(std::max<Rational>(time, 0));
    most = std::max(most, Rational(twice_energy(masses, state)));
  }
  return most;
}

Rational heaviest_mass(const System& system) {
  Rational most = 0;
  for (const Body& body : system.bodies) most = std::max(most, body.mass.value_or(0));
  return most;
}

void check_resolution(const Range& range, const char* key, double scale) {
  const double farthest = std::max(std::abs(to_double(range.low)), std::abs(to_double(range.high)));
  const double step_px = farthest * std::numeric_limits<double>::epsilon() * scale;
  if (step_px <= kMostStep_px) return;
  throw UsageError(
      key,
      fmt::format("so far from 0 positions are {:.1e} apart, which would be {:.1f} pixels; show "
                  "more of the axis, or move walls, bodies and view towards 0",
                  step_px / scale, step_px));
}

AxisPlace place_axis(const LayoutContext& context, double stage_width_px) {
  const View& view = context.scene.view;
  const Sizes& sizes = context.sizes;
  const LineWalls all = line_walls(context.scene.system);
  const LineWalls seen = seen_walls(context.scene.system, view);
  const Range range = seen_axis(context.scene.system, view);
  check_is_between(all, range, view);
  const double beside_wall = sizes.margin + style::kWallWidth * sizes.short_side;
  const double opposite = seen.left || seen.right ? sizes.margin : 0;
  double left_px = seen.left ? beside_wall : opposite;
  const double right_px = stage_width_px - (seen.right ? beside_wall : opposite);
  double scale = (right_px - left_px) / to_double(range.high - range.low);
  if (scale >= kLeastRounded_px) {
    scale = 2 * std::floor(scale / 2);
    left_px = std::round(left_px);
  }
  check_resolution(view.x, "view.x", scale);
  const bool is_whole = stage_width_px >= view.width_px;
  return {left_px - to_double(range.low) * scale, scale,
          is_whole ? view.width_px : std::floor(stage_width_px - sizes.margin)};
}

double reach_px(const LayoutContext& context, const AxisPlace& axis) {
  const Scene& scene = context.scene;
  const PairLog* const log = context.pair();
  if (log == nullptr || log->blocks().side < 0) return HUGE_VAL;
  if (!has_span(scene, *log)) return scene.view.width_px;
  const Span span = span_of(scene, *log);
  // Red comes nearer and nearer, and then goes farther and farther away.
  const double farthest =
      std::max(log->blocks_at(span.from).red.position, log->blocks_at(span.to).red.position);
  return axis.origin_px + (farthest + to_double(log->blocks().red.width) / 2) * axis.scale;
}

Layout lay_out_stage(const LayoutContext& context, const FramePlan& plan) {
  check_number(context);
  return context.is_plane() ? lay_out_plane(context, plan.stage) : lay_out_line(context, plan);
}

std::vector<Rect> panel_grid(std::size_t count, const Rect& area, double gap, double em) {
  // A narrower one may have no room for its title.
  constexpr double kTitledPanel_em = 10;
  // The width of a diagram that looks best, in parts of its height.
  constexpr double kPanelAspect = 1.6;
  const auto side = [gap](double length, std::size_t n) {
    return (length - gap * double(n - 1)) / double(n);
  };
  const auto cell = [&](std::size_t columns) {
    const std::size_t rows = (count + columns - 1) / columns;
    return Rect{0, 0, side(area.width, columns), side(area.height, rows)};
  };
  const auto size = [em](const Rect& r) {
    return std::tuple(std::min(r.width, r.height) >= kLeastPanel_em * em,
                      r.width >= kTitledPanel_em * em, std::min(r.width / kPanelAspect, r.height));
  };
  std::size_t best = 1;
  for (std::size_t columns = 2; columns <= count; ++columns) {
    if (size(cell(columns)) > size(cell(best))) best = columns;
  }
  std::vector<Rect> cells(count, cell(best));
  for (std::size_t i = 0; i < count; ++i) {
    Rect& place = cells[i];
    const std::size_t row = i / best;
    // A last row that is not full is centred.
    const std::size_t in_row = std::min(best, count - row * best);
    const double shift = double(best - in_row) * (place.width + gap) / 2;
    place.x = area.x + shift + double(i % best) * (place.width + gap);
    place.y = area.y + double(row) * (place.height + gap);
  }
  return cells;
}

}  // namespace piblocks
