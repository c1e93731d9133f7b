#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "draw/panels/panels.hpp"
#include "draw/panels/trajectory.hpp"

namespace piblocks {
namespace {

// In ems.
constexpr double kNameTop_em = 0.78;     // of a name above its baseline
constexpr double kNameBottom_em = 0.22;  // and below
constexpr double kAroundName_em = 0.25;
constexpr double kNameStep_em = 0.2;

/// What each curve and name takes of each column of pixels, to place names beside the curves.
class TakenColumns {
 public:
  enum Layer : std::size_t { blue, red, names };

  explicit TakenColumns(const Rect& plot) : plot_(plot) {
    const auto columns = static_cast<std::size_t>(std::max(1.0, std::ceil(plot.width)));
    for (auto& layer : layers_) layer.resize(columns);
  }

  /// Adds lines from point to point.
  void add(Layer layer, const std::vector<Point>& points) {
    for (std::size_t i = 1; i < points.size(); ++i) add(layer, points[i - 1], points[i]);
  }

  bool is_free(const Rect& box) const {
    for (std::size_t i = column_of(box.x); i <= column_of(box.right()); ++i) {
      for (const auto& layer : layers_) {
        if (layer[i].high >= box.y && layer[i].low <= box.bottom()) return false;
      }
    }
    return true;
  }

  /// Where the curves are farthest from each other: a place on each, by its layer.
  std::array<Point, 2> farthest_apart() const {
    std::array<Point, 2> places{};
    double most = -1;
    for (std::size_t i = 0; i < layers_[blue].size(); ++i) {
      const double x = plot_.x + double(i);
      const std::array ys{layers_[blue][i].middle(), layers_[red][i].middle()};
      if (!(std::abs(ys[0] - ys[1]) > most)) continue;
      most = std::abs(ys[0] - ys[1]);
      places = {Point{x, ys[0]}, Point{x, ys[1]}};
    }
    return places;
  }

 private:
  /// Pixels between which something is drawn.
  struct Column {
    double middle() const { return (low + high) / 2; }
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();
  };

  std::size_t column_of(double x) const {
    return static_cast<std::size_t>(
        std::clamp(std::floor(x - plot_.x), 0.0, double(layers_[blue].size() - 1)));
  }
  void add(Layer layer, Point a, Point b) {
    if (a.x > b.x) std::swap(a, b);
    const bool is_upright = a.x == b.x;
    for (std::size_t i = column_of(a.x); i <= column_of(b.x); ++i) {
      const auto y_at = [&](double column) {
        const double x = std::clamp(plot_.x + column, a.x, b.x);
        return a.y + (b.y - a.y) * (x - a.x) / (b.x - a.x);
      };
      const double first = is_upright ? a.y : y_at(double(i));
      const double last = is_upright ? b.y : y_at(double(i) + 1);
      Column& column = layers_[layer][i];
      column.low = std::min({column.low, first, last});
      column.high = std::max({column.high, first, last});
    }
  }

  Rect plot_;
  std::array<std::vector<Column>, 3> layers_;
};

std::string capitalised(std::string name) {
  name[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(name[0])));
  return name;
}

std::vector<Formula> titles_of_time(const DrawingContext& context) {
  const FormulaSetter set = context.setter();
  const auto& [red, blue] = std::pair(context.palette.red, context.palette.blue);
  const Formula red_name = set.text(capitalised(red.full_name())).colored(red.label);
  const Formula blue_name = set.text(blue.full_name()).colored(blue.label);
  if (!shows_a_turn(context)) return set.texts({"Distances from the wall", "Distances"});
  return {red_name + set.text(" turns around; ") + blue_name + set.text(" bounces between"),
          set.text(capitalised(red.name)).colored(red.label) + set.text(" turns; ") +
              set.text(blue.name).colored(blue.label) + set.text(" bounces"),
          set.text("Distances")};
}

class TimePanel {
 public:
  TimePanel(const DrawingContext& context, const PanelPlace& place)
      : diagram_(context, place, titles_of_time(context)),
        blocks_(context.two_blocks().blocks()),
        wedge_(blocks_),
        axis_(context, diagram_, 0) {
    const int columns = std::max(1, static_cast<int>(std::ceil(axis_.plot().width)));
    const auto pieces = trajectory_of(context.two_blocks(), wedge_, axis_.span(), columns);
    top_ = greatest_y2(pieces);
    const Palette& palette = diagram_.palette();
    TakenColumns taken(axis_.plot());
    for (const TrajectoryPiece& piece : pieces) {
      std::vector<Point> points = outline_of(piece);
      taken.add(TakenColumns::blue, points);
      if (piece.bands.empty()) {
        diagram_.line(std::move(points), palette.blue.line, diagram_.data_width());
      } else {
        diagram_.shape(std::move(points), palette.blue.line, palette.blue.line);
      }
    }
    // Red's line is over what blue covers.
    std::vector<Point> red = red_line(pieces);
    taken.add(TakenColumns::red, red);
    diagram_.line(std::move(red), palette.red.line, diagram_.data_width());
    axis_.add_base(diagram_);
    add_names(taken);
    diagram_.finish();
  }

  void operator()(const FrameState& shown, std::vector<DrawItem>& items) const {
    items.emplace_back(diagram_.item());
    const double time = to_double(shown.time);
    if (!axis_.shows(time)) return;
    const Gaps gaps = wedge_.gaps_of(blocks_state(shown.state, blocks_));
    const Point red = at(time, gaps.y2);
    items.emplace_back(axis_.cursor(diagram_, 0, red));
    items.emplace_back(diagram_.dot(1, red, diagram_.palette().red.line));
    items.emplace_back(diagram_.dot(2, at(time, gaps.y1), diagram_.palette().blue.line));
  }

 private:
  Point at(double time, double gap) const {
    const double share = top_ > 0 ? gap / top_ : 0;
    return {axis_.x_of(time), axis_.bottom() - share * axis_.plot().height};
  }

  std::vector<Point> outline_of(const TrajectoryPiece& piece) const {
    std::vector<Point> points;
    if (piece.bands.empty()) {
      for (const auto& [time, gaps] : piece.corners) points.push_back(at(time, gaps.y1));
      return points;
    }
    for (const Band& band : piece.bands) {
      points.push_back(at(band.from.time, band.high));
      points.push_back(at(band.to.time, band.high));
    }
    points.push_back(at(piece.bands.back().to.time, 0));
    points.push_back(at(piece.bands.front().from.time, 0));
    return points;
  }

  std::vector<Point> red_line(const std::vector<TrajectoryPiece>& pieces) const {
    std::vector<Point> points;
    for (const TrajectoryPiece& piece : pieces) {
      for (const auto& [time, gaps] : piece.corners) points.push_back(at(time, gaps.y2));
      for (const Band& band : piece.bands) {
        if (points.empty()) points.push_back(at(band.from.time, band.from.gaps.y2));
        points.push_back(at(band.to.time, band.to.gaps.y2));
      }
    }
    return points;
  }

  /// Names both curves, and what they show, where nothing else is.
  void add_names(TakenColumns& taken) {
    const Palette& palette = diagram_.palette();
    const auto [on_blue, on_red] = taken.farthest_apart();
    add_name({palette.red.name, on_red, palette.red.label}, taken);
    add_name({palette.blue.name, on_blue, palette.blue.label}, taken);
    const Rect& plot = axis_.plot();
    add_name({"distance from the wall", {plot.x + plot.width / 2, plot.y}, palette.muted}, taken);
  }

  struct Name {
    std::string text;
    Point near;
    Color color;
  };

  /// Puts a name as near to its place as nothing else is; leaves it out if there is no room.
  void add_name(const Name& name, TakenColumns& taken) {
    const double em = diagram_.text_px();
    const double around = kAroundName_em * em;
    const Rect& plot = axis_.plot();
    const double width = diagram_.setter().text(name.text).width_em() * em + 2 * around;
    const double height = (kNameTop_em + kNameBottom_em) * em + 2 * around;
    std::optional<Rect> best;
    double least = std::numeric_limits<double>::infinity();
    const double step = std::max(2.0, kNameStep_em * em);
    for (double x = plot.x; x + width <= plot.right(); x += step) {
      for (double y = plot.y; y + height <= axis_.bottom(); y += step) {
        const Rect box{x, y, width, height};
        const double far = length(box.centre() - name.near);
        if (far >= least || !taken.is_free(box)) continue;
        least = far;
        best = box;
      }
    }
    if (!best) return;
    diagram_.text(name.text, {best->x + around, best->y + around + kNameTop_em * em}, 0,
                  name.color);
    const std::vector<Point> corners = best->corners();
    taken.add(TakenColumns::names, {corners[0], corners[1]});
    taken.add(TakenColumns::names, {corners[3], corners[2]});
  }

  Diagram diagram_;
  TwoBlocks blocks_;
  GapWedge wedge_;
  TimeAxis axis_;
  double top_ = 0;  ///< red's greatest gap
};

/// More collisions than this for each column of pixels are not shown one by one.
constexpr double kCornersPerColumn = 4;

/// Where each block of a line is.
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

Drawable time_panel(const DrawingContext& context, const PanelPlace& place) {
  if (context.pair() == nullptr) return {PositionsPanel(context, place)};
  return {TimePanel(context, place)};
}

}  // namespace piblocks
