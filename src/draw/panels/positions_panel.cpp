#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "draw/panels/panels.hpp"

namespace piblocks {
namespace {

/// More collisions than this for each column of pixels are not shown one by one.
constexpr double kCornersPerColumn = 4;

class PositionsPanel {
 public:
  PositionsPanel(const DrawingContext& context, const PanelPlace& place)
      : diagram_(context, place,
                 context.setter().texts({"Where each block is: they collide where the bands meet",
                                         "Each block's place against time", "Positions"})),
        axis_(context, diagram_, 0),
        low_(to_double(context.scene.view.x.low)),
        high_(to_double(context.scene.view.x.high)) {
    const System& system = context.scene.system;
    const Span& span = axis_.span();
    const double corners = kCornersPerColumn * std::max(1.0, std::ceil(axis_.plot().width));
    const std::vector<std::vector<PathPoint>> paths =
        context.log.paths(span.from, span.to, static_cast<std::size_t>(corners));
    for (std::size_t i = 0; i < paths.size(); ++i) {
      add_band(paths[i], to_double(system.bodies[i].size) / 2, context.colors[i]);
    }
    for (const Wall& wall : system.walls) {
      const auto at = [&](const Rational& time) {
        const Rational face = wall.point[0] + wall.velocity[0] * time;
        return PathPoint{to_double(Rational(time - span.from)), {to_double(face), 0}};
      };
      diagram_.line(edge({at(span.from), at(span.to)}, 0), diagram_.palette().wall,
                    diagram_.data_width());
    }
    axis_.add_base(diagram_);
    diagram_.finish();
  }

  void operator()(const FrameState& shown, std::vector<DrawItem>& items) const {
    items.emplace_back(diagram_.item());
    const double time = to_double(shown.time);
    if (!axis_.shows(time)) return;
    items.emplace_back(axis_.cursor(diagram_, 0, {axis_.x_of(time), axis_.plot().y}));
    for (std::size_t i = 0; i < shown.state.bodies.size(); ++i) {
      const double position = shown.state.bodies[i].position[0];
      if (position < low_ || position > high_) continue;
      items.emplace_back(
          diagram_.dot(1 + i, {axis_.x_of(time), y_of(position)}, diagram_.palette().text));
    }
  }

 private:
  double y_of(double position) const {
    const double share = std::clamp((position - low_) / (high_ - low_), 0.0, 1.0);
    return axis_.bottom() - share * axis_.plot().height;
  }

  void add_band(const std::vector<PathPoint>& path, double half_width, const BlockColors& colors) {
    std::vector<Point> outline = edge(path, half_width);
    const std::vector<Point> lower = edge(path, -half_width);
    outline.insert(outline.end(), lower.rbegin(), lower.rend());
    diagram_.shape(std::move(outline), colors.fill, colors.edge);
  }

  /// An edge of a band, with a corner wherever it leaves the diagram.
  std::vector<Point> edge(const std::vector<PathPoint>& path, double shift) const {
    const double begin = to_double(axis_.span().from);
    std::vector<Point> points;
    for (std::size_t i = 0; i < path.size(); ++i) {
      const double time = begin + path[i].after;
      const double position = path[i].position[0] + shift;
      if (i > 0) {
        const double earlier = begin + path[i - 1].after;
        const double before = path[i - 1].position[0] + shift;
        std::array ends = {low_, high_};
        if (before > position) std::swap(ends[0], ends[1]);
        for (const double end : ends) {
          if ((before < end) == (position < end)) continue;
          const double share = (end - before) / (position - before);
          points.push_back({axis_.x_of(earlier + share * (time - earlier)), y_of(end)});
        }
      }
      points.push_back({axis_.x_of(time), y_of(position)});
    }
    return points;
  }

  Diagram diagram_;
  TimeAxis axis_;
  double low_;
  double high_;
};

}  // namespace

Drawable positions_panel(const DrawingContext& context, const PanelPlace& place) {
  return {PositionsPanel(context, place)};
}

}  // namespace piblocks
