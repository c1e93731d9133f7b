#include <piblocks/two_blocks.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "draw/number_text.hpp"
#include "draw/panels/count_curve.hpp"
#include "draw/panels/panels.hpp"

namespace piblocks {
namespace {

// In ems.
constexpr double kBetweenCounts_em = 1.6;
constexpr double kCountTick_em = 0.3;
constexpr double kBesideCount_em = 0.25;
/// Wider figures than this part of the panel are left out.
constexpr double kMostFigures = 0.4;

constexpr double kStrip_em = 0.5;

// Of the inset, in ems.
constexpr double kInsetFoot_em = 0.2;
constexpr double kInsetLeft_em = 0.7;
constexpr double kFromTurn_em = 1.4;
constexpr double kInsetWidest_em = 11;
constexpr double kInsetLeastWidth_em = 4;
constexpr double kInsetLeastHeight_em = 1.8;
constexpr double kStepWidth_em = 0.6;
/// Of the inset's height that steps take.
constexpr double kFilled = 0.8;
/// Items above the filled area: the curve.
constexpr std::size_t kWithoutInset = 1;

/// Whether the turn is shown and parts the collisions, and as many come before it as after.
struct TurnFacts {
  TurnFacts(const Log& log, const Span& span) {
    const std::optional<Rational> turn = turn_of(log);
    if (!turn || log.last() < 2 || *turn <= span.from || *turn >= span.to) return;
    const Integer before = log.count_at(*turn);
    is_shown = true;
    is_half = abs(Integer(2 * before - log.last())) <= 1;
  }
  bool is_shown = false;
  bool is_half = false;
};

std::vector<Formula> titles_of_count(const DrawingContext& context, const TurnFacts& turn) {
  const FormulaSetter set = context.setter();
  const Log& log = context.log;
  std::vector<Formula> wordings;
  // The curve ends at the last one of these that the log has.
  if (log.state_at(span_of(context.scene, log).to).is_infinite) {
    return set.texts({"Infinitely many collisions", "Collisions"});
  }
  if (turn.is_shown && !turn.is_half) wordings.push_back(set.text("The count jumps at the turn"));
  if (turn.is_half) {
    wordings.push_back(set.text("Half of the collisions come before the turn"));
    wordings.push_back(set.text("Half come before the turn"));
    wordings.push_back(set.text("Half before the turn"));
  }
  wordings.push_back(set.text("Collisions so far"));
  wordings.push_back(set.text("Collisions"));
  return wordings;
}

/// The axis of counts of any size, beside that of time.
struct CountScale {
  CountScale(const Log& log, const Span& span, int count_base)
      : base(count_base),
        low(std::min(Integer(0), log.count_at(span.from))),
        high(std::max(Integer(low + 1), log.count_at(span.to))) {}

  /// @param least  counts between figures
  void place_figures(const Rational& least) {
    RoundFactor round{1, std::max(0L, magnitude_of(least).exponent)};
    while (round.value() < least) round = round.next();
    Rational step = round.value();
    if (base != kUsualBase) {
      step = 1;
      while (step < least) step *= base;
    }
    values.clear();
    for (Integer k = ceil(low / step); k * step <= high; k += 1) values.emplace_back(k * step);
    exponent = round.exponent;
  }

  std::string text(const Integer& value) const {
    constexpr long kMostPlain = 1'000'000;
    if (base != kUsualBase || high < kMostPlain) return count_text(value, base);
    if (value == 0) return "0";
    const Rational multiple = value / power_of_ten(exponent);
    const std::string power = power_text(exponent);
    return multiple == 1 ? power : fixed_text(to_double(multiple), 0) + "×" + power;
  }

  int base;
  Integer low;
  Integer high;
  std::vector<Integer> values;  ///< with figures
  long exponent = 0;            ///< of ten, of the step between them
};

// Around the inset, in ems.
constexpr double kAboveInset_em = 0.35;  // from the baseline of the label
constexpr double kBelowInset_em = 0.95;  // to that of the other one
constexpr double kMarked_em = 0.3;       // half of the rectangle around the place that it enlarges

/// The turn of the curve, enlarged in a frame of its own.
class CountInset {
 public:
  /// Heights, in ems, of its labels with what is around them: one is above it, one below.
  static constexpr double kLabel_em = 1.25;

  /// @param count_px  height of a count in the curve that is not enlarged
  CountInset(EnlargedTurn part, const Rect& frame, double count_px)
      : part_(std::move(part)), frame_(frame), count_px_(count_px) {}

  bool shows(const Rational& time) const {
    return time >= part_.span.from && time <= part_.span.to;
  }
  Point at(const Rational& time, const Integer& count) const {
    const auto& [span, time_factor, count_factor, low, high] = part_;
    const double across = to_double((time - span.from) / (span.to - span.from));
    const double up = to_double(Rational(2 * count - low - high) * count_factor.value() / 2);
    return {frame_.x + across * frame_.width, frame_.y + frame_.height / 2 - up * count_px_};
  }

  /// Says by how much time and count are enlarged, the first above the frame, the other below.
  /// @returns false, and adds nothing, if a label is wider than `room_px`
  bool add_labels(const Diagram& diagram, double room_px, std::vector<DrawItem>& items) const {
    const FormulaSetter set = diagram.setter();
    const double em = diagram.text_px();
    const Color& color = diagram.palette().muted;
    const Formula time = set.text("time ×" + part_.time_factor.text());
    Formula count;
    if (part_.count_factor.value() > 1) count = set.text("count ×" + part_.count_factor.text());
    if (std::max(time.width_em(), count.width_em()) * em > room_px) return false;
    const ItemId id = diagram.moving(0);
    time.add_to(items, id, {frame_.x, frame_.y - kAboveInset_em * em}, em, color);
    count.add_to(items, id, {frame_.x, frame_.bottom() + kBelowInset_em * em}, em, color);
    return true;
  }

  /// The frame, and thin lines to the place that it enlarges.
  void add_frame(const Diagram& diagram, const Point& from, std::vector<DrawItem>& items) const {
    const Color& color = diagram.palette().muted;
    const double em = diagram.text_px();
    // The area below the curve must not be seen behind it and its labels.
    items.emplace_back(RectangleItem{diagram.moving(0), frame_.grown(0, kLabel_em * em),
                                     diagram.palette().background});
    const bool is_left = frame_.x < from.x;
    const double side = is_left ? frame_.right() : frame_.x;
    const double half = (is_left ? kMarked_em : -kMarked_em) * em;
    const auto add = [&](std::vector<Point> points) {
      items.emplace_back(diagram.moving_line(0, std::move(points), color));
    };
    add({{side, frame_.y}, {from.x - half, from.y - std::abs(half)}});
    add({{side, frame_.bottom()}, {from.x - half, from.y + std::abs(half)}});
    for (const Rect& box :
         {frame_, Rect{from.x - half, from.y - std::abs(half), 2 * half, 2 * std::abs(half)}}) {
      std::vector<Point> around = box.corners();
      around.push_back(around.front());
      add(std::move(around));
    }
  }

  /// The steps, each in the colour of the hit that makes it.
  void add_steps(const Diagram& diagram, const PairLog& log, std::vector<DrawItem>& items) const {
    const Palette& palette = diagram.palette();
    const int columns = std::max(1, static_cast<int>(frame_.width));
    const std::vector<CountPoint> points = count_curve(log, part_.span, columns);
    const auto place_of = [&](const CountPoint& point) {
      Point place = at(part_.span.from, point.count);
      place.x += point.share * frame_.width;
      return place;
    };
    for (std::size_t i = 1; i < points.size(); ++i) {
      Color color = palette.text;
      if (points[i].share == points[i - 1].share) {
        const bool is_wall = log.blocks_collision(points[i].count).kind == CollisionKind::wall;
        color = is_wall ? palette.blue.line : palette.red.line;
      }
      items.emplace_back(diagram.moving_line(0, {place_of(points[i - 1]), place_of(points[i])},
                                             color, diagram.data_width()));
    }
  }

 private:
  EnlargedTurn part_;
  Rect frame_;
  double count_px_;
};

class CountPanel {
 public:
  CountPanel(const DrawingContext& context, const PanelPlace& place)
      : span_(span_of(context.scene, context.log)),
        turn_(context.log, span_),
        diagram_(context, place, titles_of_count(context, turn_)),
        scale_(context.log, span_, context.scene.show.base),
        axis_(context, diagram_, indent_em(context)) {
    const Rect& plot = axis_.plot();
    const int columns = std::max(1, static_cast<int>(std::ceil(plot.width)));
    for (const auto& [share, count] : count_curve(context.log, span_, columns)) {
      curve_.push_back({plot.x + share * plot.width, y_of(count)});
    }
    axis_.add_base(diagram_);
    add_figures();
    add_strips();
    std::vector<DrawItem> above;
    above.emplace_back(
        diagram_.moving_line(kCurve, curve_, diagram_.palette().text, diagram_.data_width()));
    add_inset(context, above);
    above_ = diagram_.plate(kCurve, std::move(above));
    diagram_.finish();
  }

  void operator()(const FrameState& shown, std::vector<DrawItem>& items) const {
    items.emplace_back(diagram_.item());
    const double time = to_double(shown.time);
    const double present = std::clamp(axis_.x_of(time), axis_.plot().x, axis_.right());
    for (std::size_t n = 0; n < strips_.size(); ++n) {
      const Strip& strip = strips_[n];
      if (present <= strip.left) break;
      Points points = strip.whole;
      if (present < strip.right) points = area_under(strip.left, present);
      items.emplace_back(
          PathItem{diagram_.moving(n), std::move(points), true, diagram_.palette().shade});
    }
    items.emplace_back(above_);
    if (!axis_.shows(time)) return;
    const Color accent = diagram_.palette().accent;
    const Point at{axis_.x_of(time), y_of(shown.state.count)};
    items.emplace_back(axis_.cursor(diagram_, kCurve + 1, at));
    items.emplace_back(diagram_.present_dot(kCurve + 2, at));
    if (!inset_ || !inset_->shows(shown.time)) return;
    items.emplace_back(diagram_.dot(kCurve + 3, inset_->at(shown.time, shown.state.count), accent));
  }

 private:
  static constexpr std::size_t kCurve = 1000;  ///< after all strips

  /// A strip of the area under the curve. Strips that are full stay as they are: only the one at
  /// the present has to be painted again.
  struct Strip {
    double left;
    double right;
    Points whole;
  };

  double y_of(const Integer& count) const {
    const double share = to_double(Rational(count - scale_.low) / (scale_.high - scale_.low));
    return axis_.bottom() - std::clamp(share, 0.0, 1.0) * axis_.plot().height;
  }

  /// The room for figures and their ticks, left of the axis.
  double indent_em(const DrawingContext& context) {
    const Rect& inside = diagram_.inside();
    const Rational least = Rational(scale_.high - scale_.low) *
                           Rational(kBetweenCounts_em * diagram_.text_px()) /
                           Rational(std::max(1.0, inside.height - 2 * diagram_.text_px()));
    scale_.place_figures(least);
    double widest = 0;
    for (const Integer& value : scale_.values) {
      widest = std::max(widest, context.setter().text(scale_.text(value)).width_em());
    }
    const double indent = widest + kCountTick_em + kBesideCount_em;
    if (indent * diagram_.text_px() <= kMostFigures * inside.width) return indent;
    scale_.values.clear();
    return 0;
  }

  void add_figures() {
    const double em = diagram_.text_px();
    const Color& color = diagram_.palette().muted;
    const double left = axis_.plot().x;
    diagram_.line({{left, axis_.plot().y}, {left, axis_.bottom()}}, color);
    for (const Integer& value : scale_.values) {
      const double y = y_of(value);
      const double tick = left - kCountTick_em * em;
      diagram_.line({{tick, y}, {left, y}}, color);
      diagram_.formula(diagram_.setter().text(scale_.text(value)),
                       {tick - kBesideCount_em * em, y + kHalfFigure_em * em}, 1, color);
    }
  }

  /// The curve's height at a place; after the step if there is one.
  double height_at(double x) const {
    const auto after = std::ranges::upper_bound(curve_, x, {}, &Point::x);
    if (after == curve_.end()) return curve_.back().y;
    if (after == curve_.begin()) return after->y;
    const Point& a = *std::prev(after);
    return a.y + (after->y - a.y) * (x - a.x) / (after->x - a.x);
  }

  std::vector<Point> area_under(double left, double right) const {
    std::vector<Point> outline{{left, axis_.bottom()}, {left, height_at(left)}};
    const auto first = std::ranges::upper_bound(curve_, left, {}, &Point::x);
    const auto last = std::ranges::upper_bound(curve_, right, {}, &Point::x);
    outline.insert(outline.end(), first, last);
    outline.push_back({right, height_at(right)});
    outline.push_back({right, axis_.bottom()});
    return outline;
  }

  void add_strips() {
    const double end = axis_.right();
    // The first and the last one may be narrower.
    const double least = std::ceil(axis_.plot().width / double(kCurve - 2));
    const double width = std::max({2.0, least, std::round(kStrip_em * diagram_.text_px())});
    // Neighbours overlap, so that there is no seam between them.
    constexpr double kOverlap_px = 1;
    for (double left = axis_.plot().x; left < end; left = std::floor(left) + width) {
      const double right = std::min(end, std::floor(left) + width);
      const double begin = std::max(axis_.plot().x, left - kOverlap_px);
      strips_.push_back({begin, right, area_under(begin, right)});
    }
  }

  /// A place for the inset above the curve, left of the turn, or below it, right of the turn; of
  /// no width if there is no room.
  Rect inset_frame(double turn_x) const {
    const double em = diagram_.text_px();
    const Rect& plot = axis_.plot();
    const double widest = kInsetWidest_em * em;
    const double lowest = axis_.bottom() - kInsetFoot_em * em;
    // Of the frame with its labels.
    double right = turn_x - kFromTurn_em * em;
    double left = std::max(plot.x + kInsetLeft_em * em, right - widest);
    double top = plot.y;
    double bottom = std::min(height_at(right) - kInsetFoot_em * em, lowest);
    if (right - left < kInsetLeastWidth_em * em) {
      left = turn_x + kFromTurn_em * em;
      right = std::min(plot.right(), left + widest);
      top = height_at(left) + kInsetFoot_em * em;
      bottom = lowest;
    }
    top += CountInset::kLabel_em * em;
    bottom -= CountInset::kLabel_em * em;
    const bool has_room =
        right - left >= kInsetLeastWidth_em * em && bottom - top >= kInsetLeastHeight_em * em;
    return has_room ? Rect{left, top, right - left, bottom - top} : Rect{};
  }

  void add_inset(const DrawingContext& context, std::vector<DrawItem>& items) {
    if (!turn_.is_shown || context.pair() == nullptr) return;
    const double turn_x = axis_.x_of(to_double(*turn_of(context.log)));
    const Rect frame = inset_frame(turn_x);
    if (frame.width == 0) return;
    const Rect& plot = axis_.plot();
    const double em = diagram_.text_px();
    const Integer counts = scale_.high - scale_.low;
    const auto part = enlarged_turn(
        context.two_blocks(),
        {.span = span_,
         .width_share = Rational(frame.width) / Rational(plot.width),
         .most_steps = std::max(2, static_cast<int>(frame.width / (kStepWidth_em * em))),
         .counts_in_height = Rational(kFilled * frame.height) / Rational(plot.height) * counts});
    if (!part) return;
    CountInset inset(*part, frame, plot.height / to_double(Rational(counts)));
    inset.add_frame(diagram_, {turn_x, y_of(part->low + (part->high - part->low) / 2)}, items);
    inset.add_steps(diagram_, context.two_blocks(), items);
    const bool is_left = frame.x < turn_x;
    const double room = is_left ? turn_x - frame.x - kFromTurn_em / 2 * em : frame.width;
    // An inset that does not say what it is would mislead.
    if (inset.add_labels(diagram_, room, items)) {
      inset_ = std::move(inset);
    } else {
      items.resize(kWithoutInset);
    }
  }

  Span span_;
  TurnFacts turn_;
  Diagram diagram_;
  CountScale scale_;
  TimeAxis axis_;
  std::vector<Point> curve_;
  std::vector<Strip> strips_;
  PlateItem above_;  ///< the curve and its inset, over the filled area
  std::optional<CountInset> inset_;
};

}  // namespace

Drawable count_panel(const DrawingContext& context, const PanelPlace& place) {
  return {CountPanel(context, place)};
}

}  // namespace piblocks
