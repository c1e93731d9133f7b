#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/rounded.hpp"
#include "core/smooth_step.hpp"
#include "draw/number_text.hpp"
#include "draw/panels/panels.hpp"
#include "draw/panels/unfolded_line.hpp"

namespace piblocks {
namespace {

// In ems.
constexpr double kNoteBaseline = 1.25;
constexpr double kNoteStep = 1.3;
constexpr double kBetweenNotes = 1.5;
/// A panel that is lower or wider has one row of notes.
constexpr double kTwoRowsHeight = 11;
constexpr double kTwoRowsWidth = 32;

// In widths of the grid's lines.
constexpr double kPresentRadius = 5.2;
constexpr double kDotRadius = 3.4;
constexpr double kBandRadius = 1.5;
constexpr double kBetweenMirrors = 1;  ///< between mirrors, if they are many

constexpr double kDotShare = 0.45;  ///< radius of a dot, of its distance to the next one
constexpr double kDoneShare = 0.6;
constexpr double kFoldShare = 0.4;  ///< of the way to the next mirror in which one unfolds

// Of θ, in ems.
constexpr double kToAngleName = 0.4;  ///< from the arc
constexpr double kAboveBase = 0.15;
constexpr double kNameHeight = 1.05;

// The n-th of the things that move, from back to front.
constexpr std::size_t kWedge = 0;
constexpr std::size_t kRays = 1;
constexpr std::size_t kLine = 4096;
constexpr std::size_t kDots = 4097;
constexpr std::size_t kPresent = 8192;

bool has_two_rows(const Diagram& diagram) {
  const Rect& inside = diagram.inside();
  const double em = diagram.text_px();
  return inside.height >= kTwoRowsHeight * em && inside.width < kTwoRowsWidth * em;
}

/// At each collision the wedge is reflected instead of the path. The wedges fill the half-plane,
/// and the path is a straight line, which crosses a mirror at every collision.
class UnfoldedPanel {
 public:
  UnfoldedPanel(const DrawingContext& context, const PanelPlace& place)
      : diagram_(context, place),
        grid_px_(context.sizes.grid_line),
        unfolds_(place.panel == Panel::mirrors),
        title_(diagram_, unfolded_sentences(context, unfolds_),
               context.two_blocks().blocks_at(span_of(context.scene, context.log).from).count,
               context.log.last()),
        rows_(has_two_rows(diagram_) ? 2 : 1),
        map_(context.scene, context.two_blocks(), plot(), 2 * kPresentRadius * grid_px_,
             style::kProtractor * context.sizes.short_side),
        mirrors_(map_.mirrors(context.two_blocks(), kBetweenMirrors * grid_px_)),
        span_(span_of(context.scene, context.log)),
        size_(context.log.last()),
        from_x_(std::clamp(map_.x_at(span_.from), map_.left(), map_.right())) {
    add_notes(context);
    add_angle(context);
    diagram_.finish();
    static_items_ = diagram_.plate(kRays, static_items());
    place_dots();
    if (unfolds_) place_rays();
  }

  void operator()(const FrameState& shown, std::vector<DrawItem>& items) const {
    const auto next = static_cast<std::size_t>(
        std::ranges::upper_bound(mirrors_, shown.state.count, {}, &Mirror::index) -
        mirrors_.begin());
    const bool is_seen = shown.time >= span_.from;
    const double x = map_.x_at(shown.time);
    const double opened = opened_part(x, next);
    if (is_seen) add_wedge(shown, next, opened, items);
    items.emplace_back(static_items_);
    if (unfolds_) {
      const std::size_t reached = opened < 1 ? next : next + 1;
      items.insert(items.end(), unfolded_.begin(),
                   unfolded_.begin() + std::ptrdiff_t(std::min(reached, unfolded_.size())));
    }
    if (is_seen) add_path(x, next, items);
    title_.add(shown.state.count, items);
  }

 private:
  /// The line up to now, what it has crossed, and where it is.
  void add_path(double x, std::size_t next, std::vector<DrawItem>& items) const {
    add_line(x, items);
    for (std::size_t k = 0; k < dots_.size() && first_dot_ + k < next; ++k) {
      items.emplace_back(dots_[k]);
    }
    const double radius = kPresentRadius * grid_px_;
    if (x < map_.left() + radius || x > map_.right() - radius) return;
    items.emplace_back(diagram_.dot(kPresent, {x, level()}, diagram_.palette().accent, radius));
  }

  /// Without the notes below it.
  Rect plot() const {
    Rect area = diagram_.inside();
    area.height -= (kNoteBaseline + 0.3 + (rows_ - 1) * kNoteStep) * diagram_.text_px();
    return area;
  }

  /// As many of the notes as there is room for, the most important ones last.
  void add_notes(const DrawingContext& context) {
    const FormulaSetter set = context.setter();
    std::vector<Formula> notes{angle_note(context)};
    if (auto thinned = thinning_note(set, mirrors_)) notes.push_back(std::move(*thinned));
    if (!map_.arc()) notes.push_back(set.text("heights not to scale"));
    const double room = map_.area().width / diagram_.text_px();
    std::vector<Point> places;
    while (!notes.empty()) {
      places = flow(notes, room);
      if (places.back().y < rows_) break;
      notes.erase(notes.begin());
    }
    for (std::size_t i = 0; i < notes.size(); ++i) {
      const double em = diagram_.text_px();
      const double y = map_.base_y() + (kNoteBaseline + places[i].y * kNoteStep) * em;
      diagram_.formula(notes[i], {map_.left() + places[i].x * em, y}, 0, diagram_.palette().muted);
    }
  }

  /// The half-turn; and the angle of its first wedge, if there is room for its name below the line.
  void add_angle(const DrawingContext& context) {
    const auto arc = map_.arc();
    if (!arc) return;
    diagram_.line(arc->arc(0, std::numbers::pi), diagram_.palette().muted, diagram_.data_width());
    const double em = diagram_.text_px();
    const bool has_room = map_.base_y() - map_.line_y() >= kNameHeight * em;
    if (map_.line().first_ray() != 0 || !has_room) return;
    const Formula name = context.setter().italic("θ");
    const bool is_right = map_.line().velocity() < 0;
    const double theta = map_.line().theta() / 2;
    const double away = kToAngleName * em;
    const Point at =
        Circle{arc->centre, arc->radius + away}.at(is_right ? theta : std::numbers::pi - theta);
    const double baseline = std::min(at.y + kHalfFigure_em * em, map_.base_y() - kAboveBase * em);
    diagram_.formula(name, {at.x, baseline}, is_right ? 0 : 1, diagram_.palette().text);
  }

  /// Left end in ems and row of each note.
  static std::vector<Point> flow(const std::vector<Formula>& notes, double room_em) {
    std::vector<Point> places;
    double x = 0;
    double row = 0;
    for (const Formula& note : notes) {
      if (x > 0 && x + note.width_em() > room_em) {
        x = 0;
        ++row;
      }
      if (note.width_em() > room_em) row = 1e9;
      places.push_back({x, row});
      x += note.width_em() + kBetweenNotes;
    }
    return places;
  }

  /// Texts, the base line, all mirrors unless they unfold, and the line that is yet to come.
  std::vector<DrawItem> static_items() const {
    const Palette& palette = diagram_.palette();
    std::vector<DrawItem> lines = diagram_.item().plate->items;
    if (!unfolds_) {
      for (const Mirror& mirror : mirrors_) lines.emplace_back(ray(kRays, mirror));
    }
    add_base(lines);
    if (map_.line().moves()) {
      const double to_x = std::clamp(map_.x_at(span_.to), map_.left(), map_.right());
      PathItem path =
          diagram_.moving_line(kRays, {{from_x_, level()}, {to_x, level()}}, palette.muted);
      path.stroke->width_px = diagram_.sizes().data_line * 0.7;
      path.stroke->dash_px = 4 * grid_px_;
      lines.emplace_back(std::move(path));
    }
    return lines;
  }

  /// If blue starts at rest, the half of the base that the line comes from is the first mirror.
  void add_base(std::vector<DrawItem>& lines) const {
    const Palette& palette = diagram_.palette();
    const double y = map_.base_y();
    const Point left{map_.left(), y};
    const Point right{map_.right(), y};
    const bool is_mirror = map_.line().first_ray() == 0;
    const bool is_whole = !is_mirror || !unfolds_;
    const Point from = map_.line().velocity() > 0 ? left : right;
    if (!is_whole) lines.emplace_back(diagram_.moving_line(kRays, {left, right}, palette.grid));
    const double wall_width = diagram_.sizes().wall_line / grid_px_;
    lines.emplace_back(
        diagram_.moving_line(kRays, {is_whole ? left : map_.corner(), is_whole ? right : from},
                             is_mirror ? palette.wall : palette.grid, is_mirror ? wall_width : 1));
  }

  /// Of the line; on the base if it goes through the corner.
  double level() const { return map_.line().meets_corner() ? map_.base_y() : map_.line_y(); }

  PathItem ray(std::size_t n, const Mirror& mirror) const {
    return diagram_.moving_line(n, {map_.corner(), map_.end_of(mirror.towards)},
                                diagram_.palette().grid);
  }

  void place_rays() {
    for (const Mirror& mirror : mirrors_) {
      unfolded_.push_back(ray(kRays + 1 + unfolded_.size(), mirror));
    }
  }

  void place_dots() {
    const auto met = [](const Mirror& mirror) { return mirror.is_met; };
    const auto first = std::ranges::find_if(mirrors_, met);
    first_dot_ = static_cast<std::size_t>(first - mirrors_.begin());
    const Palette& palette = diagram_.palette();
    for (auto mirror = first; mirror != mirrors_.end() && mirror->is_met; ++mirror) {
      const double largest = kDotRadius * grid_px_;
      const double radius =
          std::clamp(kDotShare * mirror->apart_px, kBandRadius * grid_px_, largest);
      const bool is_wall = mirror->kind == CollisionKind::wall;
      DiscItem dot = diagram_.dot(kDots + dots_.size(), {mirror->x, map_.line_y()},
                                  is_wall ? palette.blue.line : palette.red.line, radius);
      if (radius < largest) dot.stroke.reset();
      dots_.push_back(dot);
    }
  }

  /// How far the newest wedge is open, 0 … 1. It opens on the way to the next mirror.
  /// @param next  of the mirrors
  double opened_part(double x, std::size_t next) const {
    if (!unfolds_ || next == 0) return 1;
    const Mirror& newest = mirrors_[next - 1];
    const double way = kFoldShare * newest.apart_px;
    if (!(way > 0)) return 1;
    return smooth_step(std::clamp(std::abs(x - newest.x) / way, 0.0, 1.0));
  }

  /// The wedge that the point is in. @param next  of the mirrors
  void add_wedge(const FrameState& shown, std::size_t next, double opened,
                 std::vector<DrawItem>& items) const {
    const double forward = map_.line().velocity() > 0 ? 1 : -1;
    const Point before = next > 0 ? mirrors_[next - 1].towards : Point{-forward, 0};
    Point after = next < mirrors_.size() ? mirrors_[next].towards : Point{forward, 0};
    if (opened < 1) after = turned(before, after, opened);
    const Palette& palette = diagram_.palette();
    const bool is_over = shown.state.count >= size_;
    const Color color = is_over ? faded(palette.done, kDoneShare) : palette.shade;
    const bool is_leftward = before.x * after.y > after.x * before.y;
    std::vector<Point> outline =
        is_leftward ? map_.sector(before, after) : map_.sector(after, before);
    items.emplace_back(diagram_.moving_shape(kWedge, std::move(outline), color));
  }

  /// A wedge that turns over its mirror, seen from above: halfway it is seen edge on.
  Point turned(const Point& mirror, const Point& after, double opened) const {
    const auto unit = [](const Point& point) { return point / rounded::hypot(point.x, point.y); };
    const Point axis = unit(map_.plane_of(mirror));
    const Point open = unit(map_.plane_of(after));
    const Point along = dot(axis, open) * axis;
    const double across = -rounded::cos(std::numbers::pi * opened);
    const Point plane = along + across * (open - along);
    const Point turned = map_.picture_of({plane.x, std::max(0.0, plane.y)});
    return std::isfinite(turned.x) && std::isfinite(turned.y) ? turned : after;
  }

  /// The line up to now: a rectangle, of which only the end changes.
  void add_line(double x, std::vector<DrawItem>& items) const {
    // Cairo rounds places and lengths to 1/256 pixel. Both are multiples, so that the end that
    // stays has the same pixels in every frame.
    const double from = std::round(256 * from_x_) / 256;
    const double to = std::round(256 * std::clamp(x, map_.left(), map_.right())) / 256;
    const double width = 1.2 * diagram_.sizes().data_line;
    const Rect bounds{std::min(from, to), level() - width / 2, std::abs(to - from), width};
    items.emplace_back(RectangleItem{diagram_.moving(kLine), bounds, diagram_.palette().accent});
  }

  Diagram diagram_;
  double grid_px_;
  bool unfolds_;
  PhasedTitle title_;
  int rows_;  ///< of notes
  UnfoldedMap map_;
  std::vector<Mirror> mirrors_;
  Span span_;
  Integer size_;
  double from_x_;                   ///< where the line that is shown begins
  PlateItem static_items_;          ///< all that stays, over the wedge
  std::vector<PathItem> unfolded_;  ///< the mirrors, if they unfold one by one
  std::vector<DiscItem> dots_;      ///< of the mirrors that are met, from `first_dot_` on
  std::size_t first_dot_ = 0;
};

}  // namespace

Drawable unfolded_panel(const DrawingContext& context, const PanelPlace& place) {
  return {UnfoldedPanel(context, place)};
}

}  // namespace piblocks
