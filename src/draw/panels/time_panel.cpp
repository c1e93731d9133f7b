#include <algorithm>
#include <cmath>

#include "draw/panels/panels.hpp"
#include "draw/panels/trajectory.hpp"
#include "scene/schedule.hpp"

namespace piblocks {
namespace {

class TimePanel {
 public:
  TimePanel(const DrawingContext& context, const PanelPlace& place)
      : diagram_(context, place, {"Distance from the wall", "Distances"}),
        wedge_(context.scene.system),
        axis_(context, diagram_, 0) {
    const int columns = std::max(1, static_cast<int>(std::ceil(axis_.plot().width)));
    const auto pieces =
        trajectory_of(context.log, wedge_, {axis_.span().from, axis_.span().to, columns});
    top_ = greatest_y2(pieces);
    // Red's line is over what blue covers.
    for (const TrajectoryPiece& piece : pieces) add_blue(piece);
    add_red(pieces);
    axis_.add_base(diagram_);
    diagram_.finish();
  }

  void operator()(const FrameState& shown, std::vector<DrawItem>& items) const {
    items.emplace_back(diagram_.item());
    const double x = axis_.x_of(to_double(shown.time));
    if (!axis_.shows(x)) return;
    const GapPoint gaps = wedge_.gaps_of(shown.state);
    items.emplace_back(axis_.cursor(diagram_, x));
    items.emplace_back(diagram_.dot(1, {x, y_of(gaps.y2)}, diagram_.palette().red.line));
    items.emplace_back(diagram_.dot(2, {x, y_of(gaps.y1)}, diagram_.palette().blue.line));
  }

 private:
  double y_of(double gap) const {
    return axis_.bottom() - (top_ > 0 ? gap / top_ : 0) * axis_.plot().height;
  }
  Point at(double time, double gap) const { return {axis_.x_of(time), y_of(gap)}; }

  void add_blue(const TrajectoryPiece& piece) {
    const Color color = diagram_.palette().blue.line;
    std::vector<Point> points;
    if (piece.bands.empty()) {
      for (const TimedGaps& corner : piece.corners) {
        points.push_back(at(corner.time, corner.gaps.y1));
      }
      diagram_.line(std::move(points), color);
      return;
    }
    for (const Band& band : piece.bands) {
      points.push_back(at(band.from.time, band.high));
      points.push_back(at(band.to.time, band.high));
    }
    points.push_back(at(piece.bands.back().to.time, 0));
    points.push_back(at(piece.bands.front().from.time, 0));
    diagram_.shape(std::move(points), color, color);
  }

  void add_red(const std::vector<TrajectoryPiece>& pieces) {
    std::vector<Point> points;
    for (const TrajectoryPiece& piece : pieces) {
      for (const TimedGaps& corner : piece.corners) {
        points.push_back(at(corner.time, corner.gaps.y2));
      }
      for (const Band& band : piece.bands) {
        if (points.empty()) points.push_back(at(band.from.time, band.from.gaps.y2));
        points.push_back(at(band.to.time, band.to.gaps.y2));
      }
    }
    diagram_.line(std::move(points), diagram_.palette().red.line, 2);
  }

  Diagram diagram_;
  Wedge wedge_;
  TimeAxis axis_;
  double top_ = 0;
};

}  // namespace

Drawable time_panel(const DrawingContext& context, const PanelPlace& place) {
  return TimePanel(context, place);
}

}  // namespace piblocks
