#include "draw/panels/velocity_figure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "draw/look.hpp"

namespace piblocks {
namespace {

constexpr double kPi = std::numbers::pi;

// In ems.
constexpr double kAboveCircle = 1.05;
constexpr double kBelowCircle = 0.35;
constexpr double kBesideCircle = 0.35;
constexpr double kAxisReach = 0.4;     ///< beyond the circle
constexpr double kBesideAxis = 0.4;    ///< from an axis to its name
constexpr double kToLabel = 0.75;      ///< from the circle to what is written beside it
constexpr double kLineStep_em = 1.25;  ///< between lines of words
constexpr double kBracket = 0.24;      ///< from the circle to the arc outside of it
constexpr double kBracketEnd = 0.12;
constexpr double kLabelTop = 0.86;
constexpr double kLabelBottom = 0.25;
constexpr double kAfterArc = 0.6;  ///< from its name to the words
constexpr double kToArcName = 0.18;
constexpr double kHalfHeight = 0.4;
constexpr double kMiddle = 0.3;  ///< of letters, above the baseline
constexpr double kAround_em = 0.1;
constexpr double kEndAbove = 0.9;  ///< the end's words above the horizontal axis

/// The circle's diameter is at least this part of the room's shorter side.
constexpr double kLeastDiameter = 0.76;
/// Chords on one side are at least so many data lines apart.
constexpr double kChordsApart = 3;
/// An ellipse of other proportions is drawn as one of these.
constexpr double kMostLong = 12;
/// Where the arc of 2 theta is marked, if possible.
constexpr double kBracketAngle = -0.7;
/// Radius of the dots of hits, at most, in parts of the length between two of them.
constexpr double kDotsApart = 0.3;
/// Where the words begin, below the circle's centre, in radii.
constexpr double kWordsBelow = 0.62;
/// A narrower wedge cannot be seen.
constexpr double kLeastWedge_px = 0.5;

/// Log of the ellipse's axes, blue's over red's: the root of the mass ratio, within limits.
double log_axes_of(const BlockSystem& system) {
  const Rational ratio = system.red.mass / system.blue.mass;
  const Rational most = static_cast<long>(kMostLong * kMostLong);
  return std::log(to_double(std::clamp<Rational>(ratio, 1 / most, most))) / 2;
}

bool is_to_scale(const BlockSystem& system) {
  const Rational ratio = system.red.mass / system.blue.mass;
  const Rational most = static_cast<long>(kMostLong * kMostLong);
  return ratio <= most && ratio >= 1 / most;
}

bool overlap_at_all(const Rectangle& a, const Rectangle& b) {
  return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

Formula velocity_name(const FormulaSetter& set, const char* index) {
  return set.lowered(set.italic("v"), set.symbol(index));
}

Formula scaled_name(const FormulaSetter& set, const char* index) {
  return set.root(set.lowered(set.italic("m"), set.symbol(index))) + velocity_name(set, index);
}

/// Lines beside or below the circle.
std::vector<Formula> words_of(const FormulaSetter& set, bool are_seen) {
  const Formula arc = set.text("2") + set.italic("θ");
  if (are_seen) return {set.text("each hit cuts off"), set.text("the same arc, ") + arc};
  return {set.text("each hit cuts off the same"),
          set.text("arc, ") + arc + set.text(", too small to see")};
}

/// Twice the kinetic energy of a block.
Formula energy_name(const FormulaSetter& set, const char* index) {
  return set.lowered(set.italic("m"), set.symbol(index)) +
         set.raised(velocity_name(set, index), set.symbol("2"));
}

double widest_em(const std::vector<Formula>& lines) {
  double widest = 0;
  for (const Formula& line : lines) widest = std::max(widest, line.width_em());
  return widest;
}

}  // namespace

/// Keeps what is written apart from the circle and from each other.
class VelocityFigure::Labels {
 public:
  Labels(const Rectangle& inside, const Circle& circle, double em)
      : inside_(inside), circle_(circle), em_(em) {}

  const Rectangle& inside() const { return inside_; }
  Rectangle box_of(const Formula& formula, const Point& at) const {
    return {at.x, at.y - kLabelTop * em_, formula.width_em() * em_,
            (kLabelTop + kLabelBottom) * em_};
  }
  bool is_free(const Rectangle& box) const {
    const double slack = kAround_em * em_;
    // The name of the vertical axis is beside what hangs from the title, where there is room.
    if (box.x < inside_.x || box.x + box.width > inside_.x + inside_.width ||
        box.y < inside_.y - kAround_em * 3 * em_ || box.y + box.height > inside_.y + inside_.height)
      return false;
    const double x = std::clamp(circle_.centre.x, box.x, box.x + box.width);
    const double y = std::clamp(circle_.centre.y, box.y, box.y + box.height);
    if (std::hypot(x - circle_.centre.x, y - circle_.centre.y) < circle_.radius + slack)
      return false;
    const Rectangle wide{box.x - slack, box.y, box.width + 2 * slack, box.height};
    return std::ranges::none_of(
        taken_, [&](const Rectangle& other) { return overlap_at_all(wide, other); });
  }
  void take(const Rectangle& box) { taken_.push_back(box); }

 private:
  Rectangle inside_;
  Circle circle_;
  double em_;
  std::vector<Rectangle> taken_;
};

VelocityFigure::VelocityFigure(const DrawingContext& context, const Diagram& diagram,
                               const VelocityPoints& points)
    : points_(points),
      palette_(context.palette),
      em_(diagram.text_px()),
      grid_px_(context.sizes.grid_line),
      log_axes_(log_axes_of(context.scene.system)) {
  const FormulaSetter set = context.setter();
  const double unit = context.sizes.unit;
  place_circle(diagram.inside(), scaled_name(set, "2").width_em(), widest_em(words_of(set, true)));
  const double apart_px = 2 * points_.wedge_angle() * circle_.radius;
  has_chords_ = points_.moves() && apart_px >= kChordsApart * context.sizes.data_line;
  if (has_chords_) angles_ = points_.all_angles();
  dot_px_ = std::min(style::kHitDot * unit, kDotsApart * apart_px);
  Labels labels(diagram.inside(), circle_, em_);
  place_axis_names(set, labels);
  if (points_.moves()) {
    place_end(set, labels);
    Labels of_ellipse = labels;
    place_energy(set, is_to_scale(context.scene.system), of_ellipse);
    place_arc(set, labels);
    place_words(set, labels);
  }
}

/// The circle is as large as the names of its axes allow, and together with the words beside it in
/// the middle of a wide panel.
void VelocityFigure::place_circle(const Rectangle& inside, double name_em, double words_em) {
  const double side = kBesideCircle * em_;
  const double shorter = std::min(inside.width, inside.height);
  const double most =
      std::min(inside.height - (kAboveCircle + kBelowCircle) * em_, inside.width - 2 * side);
  const double beside_name = inside.width - side - (kToLabel + name_em) * em_;
  double diameter = most;
  if (beside_name >= kLeastDiameter * shorter) diameter = std::min(most, beside_name);
  circle_.radius = diameter / 2;
  const double whole = side + diameter + (2 * kToLabel + words_em) * em_;
  double left = side;
  if (inside.width > 1.6 * whole) {
    left += (inside.width - whole) / 2;
  } else if (beside_name < diameter) {
    left = (inside.width - diameter) / 2;
  }
  circle_.centre = {inside.x + left + circle_.radius,
                    inside.y + kAboveCircle * em_ + circle_.radius};
  // What is left below is for words.
  const double rest = inside.height - (kAboveCircle + kBelowCircle) * em_ - diameter;
  if (rest < 2 * kLineStep_em * em_) circle_.centre.y += rest / 2;
}

void VelocityFigure::place_axis_names(const FormulaSetter& set, Labels& labels) {
  const auto add = [&](const char* index, const Point& at, const Color& color) {
    const Formula scaled = scaled_name(set, index);
    labels_.push_back({scaled, at, color, Part::circle});
    labels_.push_back({velocity_name(set, index), at, color, Part::ellipse});
    labels.take(labels.box_of(scaled, at));
  };
  const auto& [centre, radius] = circle_;
  const double top = centre.y - radius - kBesideAxis * em_;
  add("1", {centre.x + kBesideAxis * em_, top}, palette_.blue.label);
  const Rectangle& inside = labels.inside();
  const Formula name = scaled_name(set, "2");
  const Point beside{centre.x + radius + kToLabel * em_, centre.y + kMiddle * em_};
  const Point below{inside.x + inside.width - name.width_em() * em_,
                    inside.y + inside.height - kLabelBottom * em_};
  for (const Point& at : {beside, below}) {
    if (!labels.is_free(labels.box_of(name, at))) continue;
    add("2", at, palette_.red.label);
    return;
  }
}

/// Beside the wedge of the velocities after which nothing collides.
void VelocityFigure::place_end(const FormulaSetter& set, Labels& labels) {
  const Formula words = set.text("no more hits");
  const auto& [centre, radius] = circle_;
  const double middle = points_.wedge_angle() / 2;
  const double width = words.width_em() * em_;
  const double baseline =
      std::min(centre.y - radius * std::sin(middle) + kMiddle * em_, centre.y - kEndAbove * em_);
  const Rectangle& inside = labels.inside();
  for (const Point& at :
       {Point{circle_.at(middle).x + kToLabel * em_, baseline},
        Point{centre.x + radius + kToLabel * em_, baseline},
        Point{inside.x + inside.width - width, centre.y - radius},
        Point{inside.x + inside.width - width, inside.y + inside.height - kLabelBottom * em_}}) {
    const Rectangle box = labels.box_of(words, at);
    if (!labels.is_free(box)) continue;
    labels.take(box);
    labels_.push_back({words, at, palette_.done, Part::circle});
    return;
  }
}

/// An arc outside of the circle, with its ends bent towards two points.
std::vector<Point> VelocityFigure::bracket(double from, double to) const {
  const Circle outer{circle_.centre, circle_.radius + kBracket * em_};
  const Circle ends{circle_.centre, outer.radius - kBracketEnd * em_};
  std::vector<Point> points{ends.at(from)};
  for (const Point& point : outer.arc(from, to)) points.push_back(point);
  points.push_back(ends.at(to));
  return points;
}

/// Every second point is on the same side of the axis: two of them are 2 theta apart.
void VelocityFigure::place_arc(const FormulaSetter& set, Labels& labels) {
  const Formula name = set.text("2") + set.italic("θ");
  const double theta = points_.wedge_angle();
  std::vector<double> middles;
  for (std::size_t i = 2; i < angles_.size(); ++i) {
    middles.push_back(
        std::remainder(angles_[i] + (angles_[i] > angles_[i - 2] ? -theta : theta), 2 * kPi));
  }
  std::ranges::sort(middles, {}, [](double m) { return std::abs(m - kBracketAngle); });
  for (const double middle : middles) {
    const std::vector<Point> arc = bracket(middle - theta, middle + theta);
    const bool fits = std::ranges::all_of(arc, [&](const Point& p) {
      return labels.is_free({p.x, p.y, 0, 0});
    });
    const double half_width = name.width_em() / 2;
    const double away =
        circle_.radius + em_ * (kBracket + kToArcName + std::abs(std::cos(middle)) * half_width +
                                std::abs(std::sin(middle)) * kHalfHeight);
    const Point at = Circle{circle_.centre, away}.at(middle);
    const Point left{at.x - half_width * em_, at.y + kMiddle * em_};
    const Rectangle box = labels.box_of(name, left);
    if (!fits || !labels.is_free(box)) continue;
    labels.take(box);
    bracket_ = arc;
    labels_.push_back({name, left, palette_.text, Part::arcs});
    return;
  }
}

/// To the right of the circle, else below it, else nowhere.
void VelocityFigure::place_words(const FormulaSetter& set, Labels& labels) {
  if (points_.last() - points_.before() < 2) return;
  const bool are_seen = !bracket_.empty();
  if (!are_seen && has_chords_) return;
  double beside = circle_.centre.x + circle_.radius + kToLabel * em_;
  if (are_seen) {
    const Label& arc = labels_.back();
    const double right = arc.at.x + (arc.formula.width_em() + kAfterArc) * em_;
    if (arc.at.x > circle_.centre.x) beside = std::max(beside, right);
  }
  const std::vector<Formula> lines = words_of(set, are_seen);
  const auto at = place_lines(lines, beside, labels);
  if (!at) return;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    labels_.push_back(
        {lines[i], {at->x, at->y + double(i) * kLineStep_em * em_}, palette_.muted, Part::arcs});
  }
}

/// Why it is an ellipse.
void VelocityFigure::place_energy(const FormulaSetter& set, bool is_to_scale, Labels& labels) {
  const std::array terms = {Label{energy_name(set, "1"), {}, palette_.blue.label, Part::ellipse},
                            Label{set.text(" + "), {}, palette_.muted, Part::ellipse},
                            Label{energy_name(set, "2"), {}, palette_.red.label, Part::ellipse},
                            Label{set.text(" stays"), {}, palette_.muted, Part::ellipse}};
  Formula whole;
  for (const Label& term : terms) whole += term.formula;
  const Formula remark = set.text("not to scale");
  const double beside = circle_.centre.x + circle_.radius + kToLabel * em_;
  const auto at = place_lines({whole, remark}, beside, labels);
  if (!at) return;
  double x = at->x;
  for (Label term : terms) {
    term.at = {x, at->y};
    x += term.formula.width_em() * em_;
    labels_.push_back(std::move(term));
  }
  if (is_to_scale) return;
  labels_.push_back({remark, {at->x, at->y + kLineStep_em * em_}, palette_.muted, Part::ellipse});
}

/// @returns where two lines are that begin there or below the circle; nothing if there is no room
std::optional<Point> VelocityFigure::place_lines(const std::vector<Formula>& lines, double beside,
                                                 Labels& labels) const {
  const Rectangle& inside = labels.inside();
  const double step = kLineStep_em * em_;
  const double lowest = inside.y + inside.height - kLabelBottom * em_ - step;
  const double below = circle_.centre.x - widest_em(lines) * em_ / 2;
  for (const Point& at :
       {Point{beside, std::min(circle_.centre.y + kWordsBelow * circle_.radius, lowest)},
        Point{below, lowest}, Point{inside.x, lowest}}) {
    const Rectangle upper = labels.box_of(lines.front(), at);
    const Rectangle lower = labels.box_of(lines.back(), {at.x, at.y + step});
    if (!labels.is_free(upper) || !labels.is_free(lower)) continue;
    labels.take(upper);
    labels.take(lower);
    return at;
  }
  return std::nullopt;
}

VelocityMap VelocityFigure::map(double share) const {
  const double shorter = circle_.radius * std::exp(-std::abs(log_axes_) * (1 - share));
  return log_axes_ > 0 ? VelocityMap{circle_.centre, shorter, circle_.radius}
                       : VelocityMap{circle_.centre, circle_.radius, shorter};
}

/// One fades out before the other fades in. Arcs are equal on the circle alone.
double VelocityFigure::strength(Part part, double share) {
  constexpr double kArcsFrom = 0.9;
  const double visible = part == Part::ellipse  ? 1 - 2 * share
                         : part == Part::circle ? 2 * share - 1
                                                : (share - kArcsFrom) / (1 - kArcsFrom);
  return std::clamp(visible, 0.0, 1.0);
}

std::array<std::vector<Point>, 2> VelocityFigure::axes() const {
  const auto& [centre, radius] = circle_;
  const double reach = radius + kAxisReach * em_;
  return {{{{centre.x - reach, centre.y}, {centre.x + reach, centre.y}},
           {{centre.x, centre.y - reach}, {centre.x, centre.y + reach}}}};
}

void VelocityFigure::add_lines(double share, ItemId first, std::vector<DrawItem>& items) const {
  const VelocityMap map = this->map(share);
  const double appearing = strength(Part::circle, share);
  const auto add = [&](std::vector<Point> points, const Color& color, double width,
                       bool is_closed = false) {
    items.emplace_back(PathItem{nth(first, items.size()), std::move(points), is_closed,
                                std::nullopt, Stroke{color, width * grid_px_}});
  };
  for (std::vector<Point>& axis : axes()) add(std::move(axis), palette_.grid, 1);
  if (!points_.moves()) return;
  if (appearing > 0) {
    for (std::size_t i = 1; i < angles_.size(); ++i) {
      add({map.at(angles_[i - 1]), map.at(angles_[i])}, faded(palette_.grid, appearing), 1);
    }
  }
  std::vector<Point> outline;
  for (const Point& point : Circle{{0, 0}, 1}.arc(0, 2 * kPi)) {
    outline.push_back(map.at(Point{point.x, -point.y}));
  }
  outline.pop_back();
  add(std::move(outline), palette_.muted, 1.5, true);
  const double arcs = strength(Part::arcs, share);
  if (arcs > 0 && !bracket_.empty()) add(bracket_, faded(palette_.text, arcs), 1.2);
}

std::vector<DrawItem> VelocityFigure::items(double share, ItemId first) const {
  std::vector<DrawItem> items;
  const double theta = points_.wedge_angle();
  const double appearing = strength(Part::circle, share);
  if (appearing > 0 && points_.moves() && theta * circle_.radius >= kLeastWedge_px) {
    std::vector<Point> wedge;
    for (const Point& point : Circle{{0, 0}, 1}.arc(0, theta)) {
      wedge.push_back(map(share).at(Point{point.x, -point.y}));
    }
    wedge.push_back(circle_.centre);
    items.emplace_back(PathItem{first, std::move(wedge), true,
                                faded(palette_.done, style::kWedgeFill * appearing), std::nullopt});
  }
  add_lines(share, first, items);
  for (const Label& label : labels_) {
    const double visible = strength(label.part, share);
    if (visible == 0) continue;
    label.formula.add_to(items, nth(first, items.size()), label.at, em_,
                         faded(label.color, visible));
  }
  return items;
}

}  // namespace piblocks
