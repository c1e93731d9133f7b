#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "draw/number_text.hpp"
#include "draw/panels/panels.hpp"
#include "draw/panels/trajectory.hpp"

namespace piblocks {
namespace {

constexpr double kLeastBetween_px = 6;  // between rays, at their ends
constexpr double kRimStep = 0.05;       // radians
constexpr double kBelowWedge_em = 1.5;

/// The angle by which a straight line turns around the origin from one of its points to another.
double angle_between(const Point& from, const Point& to) {
  // Products of long vectors would leave the range of a double.
  const auto direction = [](const Point& point) {
    const double length = std::hypot(point.x, point.y);
    return length > 0 ? Point{point.x / length, point.y / length} : Point{};
  };
  const Point a = direction(from);
  const Point b = direction(to);
  return std::atan2(a.x * b.y - a.y * b.x, a.x * b.x + a.y * b.y);
}

/// At each collision the wedge is reflected instead of the path. The wedges fill the half-plane,
/// and the path is a straight line, which crosses a ray at every collision.
class UnfoldedPanel {
 public:
  UnfoldedPanel(const DrawingContext& context, const PanelPlace& place)
      : wedge_(context.scene.system),
        diagram_(context, place,
                 {context.setter().text("Unfolded: a straight line"),
                  context.setter().text("Unfolded")}) {
    const BlockSystem& system = context.scene.system;
    start_ = {wedge_.cosine * to_double(system.blue_gap() + system.blocks_gap()),
              wedge_.sine * to_double(system.blue_gap())};
    velocity_ = {wedge_.cosine * to_double(system.red.velocity),
                 wedge_.sine * to_double(system.blue.velocity)};
    const Span span = span_of(context.scene, context.log);
    from_ = plane_at(to_double(span.from));
    const Point to = plane_at(to_double(span.to));
    most_ = std::max({std::hypot(from_.x, from_.y), std::hypot(to.x, to.y), 1e-300});
    tilt_to_hold(to);
    place_half_plane();
    add_rays();
    diagram_.line({at(from_), at(to)}, diagram_.palette().muted, 1, 4);
    diagram_.finish();
  }

  void operator()(const FrameState& shown, std::vector<DrawItem>& items) const {
    items.emplace_back(diagram_.item());
    const Point present = plane_at(to_double(shown.time));
    if (std::hypot(present.x, present.y) > most_ * (1 + 1e-9)) return;
    if (stride_exponent_ == 0) add_present_wedge(present, items);
    const Color accent = diagram_.palette().accent;
    items.emplace_back(diagram_.moving_line(1, {at(from_), at(present)}, accent, 2));
    items.emplace_back(diagram_.dot(2, at(present), accent));
  }

 private:
  /// Where the straight line is, as if no reflection came before the start.
  Point plane_at(double time) const {
    return {start_.x + velocity_.x * time, start_.y + velocity_.y * time};
  }
  Point at(const Point& plane) const {
    const double cos = std::cos(tilt_);
    const double sin = std::sin(tilt_);
    return {rim_.centre.x + scale_ * (plane.x * cos - plane.y * sin),
            rim_.centre.y - scale_ * (plane.x * sin + plane.y * cos)};
  }
  /// If blue does not begin at rest, the line may leave the upper half-plane. It never turns by
  /// more than half a turn, so that the plane can be turned until all of the line is seen.
  void tilt_to_hold(const Point& to) {
    from_angle_ = std::atan2(from_.y, from_.x);
    const double to_angle = from_angle_ + angle_between(from_, to);
    const auto [low, high] = std::minmax(from_angle_, to_angle);
    if (low < 0) tilt_ = -low;
    if (high > std::numbers::pi) tilt_ = std::numbers::pi - high;
  }

  void place_half_plane() {
    const Rectangle& inside = diagram_.inside();
    const double height = inside.height - kBelowWedge_em * diagram_.text_px();
    rim_.radius = std::min(inside.width / 2, height);
    scale_ = rim_.radius / most_;
    rim_.centre = {inside.x + inside.width / 2, inside.y + (height + rim_.radius) / 2};
  }

  void add_rays() {
    const double exponent =
        std::ceil(std::log10(kLeastBetween_px / rim_.radius) - wedge_.log10_theta());
    stride_exponent_ = static_cast<unsigned long>(std::max(0.0, exponent));
    const double step = wedge_.angle({1, static_cast<long>(stride_exponent_)});
    const Palette& palette = diagram_.palette();
    constexpr double kPi = std::numbers::pi;
    std::vector<Point> rays;
    for (double k = std::ceil(-tilt_ / step); tilt_ + k * step <= kPi * (1 + 1e-12); ++k) {
      rays.push_back(rim_.centre);
      rays.push_back(rim_.at(tilt_ + k * step));
    }
    diagram_.line(std::move(rays), palette.grid);
    std::vector<Point> rim;
    for (double angle = 0; angle < kPi; angle += kRimStep) rim.push_back(rim_.at(angle));
    rim.push_back(rim_.at(kPi));
    diagram_.shape(std::move(rim), std::nullopt, palette.muted);
    if (stride_exponent_ == 0) return;
    diagram_.text(fmt::format("1 ray in {}", short_text(Rational(power(10, stride_exponent_)))),
                  {rim_.centre.x, rim_.centre.y + 1.2 * diagram_.text_px()}, 0.5, palette.muted);
  }

  void add_present_wedge(const Point& present, std::vector<DrawItem>& items) const {
    const double k = std::floor((from_angle_ + angle_between(from_, present)) / wedge_.theta);
    const double begin = std::max(0.0, tilt_ + k * wedge_.theta);
    const double end = std::min(tilt_ + (k + 1) * wedge_.theta, std::numbers::pi);
    std::vector<Point> outline = rim_.arc(begin, end);
    outline.insert(outline.begin(), rim_.centre);
    items.emplace_back(diagram_.moving_shape(0, std::move(outline), diagram_.palette().shade,
                                             diagram_.palette().muted));
  }

  GapWedge wedge_;
  Diagram diagram_;
  Point start_;
  Point velocity_;
  Point from_;
  double most_ = 1;
  double scale_ = 1;
  Circle rim_;  ///< of the half-plane; angles are the plane's and the tilt
  double from_angle_ = 0;
  double tilt_ = 0;
  unsigned long stride_exponent_ = 0;  ///< 1 ray in 10^n is drawn, so that they are apart
};

}  // namespace

Drawable unfolded_panel(const DrawingContext& context, const PanelPlace& place) {
  return UnfoldedPanel(context, place);
}

}  // namespace piblocks
