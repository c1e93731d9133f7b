#include <piblocks/error.hpp>

#include <algorithm>
#include <array>
#include <utility>

#include "draw/panels/panels.hpp"

namespace piblocks {
namespace {

Point from_to(const std::array<double, 2>& a, const std::array<double, 2>& b) {
  return {b[0] - a[0], b[1] - a[1]};
}

/// The squared distance of two discs in free flight: |d|^2 + 2 d.w s + |w|^2 s^2, s since they
/// touched.
struct Parabola {
  double touch = 0;  ///< time
  Point apart;       ///< d: from one centre to the other, then
  Point speed;       ///< w: its rate

  double at(double time) const {
    const double s = time - touch;
    return dot(apart, apart) + s * (2 * dot(apart, speed) + s * dot(speed, speed));
  }
  /// The other time of the same distance. They would be that far apart again, had they passed
  /// through each other.
  double part() const { return touch - 2 * dot(apart, speed) / dot(speed, speed); }
};

/// The two discs that meet first.
struct Meeting {
  std::size_t first = 0;
  std::size_t second = 0;
  Parabola before;
};

Meeting first_meeting(const Log& log, const Span& span) {
  const std::size_t bodies = log.system().bodies.size();
  const Integer last = log.count_at(span.to);
  for (Integer k = log.first_since(span.from); k <= last; ++k) {
    const Collision c = log.collision(k);
    if (c.second >= bodies) continue;
    Meeting meeting{c.first, c.second, {c.time.hi, {}, {}}};
    auto& [touch, apart, speed] = meeting.before;
    apart = from_to(c.first_after.position, c.second_after.position);
    speed = from_to(c.first_after.velocity, c.second_after.velocity);
    // It has reversed the speed along the line between the centres.
    speed = speed - 2 * dot(speed, apart) / dot(apart, apart) * apart;
    return meeting;
  }
  throw UsageError("show.panels",
                   "'separation' shows how two discs meet, and no two meet in this scene");
}

class SeparationPanel {
 public:
  SeparationPanel(const DrawingContext& context, const PanelPlace& place)
      : meeting_(first_meeting(context.log, span_of(context.scene, context.log))),
        diagram_(context, place,
                 context.setter().texts(
                     {"Squared distance of the centres: the discs touch at (r₁ + r₂)²",
                      "Squared distance: touch at (r₁ + r₂)²", "Squared distance"})),
        axis_(context, diagram_, 0) {
    const System& system = context.scene.system;
    const double reach =
        to_double(system.bodies[meeting_.first].size + system.bodies[meeting_.second].size);
    contact_ = reach * reach;
    const double begin = meeting_.before.at(to_double(axis_.span().from));
    top_ = std::clamp(1.15 * begin, 2.5 * contact_, 5 * contact_);
    add_level();
    add_parabola();
    add_path(context.log);
    add_touches(context.font);
    axis_.add_base(diagram_);
    diagram_.text("distance²", {axis_.plot().x, axis_.plot().y + 0.8 * diagram_.text_px()}, 0,
                  diagram_.palette().muted);
    diagram_.finish();
  }

  void operator()(const FrameState& shown, std::vector<DrawItem>& items) const {
    items.emplace_back(diagram_.item());
    const double time = to_double(shown.time);
    if (!axis_.shows(time)) return;
    const double square = square_of(shown.state.bodies);
    const Point at = place_of(time, std::min(square, top_));
    items.emplace_back(axis_.cursor(diagram_, 0, at));
    if (square <= top_) items.emplace_back(diagram_.present_dot(1, at));
  }

 private:
  static constexpr int kPoints = 240;
  /// Above the curves, for the name of what they show.
  static constexpr double kNameRoom_em = 1.3;

  double square_of(const std::vector<Motion>& bodies) const {
    const Point apart = from_to(bodies[meeting_.first].position, bodies[meeting_.second].position);
    return dot(apart, apart);
  }

  Point place_of(double time, double square) const {
    const double height = axis_.plot().height - kNameRoom_em * diagram_.text_px();
    return {axis_.x_of(time), axis_.bottom() - square / top_ * height};
  }

  /// The line at the square of the sum of the radii.
  void add_level() {
    const double y = place_of(0, contact_).y;
    const double em = diagram_.text_px();
    diagram_.line({{axis_.plot().x, y}, {axis_.right(), y}}, diagram_.palette().grid, 1, 4);
    diagram_.text("(r₁ + r₂)²", {axis_.plot().x, y - 0.4 * em}, 0, diagram_.palette().muted);
  }

  /// Calls `add` with lines through the places of a function that are in the diagram.
  void add_lines(double from, double to, const auto& square, const auto& add) const {
    std::vector<Point> points;
    for (int i = 0; i <= kPoints; ++i) {
      const double time = from + (to - from) * i / kPoints;
      const double value = square(time);
      if (value <= top_) points.push_back(place_of(time, value));
      if (value <= top_ && i < kPoints) continue;
      if (points.size() > 1) add(points);
      points.clear();
    }
  }

  /// The flight on, as if nothing were in the way.
  void add_parabola() {
    const double end =
        std::min(to_double(axis_.span().to),
                 meeting_.before.part() + (meeting_.before.part() - meeting_.before.touch));
    add_lines(
        meeting_.before.touch, end, [&](double t) { return meeting_.before.at(t); },
        [&](std::vector<Point> points) {
          diagram_.line(std::move(points), diagram_.palette().muted, 1, 3);
        });
  }

  /// The distance as it is.
  void add_path(const Log& log) {
    const double from = to_double(axis_.span().from);
    const double to = to_double(axis_.span().to);
    const auto add = [&](std::vector<Point> points) {
      diagram_.line(std::move(points), diagram_.palette().text, diagram_.data_width());
    };
    const auto square = [&](double time) {
      return square_of(log.state_at(Rational(std::clamp(time, from, to))).bodies);
    };
    if (meeting_.before.touch > from) add_lines(from, meeting_.before.touch, square, add);
    add_lines(meeting_.before.touch, to, square, add);
  }

  void add_touches(const Font& font) {
    const double em = diagram_.text_px();
    const Palette& palette = diagram_.palette();
    const double part = meeting_.before.part();
    const auto touch = [&](double time, const char* name, const Color& color, double anchor) {
      if (!axis_.shows(time)) return;
      const Point at = place_of(time, contact_);
      std::vector<Point> outline =
          Circle{at, style::kHitDot * diagram_.sizes().short_side}.arc(0, 2 * 3.14159265358979);
      diagram_.shape(std::move(outline), color);
      const double side = anchor > 0.5 ? -0.5 * em : 0.5 * em;
      const double left = at.x + side - anchor * font.width_em(name) * em;
      const Rect& inside = diagram_.inside();
      const bool has_room = left >= inside.x && left + font.width_em(name) * em <= inside.right();
      if (has_room) diagram_.text(name, {at.x + side, at.y + 1.1 * em}, anchor, color);
    };
    touch(meeting_.before.touch, "touch", palette.accent, 1);
    touch(part, "would part", palette.muted, 0);
  }

  Meeting meeting_;
  Diagram diagram_;
  TimeAxis axis_;
  double contact_ = 1;  ///< squared distance of the centres when they touch
  double top_ = 1;      ///< of the diagram
};

}  // namespace

Drawable separation_panel(const DrawingContext& context, const PanelPlace& place) {
  return {SeparationPanel(context, place)};
}

}  // namespace piblocks
