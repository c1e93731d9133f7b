#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "core/rounded.hpp"
#include "core/smooth_step.hpp"
#include "draw/panels/panels.hpp"
#include "draw/panels/unfolded_line.hpp"
#include "draw/panels/velocities.hpp"

namespace piblocks {
namespace {

// Of the moving items.
constexpr std::size_t kFirstArc = 2048;
constexpr std::size_t kFirstEnd = 4096;
constexpr std::size_t kFirstStrip = 8192;
constexpr std::size_t kFirstAxis = 12280;
constexpr std::size_t kFirstChord = 12288;
constexpr std::size_t kFirstDot = 20480;
constexpr std::size_t kPresentDot = 31999;

/// Width of the strips that a filled area grows by. Finished ones cost nothing.
constexpr double kStrip_px = 16;
constexpr int kStepsInStrip = 8;

// Seconds of video at which the ellipse begins to become a circle, and is one.
constexpr double kMorphBegin_s = 4;
constexpr double kMorphEnd_s = 5.5;

constexpr double kAxisReach_em = 0.4;  ///< beyond the circle
/// Chords on one side are at least so many data lines apart.
constexpr double kChordsApart = 3;
/// Radius of the dots of hits, at most, in parts of the length between two of them.
constexpr double kDotsApart = 0.3;
/// A narrower wedge cannot be seen.
constexpr double kLeastWedge_px = 0.5;
// Widths of lines, in those of the grid.
constexpr double kOutline = 1.5;
constexpr double kArcLine = 1.2;

/// From angles of the circle to places on it, or on the ellipse that it is before velocities are
/// scaled by the roots of the masses.
struct VelocityMap {
  Point centre;
  // Semi-axes in pixels.
  double red = 0;
  double blue = 0;

  Point at(double angle) const {
    const auto [sine, cosine] = rounded::sin_cos(angle);
    return at(Point{cosine, sine});
  }
  Point at(const Point& unit) const { return {centre.x + red * unit.x, centre.y - blue * unit.y}; }
};

/// Log of the drawn ellipse's axes, blue's over red's: the root of the mass ratio, within limits.
double log_axes_of(const TwoBlocks& system) {
  return rounded::log(to_double(drawn_mass_ratio(system))) / 2;
}

/// Of a label's color. One part fades out before the other fades in.
double strength(VelocityPart part, double share) {
  constexpr double kArcsFrom = 0.9;
  const double visible = part == VelocityPart::ellipse ? 1 - 2 * share
                         : part == VelocityPart::arcs  ? (share - kArcsFrom) / (1 - kArcsFrom)
                                                       : 2 * share - 1;
  return std::clamp(visible, 0.0, 1.0);
}

/// From one angle of the circle to another.
std::vector<Point> curve(const VelocityMap& map, double from, double to) {
  std::vector<Point> points;
  for (const Point& point : Circle{{0, 0}, 1}.arc(from, to)) {
    points.push_back(map.at(Point{point.x, -point.y}));
  }
  return points;
}

/// The diagram without its chords: axes and their names, the curve, an arc, the end.
class VelocityFigure {
 public:
  /// @param context, diagram  not kept
  VelocityFigure(const DrawingContext& context, const Diagram& diagram, VelocityPoints points)
      : points_(std::move(points)),
        palette_(context.palette),
        grid_px_(context.sizes.grid_line),
        log_axes_(log_axes_of(context.two_blocks().blocks())),
        place_(place_velocities(diagram, context.setter())) {
    const double apart_px = 2 * points_.wedge_angle() * place_.circle.radius;
    const bool has_chords = points_.moves() && apart_px >= kChordsApart * context.sizes.data_line;
    if (has_chords) angles_ = points_.all_angles();
    dot_px_ = std::min(style::kHitDot * context.sizes.short_side, kDotsApart * apart_px);
    written_ = label_velocities(context, place_, points_, angles_);
  }

  /// @param share  of the way from the ellipse, 0, to the circle, 1; the map that multiplies each
  ///               velocity by its mass to the power of share / 2
  VelocityMap map(double share) const {
    const auto& [centre, radius] = place_.circle;
    const double shorter = radius * rounded::exp(-std::abs(log_axes_) * (1 - share));
    return log_axes_ > 0 ? VelocityMap{centre, shorter, radius}
                         : VelocityMap{centre, radius, shorter};
  }

  /// Whether chords are so far apart that each is drawn.
  bool has_chords() const noexcept { return !angles_.empty(); }
  /// As all_angles(); none unless has_chords().
  const std::vector<double>& angles() const noexcept { return angles_; }
  double dot_px() const noexcept { return dot_px_; }

  /// What is always there, from back to front. @param first  the first of their ids
  std::vector<DrawItem> items(double share, ItemId first) const {
    std::vector<DrawItem> items;
    const auto add = [&](std::vector<Point> points, const Color& color, double width, bool closed) {
      items.emplace_back(PathItem{nth(first, items.size()), std::move(points), closed, std::nullopt,
                                  Stroke{color, width * grid_px_}});
    };
    for (std::vector<Point>& axis : axes()) add(std::move(axis), palette_.grid, 1, false);
    if (points_.moves()) {
      std::vector<Point> outline = curve(map(share), 0, 2 * std::numbers::pi);
      outline.pop_back();
      add(std::move(outline), palette_.muted, kOutline, true);
    }
    add_labels(VelocityPart::ellipse, share, first, items);
    add_labels(VelocityPart::circle, share, first, items);
    return items;
  }

  /// What arc_from() collisions have cut off.
  std::vector<DrawItem> arc_items(double share, ItemId first) const {
    std::vector<DrawItem> items;
    const double visible = strength(VelocityPart::arcs, share);
    if (visible == 0 || written_.arc.empty()) return items;
    const Stroke stroke{faded(palette_.text, visible), kArcLine * grid_px_};
    items.emplace_back(line_item(first, written_.arc, stroke));
    add_labels(VelocityPart::arcs, share, first, items);
    return items;
  }

  std::size_t arc_from() const noexcept { return written_.arc_from; }

  /// The velocities after which nothing collides.
  std::vector<DrawItem> end_items(double share, ItemId first) const {
    std::vector<DrawItem> items;
    const double theta = points_.wedge_angle();
    const double visible = strength(VelocityPart::end, share);
    if (visible == 0 || !points_.moves()) return items;
    if (theta * place_.circle.radius >= kLeastWedge_px) {
      std::vector<Point> wedge = curve(map(share), 0, theta);
      wedge.push_back(place_.circle.centre);
      items.emplace_back(PathItem{first, std::move(wedge), true,
                                  faded(palette_.done, style::kWedgeFill * visible)});
    }
    add_labels(VelocityPart::end, share, first, items);
    return items;
  }

  /// Both axes, through the centre.
  std::array<std::vector<Point>, 2> axes() const {
    const auto& [centre, radius] = place_.circle;
    const double reach = radius + kAxisReach_em * place_.em;
    return {{{{centre.x - reach, centre.y}, {centre.x + reach, centre.y}},
             {{centre.x, centre.y - reach}, {centre.x, centre.y + reach}}}};
  }

 private:
  void add_labels(VelocityPart part, double share, ItemId first,
                  std::vector<DrawItem>& items) const {
    const double visible = strength(part, share);
    if (visible == 0) return;
    for (const VelocityLabel& label : written_.labels) {
      if (label.part != part) continue;
      label.formula.add_to(items, nth(first, items.size()), label.at, place_.em,
                           faded(label.color, visible));
    }
  }

  VelocityPoints points_;
  Palette palette_;
  double grid_px_;
  double log_axes_;  ///< of the ellipse's drawn semi-axes, blue over red
  VelocityPlace place_;
  double dot_px_ = 0;
  std::vector<double> angles_;
  VelocityLabels written_;
};

/// How much of the way to the circle is done.
double morphed_share(double video_s) {
  return smooth_step(
      std::clamp((video_s - kMorphBegin_s) / (kMorphEnd_s - kMorphBegin_s), 0.0, 1.0));
}

/// @param has_chords  that can be told apart
PhasedTitle::Sentences sentences(const DrawingContext& context, bool has_chords) {
  const FormulaSetter set = context.setter();
  const Formula arc = set.text("2") + set.italic("θ");
  const Formula brief = set.text("Each hit cuts off an arc of ") + arc;
  PhasedTitle::Sentences all{
      .before = set.texts({"Energy keeps the speeds on this curve", "Speeds on a curve"}),
      .during = {brief, set.text("Each hit: an arc of ") + arc}};
  if (!has_chords) {
    all.during.insert(all.during.begin(), brief + set.text(", too small to see"));
  }
  all.after = all.during;
  const std::optional<Formula> ratio = half_turn_ratio(context);
  if (!ratio) return all;
  all.after.insert(all.after.begin(), {set.text("2π ÷ ") + arc + set.text(" = ") + *ratio, *ratio});
  return all;
}

/// The velocities are a point on a circle, and each collision moves it along a chord. Chords too
/// close to be told apart become the area that they cover.
class VelocityPanel {
 public:
  VelocityPanel(const DrawingContext& context, const PanelPlace& place)
      : diagram_(context, place),
        blocks_(context.two_blocks().blocks()),
        points_(context.scene, context.two_blocks()),
        figure_(context, diagram_, points_),
        title_(diagram_, sentences(context, figure_.has_chords()), points_.before(),
               points_.last()),
        is_ellipse_first_(place.panel == Panel::ellipse) {
    diagram_.finish();
    circle_ = with_plate(figure_items(1));
    if (is_ellipse_first_) ellipse_ = with_plate(figure_items(0));
  }

  void operator()(const FrameState& shown, std::vector<DrawItem>& items) const {
    const double share = is_ellipse_first_ ? morphed_share(shown.video_s) : 1;
    const PairState state = blocks_state(shown.state, blocks_);
    if (share == 1) {
      add(circle_, 1, state, items);
    } else if (share == 0) {
      add(ellipse_, 0, state, items);
    } else {
      add(figure_items(share), share, state, items);
    }
  }

 private:
  /// All that depends on the share of the way from ellipse to circle alone.
  struct FigureItems {
    std::vector<DrawItem> static_items;
    std::vector<DrawItem> arc;
    std::vector<DrawItem> end;
    std::vector<PathItem> chords = {};  ///< of each collision
    std::vector<DiscItem> dots = {};    ///< of each velocity
  };

  FigureItems figure_items(double share) const {
    FigureItems all{.static_items = {diagram_.item()},
                    .arc = figure_.arc_items(share, diagram_.moving(kFirstArc)),
                    .end = figure_.end_items(share, diagram_.moving(kFirstEnd))};
    std::ranges::move(figure_.items(share, diagram_.moving(0)),
                      std::back_inserter(all.static_items));
    const VelocityMap map = figure_.map(share);
    const std::vector<double>& angles = figure_.angles();
    for (std::size_t i = 0; i < angles.size(); ++i) {
      all.dots.push_back({diagram_.moving(kFirstDot + i), map.at(angles[i]), figure_.dot_px(),
                          diagram_.palette().text});
      if (i == 0) continue;
      all.chords.push_back(chord(kFirstChord + i, map, angles[i - 1], angles[i],
                                 points_.kind_of(points_.before() + static_cast<long>(i))));
    }
    return all;
  }

  /// Title and figure as one item.
  FigureItems with_plate(FigureItems all) const {
    std::vector<DrawItem> parts = diagram_.item().plate->items;
    parts.insert(parts.end(), all.static_items.begin() + 1, all.static_items.end());
    all.static_items = {diagram_.plate(0, std::move(parts))};
    return all;
  }

  PathItem chord(std::size_t n, const VelocityMap& map, double from, double to,
                 CollisionKind kind) const {
    const Palette& palette = diagram_.palette();
    const Color& color = kind == CollisionKind::wall ? palette.blue.line : palette.red.line;
    return line_item(diagram_.moving(n), {map.at(from), map.at(to)},
                     {color, diagram_.sizes().data_line});
  }

  void add(const FigureItems& parts, double share, const PairState& state,
           std::vector<DrawItem>& items) const {
    const auto append = [&](const std::vector<DrawItem>& more) {
      items.insert(items.end(), more.begin(), more.end());
    };
    append(parts.static_items);
    if (state.count >= points_.before() + static_cast<long>(figure_.arc_from())) append(parts.arc);
    if (state.count >= points_.last()) append(parts.end);
    const VelocityMap map = figure_.map(share);
    const Point velocity =
        points_.moves() ? points_.point_of(state.blue.velocity, state.red.velocity) : Point{};
    const Integer reached =
        std::clamp<Integer>(state.count, points_.before(), points_.last()) - points_.before();
    if (figure_.has_chords()) {
      const auto count = static_cast<std::ptrdiff_t>(reached.get_si());
      items.insert(items.end(), parts.chords.begin(), parts.chords.begin() + count);
      items.insert(items.end(), parts.dots.begin(), parts.dots.begin() + count + 1);
    } else if (reached > 0) {
      add_area(map, rounded::atan2(velocity.y, velocity.x), reached, items);
    }
    items.emplace_back(diagram_.present_dot(kPresentDot, map.at(velocity)));
    title_.add(state.count, items);
  }

  /// The chords so far cover what is between the first velocity and the last chord.
  void add_area(const VelocityMap& map, double angle, const Integer& reached,
                std::vector<DrawItem>& items) const {
    const CollisionKind kind = points_.kind_of(points_.before() + reached);
    const CollisionKind other =
        kind == CollisionKind::wall ? CollisionKind::blocks : CollisionKind::wall;
    const double before = points_.reflected(angle, kind);
    add_strips(map, {std::max(angle, before), -std::min(angle, before)}, items);
    std::size_t n = kFirstAxis;
    for (std::vector<Point>& axis : figure_.axes()) {
      items.emplace_back(diagram_.moving_line(n++, std::move(axis), diagram_.palette().muted));
    }
    // Blue's in front, so that they do not change places where they are one line.
    std::vector<PathItem> newest{chord(kFirstChord + 1, map, before, angle, kind)};
    if (reached > 1) {
      newest.push_back(
          chord(kFirstChord + 1, map, points_.reflected(before, other), before, other));
    }
    if (kind == CollisionKind::wall) std::ranges::reverse(newest);
    for (std::size_t i = 0; i < newest.size(); ++i) {
      newest[i].id = diagram_.moving(kFirstChord + i);
      items.emplace_back(std::move(newest[i]));
    }
  }

  /// Where the last chord ends, above the axis and below it, from the right.
  struct Edge {
    double above;
    double below;
  };

  void add_strips(const VelocityMap& map, const Edge& edge, std::vector<DrawItem>& items) const {
    const auto angle_at = [&](double x) {
      const double cosine = std::clamp((x - map.centre.x) / map.red, -1.0, 1.0);
      return rounded::atan2(std::sqrt((1 - cosine) * (1 + cosine)), cosine);
    };
    const double start = std::abs(std::remainder(points_.start_angle(), 2 * std::numbers::pi));
    const double least = std::min(map.at(edge.above).x, map.at(edge.below).x);
    double from = start;
    double x = map.at(start).x;
    for (std::size_t n = kFirstStrip;; ++n) {
      // Strips meet at whole pixels, so that no line is seen between them.
      x = (std::floor(x / kStrip_px) + 1) * kStrip_px;
      const bool is_last = x >= least;
      const double to = angle_at(x);
      const Edge end = is_last ? edge : Edge{to, to};
      items.emplace_back(diagram_.moving_shape(n, strip(map, from, end), diagram_.palette().shade));
      if (is_last) return;
      from = to;
    }
  }

  static std::vector<Point> strip(const VelocityMap& map, double from, const Edge& end) {
    std::vector<Point> points;
    const auto add = [&](double begin, double step, int i) {
      points.push_back(map.at(begin + step * i));
    };
    for (int i = 0; i <= kStepsInStrip; ++i) add(from, (end.above - from) / kStepsInStrip, i);
    for (int i = 0; i <= kStepsInStrip; ++i) add(-end.below, (end.below - from) / kStepsInStrip, i);
    return points;
  }

  Diagram diagram_;
  TwoBlocks blocks_;
  VelocityPoints points_;
  VelocityFigure figure_;
  PhasedTitle title_;
  bool is_ellipse_first_;
  FigureItems circle_;
  FigureItems ellipse_;
};

}  // namespace

Drawable velocity_panel(const DrawingContext& context, const PanelPlace& place) {
  return {VelocityPanel(context, place), {.video_s = place.panel == Panel::ellipse}};
}

}  // namespace piblocks
