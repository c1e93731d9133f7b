#include <algorithm>

#include "draw/panels/panels.hpp"
#include "draw/panels/trajectory.hpp"

namespace piblocks {
namespace {

/// From a time and a gap to a place in the panel.
using ToPlace = std::function<Point(double time, double gap)>;

void add_blue(const TrajectoryPiece& piece, const ToPlace& at, Diagram& diagram) {
  const Color color = diagram.palette().blue.line;
  std::vector<Point> points;
  if (piece.bands.empty()) {
    for (const auto& [time, gaps] : piece.corners) points.push_back(at(time, gaps.y1));
    diagram.line(std::move(points), color);
    return;
  }
  for (const Band& band : piece.bands) {
    points.push_back(at(band.from.time, band.high));
    points.push_back(at(band.to.time, band.high));
  }
  points.push_back(at(piece.bands.back().to.time, 0));
  points.push_back(at(piece.bands.front().from.time, 0));
  diagram.shape(std::move(points), color, color);
}

void add_red(const std::vector<TrajectoryPiece>& pieces, const ToPlace& at, Diagram& diagram) {
  std::vector<Point> points;
  for (const TrajectoryPiece& piece : pieces) {
    for (const auto& [time, gaps] : piece.corners) points.push_back(at(time, gaps.y2));
    for (const Band& band : piece.bands) {
      if (points.empty()) points.push_back(at(band.from.time, band.from.gaps.y2));
      points.push_back(at(band.to.time, band.to.gaps.y2));
    }
  }
  diagram.line(std::move(points), diagram.palette().red.line, 2);
}

}  // namespace

Drawable time_panel(const DrawingContext& context, const PanelPlace& place) {
  Diagram diagram(
      context, place,
      {context.setter().text("Distance from the wall"), context.setter().text("Distances")});
  const GapWedge wedge(context.scene.system);
  const TimeAxis axis(context, diagram, 0);
  const int columns = std::max(1, static_cast<int>(std::ceil(axis.plot().width)));
  const auto pieces = trajectory_of(context.log, wedge, axis.span(), columns);
  const double top = greatest_y2(pieces);
  const auto at = [axis, top](double time, double gap) {
    const double share = top > 0 ? gap / top : 0;
    return Point{axis.x_of(time), axis.bottom() - share * axis.plot().height};
  };
  // Red's line is over what blue covers.
  for (const TrajectoryPiece& piece : pieces) add_blue(piece, at, diagram);
  add_red(pieces, at, diagram);
  axis.add_base(diagram);
  diagram.finish();
  return [=](const FrameState& shown, std::vector<DrawItem>& items) {
    items.emplace_back(diagram.item());
    const double time = to_double(shown.time);
    if (!axis.shows(time)) return;
    const GapPoint gaps = wedge.gaps_of(shown.state);
    items.emplace_back(axis.cursor(diagram, 0, time));
    items.emplace_back(diagram.dot(1, at(time, gaps.y2), diagram.palette().red.line));
    items.emplace_back(diagram.dot(2, at(time, gaps.y1), diagram.palette().blue.line));
  };
}

}  // namespace piblocks
