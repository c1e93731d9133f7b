#include <algorithm>
#include <cmath>
#include <numbers>

#include "draw/panels/panels.hpp"
#include "draw/panels/trajectory.hpp"
#include "scene/schedule.hpp"

namespace piblocks {
namespace {

/// A wedge angle so near to 0 or to a right angle could not be seen. The wedge is then drawn as
/// half a right angle.
constexpr double kLeastAngle = 0.2;
constexpr double kBelow_em = 1.5;

class PositionPanel {
 public:
  PositionPanel(const DrawingContext& context, const PanelPlace& place)
      : wedge_(context.scene.system),
        is_true_(std::min(wedge_.theta, std::numbers::pi / 2 - wedge_.theta) >= kLeastAngle),
        diagram_(context, place,
                 {is_true_ ? "Positions √m·x" : "Positions (not to scale)", "Positions"}) {
    const auto [from, to] = span_of(context.scene, context.log);
    const int columns = std::max(1, static_cast<int>(diagram_.inside().width));
    const auto pieces = trajectory_of(context.log, wedge_, {from, to, columns});
    most_ = greatest_y2(pieces);
    place_wedge();
    for (const TrajectoryPiece& piece : pieces) add_piece(piece);
    add_names();
    diagram_.finish();
  }

  void operator()(const FrameState& shown, std::vector<DrawItem>& items) const {
    items.emplace_back(diagram_.item());
    const GapPoint gaps = wedge_.gaps_of(shown.state);
    if (gaps.y2 > most_ * (1 + 1e-9)) return;
    items.emplace_back(diagram_.dot(0, at(gaps), diagram_.palette().accent));
  }

 private:
  double slope() const { return is_true_ ? wedge_.sine / wedge_.cosine : 1; }

  void place_wedge() {
    const Rectangle& inside = diagram_.inside();
    const double height = inside.height - kBelow_em * diagram_.text_px();
    const double most = most_ > 0 ? most_ : 1;
    scale_ = std::min(inside.width / most, height / (most * slope()));
    corner_ = {inside.x + (inside.width - scale_ * most) / 2, inside.y + height};
    const Point far = at({most, most});
    diagram_.shape({corner_, far, {far.x, corner_.y}}, diagram_.palette().shade);
    diagram_.line({far, corner_, {far.x, corner_.y}}, diagram_.palette().muted, 1.5);
  }

  Point at(const GapPoint& gaps) const {
    return {corner_.x + scale_ * gaps.y2, corner_.y - scale_ * slope() * gaps.y1};
  }

  void add_piece(const TrajectoryPiece& piece) {
    const Color& color = diagram_.palette().text;
    std::vector<Point> points;
    if (piece.bands.empty()) {
      for (const TimedGaps& corner : piece.corners) points.push_back(at(corner.gaps));
      diagram_.line(std::move(points), color);
      return;
    }
    for (const Band& band : piece.bands) {
      points.push_back(at({std::min(band.high, band.from.gaps.y2), band.from.gaps.y2}));
    }
    const Band& last = piece.bands.back();
    points.push_back(at({std::min(last.high, last.to.gaps.y2), last.to.gaps.y2}));
    for (auto band = piece.bands.rbegin(); band != piece.bands.rend(); ++band) {
      points.push_back(at({0, band->to.gaps.y2}));
    }
    points.push_back(at({0, piece.bands.front().from.gaps.y2}));
    diagram_.shape(std::move(points), color, color);
  }

  void add_names() {
    const double em = diagram_.text_px();
    const Point far = at({most_, most_});
    diagram_.text("wall", {(corner_.x + far.x) / 2, corner_.y + 1.2 * em}, 0.5,
                  diagram_.palette().muted);
    const Point beside = at({0.85 * most_, 0.85 * most_});
    diagram_.text("contact", {beside.x - 0.6 * em, beside.y}, 1, diagram_.palette().muted);
  }

  Wedge wedge_;
  bool is_true_;
  Diagram diagram_;
  double most_ = 0;
  double scale_ = 1;
  Point corner_;
};

}  // namespace

Drawable position_panel(const DrawingContext& context, const PanelPlace& place) {
  return PositionPanel(context, place);
}

}  // namespace piblocks
