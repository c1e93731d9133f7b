#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "draw/panels/panels.hpp"

namespace piblocks {
namespace {

/// A path of more corners than this for each column of pixels is sampled once a column.
constexpr std::size_t kCornersPerColumn = 4;

/// A place of a body's centre.
struct Corner {
  double time;
  double position;
};

class PositionsPanel {
 public:
  PositionsPanel(const DrawingContext& context, const PanelPlace& place)
      : diagram_(context, place, titles(context)),
        axis_(context, diagram_, 0),
        low_(to_double(context.scene.view.x.low)),
        high_(to_double(context.scene.view.x.high)) {
    const BodySystem& system = context.bodies.system;
    const std::vector<std::vector<Corner>> paths = paths_of(context.log);
    for (std::size_t i = 0; i < paths.size(); ++i) {
      half_widths_.push_back(to_double(system.bodies[i].size) / 2);
      add_band(paths[i], half_widths_.back(), context.colors[i]);
    }
    for (const Wall& wall : system.walls) {
      const double y = y_of(to_double(wall.point[0]));
      diagram_.line({{axis_.plot().x, y}, {axis_.right(), y}}, diagram_.palette().wall,
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
  static std::vector<Formula> titles(const DrawingContext& context) {
    const FormulaSetter set = context.setter();
    return {set.text("Where each block is: they collide where the bands meet"),
            set.text("Each block's place against time"), set.text("Positions")};
  }

  double y_of(double position) const {
    const double share = std::clamp((position - low_) / (high_ - low_), 0.0, 1.0);
    return axis_.bottom() - share * axis_.plot().height;
  }

  /// The corners of each body's path while the scene is shown.
  std::vector<std::vector<Corner>> paths_of(const Log& log) const {
    const Span& span = axis_.span();
    const auto columns = static_cast<std::size_t>(std::max(1.0, std::ceil(axis_.plot().width)));
    const BodiesState first = log.state_at(span.from);
    const BodiesState last = log.state_at(span.to);
    const std::size_t bodies = first.bodies.size();
    const Integer collisions = last.count - first.count;
    std::vector<std::vector<Corner>> paths(bodies);
    const auto add = [&](const Rational& time, const BodiesState& state) {
      for (std::size_t i = 0; i < bodies; ++i) {
        paths[i].push_back({to_double(time), state.bodies[i].position[0]});
      }
    };
    add(span.from, first);
    if (collisions > Integer(kCornersPerColumn * columns * bodies)) {
      for (std::size_t column = 1; column < columns; ++column) {
        const Rational time = span.from + (span.to - span.from) * Rational(column, columns);
        add(time, log.state_at(time));
      }
    } else {
      for (Integer k = first.count + 1; k <= last.count && k <= log.last(); ++k) {
        const BodyCollision c = log.collision(k);
        for (const auto& [id, motion] :
             {std::pair(c.first, c.first_after), std::pair(c.second, c.second_after)}) {
          if (id < bodies) paths[id].push_back({c.time.hi, motion.position[0]});
        }
      }
    }
    add(span.to, last);
    return paths;
  }

  void add_band(const std::vector<Corner>& path, double half_width, const BlockColors& colors) {
    std::vector<Point> outline = edge(path, half_width);
    const std::vector<Point> lower = edge(path, -half_width);
    outline.insert(outline.end(), lower.rbegin(), lower.rend());
    diagram_.shape(std::move(outline), colors.fill, colors.edge);
  }

  /// An edge of a band, with a corner wherever it leaves the diagram.
  std::vector<Point> edge(const std::vector<Corner>& path, double shift) const {
    std::vector<Point> points;
    for (std::size_t i = 0; i < path.size(); ++i) {
      const auto& [time, centre] = path[i];
      const double position = centre + shift;
      if (i > 0) {
        const double before = path[i - 1].position + shift;
        std::array ends = {low_, high_};
        if (before > position) std::swap(ends[0], ends[1]);
        for (const double end : ends) {
          if ((before < end) == (position < end)) continue;
          const double share = (end - before) / (position - before);
          const double then = path[i - 1].time + share * (time - path[i - 1].time);
          points.push_back({axis_.x_of(then), y_of(end)});
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
  std::vector<double> half_widths_;
};

}  // namespace

Drawable positions_panel(const DrawingContext& context, const PanelPlace& place) {
  return PositionsPanel(context, place);
}

}  // namespace piblocks
