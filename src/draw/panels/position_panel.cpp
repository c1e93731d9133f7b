#include <algorithm>
#include <numbers>

#include "draw/panels/panels.hpp"
#include "draw/panels/trajectory.hpp"

namespace piblocks {
namespace {

/// A wedge angle nearer to 0 or to a right angle could not be seen: half a right angle is drawn.
constexpr double kLeastAngle = 0.2;
constexpr double kBelow_em = 1.5;

/// From gaps to a place in the panel.
struct DrawnWedge {
  double slope;
  double most;  ///< greatest gap
  double scale;
  Point corner;

  Point at(const GapPoint& gaps) const {
    return {corner.x + scale * gaps.y2, corner.y - scale * slope * gaps.y1};
  }
};

DrawnWedge place_wedge(double slope, double greatest, const Diagram& diagram) {
  const Rectangle& inside = diagram.inside();
  const double height = inside.height - kBelow_em * diagram.text_px();
  const double most = greatest > 0 ? greatest : 1;
  const double scale = std::min(inside.width / most, height / (most * slope));
  return {slope, most, scale, {inside.x + (inside.width - scale * most) / 2, inside.y + height}};
}

void add_piece(const TrajectoryPiece& piece, const DrawnWedge& drawn, Diagram& diagram) {
  const Color& color = diagram.palette().text;
  std::vector<Point> points;
  if (piece.bands.empty()) {
    for (const TimedGaps& corner : piece.corners) points.push_back(drawn.at(corner.gaps));
    diagram.line(std::move(points), color);
    return;
  }
  const auto add_high = [&](double high, double y2) {
    points.push_back(drawn.at({std::min(high, y2), y2}));
  };
  for (const Band& band : piece.bands) add_high(band.high, band.from.gaps.y2);
  add_high(piece.bands.back().high, piece.bands.back().to.gaps.y2);
  for (auto band = piece.bands.rbegin(); band != piece.bands.rend(); ++band) {
    points.push_back(drawn.at({0, band->to.gaps.y2}));
  }
  points.push_back(drawn.at({0, piece.bands.front().from.gaps.y2}));
  diagram.shape(std::move(points), color, color);
}

}  // namespace

Drawable position_panel(const DrawingContext& context, const PanelPlace& place) {
  const GapWedge wedge(context.scene.system);
  const bool is_true = std::min(wedge.theta, std::numbers::pi / 2 - wedge.theta) >= kLeastAngle;
  Diagram diagram(context, place,
                  {context.setter().text(is_true ? "Positions √m·x" : "Positions (not to scale)"),
                   context.setter().text("Positions")});
  const Color muted = diagram.palette().muted;
  const double em = diagram.text_px();
  const int columns = std::max(1, static_cast<int>(diagram.inside().width));
  const auto pieces =
      trajectory_of(context.log, wedge, span_of(context.scene, context.log), columns);
  const double most = greatest_y2(pieces);
  const DrawnWedge drawn = place_wedge(is_true ? wedge.sine / wedge.cosine : 1, most, diagram);
  const Point corner = drawn.corner;
  const Point far = drawn.at({drawn.most, drawn.most});
  diagram.shape({corner, far, {far.x, corner.y}}, diagram.palette().shade);
  diagram.line({far, corner, {far.x, corner.y}}, muted, 1.5);
  for (const TrajectoryPiece& piece : pieces) add_piece(piece, drawn, diagram);
  const double wall_x = (corner.x + drawn.at({most, most}).x) / 2;
  diagram.text("wall", {wall_x, corner.y + 1.2 * em}, 0.5, muted);
  const Point contact = drawn.at({0.85 * most, 0.85 * most});
  diagram.text("contact", {contact.x - 0.6 * em, contact.y}, 1, muted);
  diagram.finish();
  return [=](const FrameState& shown, std::vector<DrawItem>& items) {
    items.emplace_back(diagram.item());
    const GapPoint gaps = wedge.gaps_of(shown.state);
    if (gaps.y2 > most * (1 + 1e-9)) return;
    items.emplace_back(diagram.dot(0, drawn.at(gaps), diagram.palette().accent));
  };
}

}  // namespace piblocks
