#include "draw/panels/velocities.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "core/rounded.hpp"
#include "draw/panels/trajectory.hpp"
#include "draw/panels/unfolded_line.hpp"

namespace piblocks {
namespace {

// In ems.
constexpr double kAboveCircle = 1.05;
constexpr double kBelowCircle = 0.35;
constexpr double kBesideCircle = 0.35;
constexpr double kBesideAxis = 0.4;  ///< from an axis to its name
constexpr double kToLabel = 0.75;    ///< from the circle to what is written beside it
constexpr double kEndAbove = 0.9;    ///< the end's words above the horizontal axis
constexpr double kWordsStep = 1.25;  ///< from one line to the next
constexpr double kToArc = 0.24;      ///< from the circle to the arc outside of it
constexpr double kArcEnd = 0.12;
constexpr double kToArcName = 0.18;
constexpr double kHalfHeight = 0.4;  ///< of figures
constexpr double kMiddle = 0.3;      ///< of letters, above the baseline
constexpr double kLabelTop = 0.86;
constexpr double kLabelBottom = 0.25;
constexpr double kAround_em = 0.1;

/// The circle's diameter is at least this part of the room's shorter side.
constexpr double kLeastDiameter = 0.76;
/// In a panel so many times as wide as what it shows, this is in the middle.
constexpr double kWide = 1.6;
/// Where the arc is, if there is room.
constexpr double kArcAngle = -2.4;
/// Where the words begin, below the circle's centre, in radii.
constexpr double kWordsBelow = 0.62;

Formula velocity_name(const FormulaSetter& set, const char* index) {
  return set.lowered(set.italic("v"), set.text(index));
}

Formula scaled_name(const FormulaSetter& set, const char* index) {
  return set.root(set.lowered(set.italic("m"), set.text(index))) + velocity_name(set, index);
}

Formula arc_name(const FormulaSetter& set) { return set.text("2") + set.italic("θ"); }

Formula end_words(const FormulaSetter& set) { return set.text("no more hits here"); }

/// Twice the kinetic energy of a block.
Formula energy_name(const FormulaSetter& set, const char* index) {
  return set.lowered(set.italic("m"), set.text(index)) +
         set.raised(velocity_name(set, index), set.text("2"));
}

double widest_em(const std::vector<Formula>& lines) {
  double widest = 0;
  for (const Formula& line : lines) widest = std::max(widest, line.width_em());
  return widest;
}

/// Takes room for one label after the other.
class VelocityLabeller {
 public:
  VelocityLabeller(const DrawingContext& context, const VelocityPlace& place,
                   const VelocityPoints& points)
      : context_(context),
        palette_(context.palette),
        set_(context.setter()),
        inside_(place.inside),
        circle_(place.circle),
        em_(place.em),
        points_(points) {}

  VelocityLabels run(const TwoBlocks& system, const std::vector<double>& angles) {
    add_axis_names();
    if (!points_.moves()) return std::move(made_);
    add_end();
    const std::vector<Rect> around_circle = taken_;
    add_energy(drawn_mass_ratio(system) == system.red.mass / system.blue.mass);
    taken_ = around_circle;
    add_arc(angles);
    add_angle();
    return std::move(made_);
  }

 private:
  /// Whether a box is beside the circle, and beside all that is written.
  bool is_free(const Rect& box) const {
    if (!inside_.holds(box)) return false;
    const auto& [centre, radius] = circle_;
    const Point nearest{std::clamp(centre.x, box.x, box.right()),
                        std::clamp(centre.y, box.y, box.bottom())};
    const double slack = kAround_em * em_;
    if (length(nearest - centre) < radius + slack) return false;
    const Rect wide = box.grown(slack, 0);
    return std::ranges::none_of(taken_, [&](const Rect& other) { return wide.meets(other); });
  }
  bool is_free(const Formula& formula, const Point& at) const {
    return is_free(box_of(formula, at));
  }
  void take(const Formula& formula, const Point& at) { taken_.push_back(box_of(formula, at)); }
  Rect box_of(const Formula& formula, const Point& at) const {
    return {at.x, at.y - kLabelTop * em_, formula.width_em() * em_,
            (kLabelTop + kLabelBottom) * em_};
  }

  double bottom() const { return inside_.bottom() - kLabelBottom * em_; }
  double beside_circle() const { return circle_.centre.x + circle_.radius + kToLabel * em_; }
  /// Where a text begins that ends at the right border.
  double at_right(const Formula& formula) const {
    return inside_.right() - formula.width_em() * em_;
  }

  void add_axis_names() {
    const auto add = [&](const char* index, const Point& at, const Color& color) {
      const Formula scaled = scaled_name(set_, index);
      made_.labels.push_back({scaled, at, color, VelocityPart::circle});
      made_.labels.push_back({velocity_name(set_, index), at, color, VelocityPart::ellipse});
      take(scaled, at);
    };
    const auto& [centre, radius] = circle_;
    add("1", {centre.x + kBesideAxis * em_, centre.y - radius - kBesideAxis * em_},
        palette_.blue.label);
    const Formula name = scaled_name(set_, "2");
    for (const Point& at :
         {Point{beside_circle(), centre.y + kMiddle * em_}, Point{at_right(name), bottom()}}) {
      if (!is_free(name, at)) continue;
      add("2", at, palette_.red.label);
      return;
    }
  }

  /// Beside the wedge of the velocities after which nothing collides.
  void add_end() {
    const Formula words = end_words(set_);
    const auto& [centre, radius] = circle_;
    const double middle = points_.wedge_angle() / 2;
    const double baseline = std::min(centre.y - radius * rounded::sin(middle) + kMiddle * em_,
                                     centre.y - kEndAbove * em_);
    for (const Point& at :
         {Point{circle_.at(middle).x + kToLabel * em_, baseline}, Point{beside_circle(), baseline},
          Point{at_right(words), centre.y - radius}, Point{at_right(words), bottom()}}) {
      if (!is_free(words, at)) continue;
      take(words, at);
      made_.labels.push_back({words, at, palette_.done, VelocityPart::end});
      return;
    }
  }

  /// An arc outside of the circle, its ends bent towards two of its points.
  std::vector<Point> arc_outside(double from, double to) const {
    const Circle outer{circle_.centre, circle_.radius + kToArc * em_};
    const Circle ends{circle_.centre, outer.radius - kArcEnd * em_};
    std::vector<Point> points{ends.at(from)};
    for (const Point& point : outer.arc(from, to)) points.push_back(point);
    points.push_back(ends.at(to));
    return points;
  }

  /// Every second point is on the same side of the axis: two of them are 2 theta apart.
  void add_arc(const std::vector<double>& angles) {
    const Formula name = arc_name(set_);
    const double theta = points_.wedge_angle();
    struct Arc {
      double middle;
      std::size_t from;
    };
    std::vector<Arc> arcs;
    for (std::size_t i = 2; i < angles.size(); ++i) {
      const double middle = angles[i] + (angles[i] > angles[i - 2] ? -theta : theta);
      arcs.push_back({std::remainder(middle, 2 * std::numbers::pi), i});
    }
    std::ranges::sort(arcs, {}, [](const Arc& arc) { return std::abs(arc.middle - kArcAngle); });
    const double half_em = name.width_em() / 2;
    for (const auto& [middle, from] : arcs) {
      std::vector<Point> arc = arc_outside(middle - theta, middle + theta);
      const double away_em = kToArc + kToArcName + std::abs(rounded::cos(middle)) * half_em +
                             std::abs(rounded::sin(middle)) * kHalfHeight;
      const Point centre = Circle{circle_.centre, circle_.radius + away_em * em_}.at(middle);
      const Point at{centre.x - half_em * em_, centre.y + kMiddle * em_};
      const bool fits = std::ranges::all_of(arc, [&](const Point& point) {
        return is_free({point.x, point.y, 0, 0});
      });
      if (!fits || !is_free(name, at)) continue;
      take(name, at);
      made_.arc = std::move(arc);
      made_.arc_from = from;
      made_.labels.push_back({name, at, palette_.text, VelocityPart::arcs});
      return;
    }
  }

  /// What θ is, unless another diagram says so.
  void add_angle() {
    const std::vector<Panel>& panels = context_.scene.show.panels;
    const bool is_said = std::ranges::count(panels, Panel::unfolded) > 0 ||
                         std::ranges::count(panels, Panel::mirrors) > 0;
    if (is_said || !half_turn_ratio(context_)) return;
    const Formula note = angle_note(context_);
    const auto& [centre, radius] = circle_;
    const Point below{centre.x - note.width_em() * em_ / 2, centre.y + radius + kWordsStep * em_};
    for (const Point& at :
         {Point{beside_circle(), std::min(centre.y + kWordsBelow * radius, bottom())}, below,
          Point{at_right(note), bottom()}}) {
      if (!is_free(note, at)) continue;
      made_.labels.push_back({note, at, palette_.muted, VelocityPart::circle});
      return;
    }
  }

  /// Why it is an ellipse.
  void add_energy(bool is_to_scale) {
    const auto label = [](Formula formula, const Color& color) {
      return VelocityLabel{std::move(formula), {}, color, VelocityPart::ellipse};
    };
    const std::array terms = {label(energy_name(set_, "1"), palette_.blue.label),
                              label(set_.text(" + "), palette_.muted),
                              label(energy_name(set_, "2"), palette_.red.label),
                              label(set_.text(is_to_scale ? "" : " stays"), palette_.muted)};
    Formula whole;
    for (const VelocityLabel& term : terms) whole += term.formula;
    VelocityLabel remark =
        label(set_.text(is_to_scale ? "stays the same" : "not to scale"), palette_.muted);
    const auto at = place_lines({whole, remark.formula}, beside_circle());
    if (!at) return;
    double x = at->x;
    for (VelocityLabel term : terms) {
      term.at = {x, at->y};
      x += term.formula.width_em() * em_;
      made_.labels.push_back(std::move(term));
    }
    remark.at = {at->x, at->y + kWordsStep * em_};
    made_.labels.push_back(std::move(remark));
  }

  /// @returns where two lines begin, beside the circle or below it; nothing if there is no room
  std::optional<Point> place_lines(const std::vector<Formula>& lines, double beside) {
    const double step = kWordsStep * em_;
    const double lowest = bottom() - step;
    const double below = circle_.centre.x - widest_em(lines) * em_ / 2;
    const double height = circle_.centre.y + kWordsBelow * circle_.radius;
    for (const Point& at : {Point{beside, std::min(height, lowest)}, Point{below, lowest},
                            Point{inside_.x, lowest}}) {
      const Point next{at.x, at.y + step};
      if (!is_free(lines.front(), at) || !is_free(lines.back(), next)) continue;
      take(lines.front(), at);
      take(lines.back(), next);
      return at;
    }
    return std::nullopt;
  }

  const DrawingContext& context_;
  const Palette& palette_;
  FormulaSetter set_;
  Rect inside_;
  Circle circle_;
  double em_;
  const VelocityPoints& points_;
  std::vector<Rect> taken_;
  VelocityLabels made_;
};

}  // namespace

VelocityPoints::VelocityPoints(const Scene& scene, const PairLog& log)
    : wedge_angle_(GapWedge(log.blocks()).theta), last_(log.last()) {
  const TwoBlocks& system = log.blocks();
  const Rational energy = twice_energy(log.system());
  if (energy == 0) return;
  moves_ = true;
  red_factor_ = root_of(system.red.mass / energy);
  blue_factor_ = root_of(system.blue.mass / energy);
  Point start = point_of(to_double(system.blue.velocity), to_double(system.red.velocity));
  if (log.first_index() < 1 && has_span(scene, log)) {
    const Rational from = span_of(scene, log).from;
    if (from < 0) {
      const PairState state = log.blocks_at(from);
      before_ = std::min<Integer>(state.count, 0);
      start = point_of(state.blue.velocity, state.red.velocity);
    }
  }
  start_angle_ = rounded::atan2(start.y, start.x);
  if (before_ < last_) first_ = log.blocks_collision(before_ + 1).kind;
}

std::vector<double> VelocityPoints::all_angles() const {
  std::vector<double> angles{start_angle_};
  for (Integer i = before_ + 1; i <= last_; ++i) {
    angles.push_back(reflected(angles.back(), kind_of(i)));
  }
  return angles;
}

Rational drawn_mass_ratio(const TwoBlocks& system) {
  constexpr long kMost = 12 * 12;  // a longer ellipse is drawn with axes of 12 to 1
  return std::clamp<Rational>(system.red.mass / system.blue.mass, Rational(1, kMost), kMost);
}

VelocityPlace place_velocities(const Diagram& diagram, const FormulaSetter& set) {
  const Rect& inside = diagram.inside();
  const double em = diagram.text_px();
  const double side = kBesideCircle * em;
  const double high = inside.height - (kAboveCircle + kBelowCircle) * em;
  const double beside_name =
      inside.width - side - (kToLabel + scaled_name(set, "2").width_em()) * em;
  double diameter = std::min(high, inside.width - 2 * side);
  const bool has_name = beside_name >= kLeastDiameter * std::min(inside.width, inside.height);
  if (has_name) diameter = std::min(diameter, beside_name);
  const double whole = side + diameter + (2 * kToLabel + end_words(set).width_em()) * em;
  double left = side;
  if (inside.width > kWide * whole) {
    left += (inside.width - whole) / 2;
  } else if (!has_name) {
    left = (inside.width - diameter) / 2;
  }
  // Two lines have room below; less is shared with what is above.
  const double rest = high - diameter;
  const double above = kAboveCircle * em + (rest < 2 * kWordsStep * em ? rest / 2 : 0);
  const double radius = diameter / 2;
  return {inside, {{inside.x + left + radius, inside.y + above + radius}, radius}, em};
}

VelocityLabels label_velocities(const DrawingContext& context, const VelocityPlace& place,
                                const VelocityPoints& points, const std::vector<double>& angles) {
  return VelocityLabeller(context, place, points).run(context.two_blocks().blocks(), angles);
}

}  // namespace piblocks
