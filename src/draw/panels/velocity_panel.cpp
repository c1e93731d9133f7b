#include <algorithm>
#include <cmath>
#include <numbers>

#include "draw/panels/gaps.hpp"
#include "draw/panels/panels.hpp"

namespace piblocks {
namespace {

constexpr double kCircleStep = 0.05;  // radians between points of a circle: 0.03 % of its radius
constexpr double kMargin_em = 0.8;
/// Sectors are drawn one by one while there are at most so many, and otherwise in groups.
constexpr long kMostSectors = 120;
constexpr double kLeastApart_px = 5;

std::vector<Point> arc(const Point& centre, double radius, double from, double to) {
  std::vector<Point> points;
  const int steps = std::max(1, static_cast<int>(std::ceil(std::abs(to - from) / kCircleStep)));
  for (int i = 0; i <= steps; ++i) {
    const double angle = from + (to - from) * i / steps;
    points.push_back({centre.x + radius * std::cos(angle), centre.y - radius * std::sin(angle)});
  }
  return points;
}

/// The velocities as a point of the plane whose distance from the origin never changes. Every
/// collision of the blocks turns it by two wedge angles, and the wall mirrors it: above and below
/// the axis sector joins sector, until none fits any more.
class VelocityPanel final : public Part {
 public:
  VelocityPanel(const Setting& setting, const PanelPlace& place)
      : sheet_(setting, place, "Velocities √m·v (red →, blue ↑)"), gaps_(setting.scene.system) {
    const BlockSystem& system = setting.scene.system;
    const Point start = point_of(to_double(system.blue.velocity), to_double(system.red.velocity));
    speed_ = std::hypot(start.x, start.y);
    start_angle_ = speed_ > 0 ? std::abs(std::atan2(start.y, start.x)) : 0;
    const Rectangle& inside = sheet_.inside();
    const double em = sheet_.text_px();
    centre_ = {inside.x + inside.width / 2, inside.y + inside.height / 2};
    radius_ = std::min(inside.width, inside.height) / 2 - kMargin_em * em;
    make_sectors(setting.log);
    add_axes();
  }

  void add(const Shown& shown, std::vector<DrawItem>& items) const override {
    sheet_.add_to(items);
    if (!(speed_ > 0)) return;
    const Point velocity = point_of(shown.state.blue.velocity, shown.state.red.velocity);
    // The last point above the axis is as far along as the present one. So is the last one below it
    // once the wall was met; before that it is a collision behind.
    const double angle = std::abs(std::atan2(velocity.y, velocity.x));
    const bool below = velocity.y < 0;
    add_lit(angle, above_, 1, items);
    add_lit(below ? angle : angle + 2 * gaps_.theta, below_, 1 + above_.size(), items);
    const Point at{centre_.x + radius_ * velocity.x / speed_,
                   centre_.y - radius_ * velocity.y / speed_};
    const std::size_t last = 1 + above_.size() + below_.size();
    items.emplace_back(PathItem{sheet_.moving(last), std::vector<Point>{centre_, at}, false,
                                std::nullopt,
                                Stroke{sheet_.palette().accent, 1.5 * sheet_.line_px()}});
    items.emplace_back(sheet_.dot(last + 1, at, sheet_.palette().accent));
  }

 private:
  struct Sector {
    double end_angle;  ///< lit when this is reached
    Points outline;
  };

  Point point_of(double blue_velocity, double red_velocity) const {
    return {red_velocity, gaps_.sigma * blue_velocity};
  }

  /// From the start's angle down, above the axis or below it: one for each of `count` collisions,
  /// or as many as can be told apart.
  std::vector<Sector> sectors_of(const Integer& count, double side) const {
    const double swept = std::min(2 * gaps_.theta * count.get_d(), start_angle_);
    const long shown = count <= kMostSectors ? count.get_si() : kMostSectors;
    std::vector<Sector> sectors;
    for (long k = 0; k < shown; ++k) {
      const double from = start_angle_ - swept * static_cast<double>(k) / double(shown);
      const double to = start_angle_ - swept * static_cast<double>(k + 1) / double(shown);
      std::vector<Point> outline = arc(centre_, radius_, side * from, side * to);
      outline.push_back(centre_);
      sectors.push_back({to, std::move(outline)});
    }
    return sectors;
  }

  void make_sectors(const CollisionLog& log) {
    if (!(speed_ > 0)) return;
    above_ = sectors_of((log.size() + 1) / 2, 1);
    below_ = sectors_of(log.size() / 2, -1);
    is_apart_ = !above_.empty() &&
                start_angle_ / static_cast<double>(above_.size()) * radius_ > kLeastApart_px;
  }

  void add_axes() {
    const Palette& palette = sheet_.palette();
    const double em = sheet_.text_px();
    const double reach = radius_ + 0.5 * em;
    sheet_.line({{centre_.x - reach, centre_.y}, {centre_.x + reach, centre_.y}}, palette.grid);
    sheet_.line({{centre_.x, centre_.y - reach}, {centre_.x, centre_.y + reach}}, palette.grid);
    sheet_.path(arc(centre_, radius_, 0, 2 * std::numbers::pi), true, std::nullopt,
                Stroke{palette.muted, sheet_.line_px()});
  }

  void add_lit(double angle, const std::vector<Sector>& sectors, std::size_t first,
               std::vector<DrawItem>& items) const {
    const double slack = gaps_.theta / 2;  // of rounding: what is reached is reached by all of it
    for (std::size_t k = 0; k < sectors.size(); ++k) {
      if (angle > sectors[k].end_angle + slack) return;
      const Color& edge = is_apart_ ? sheet_.palette().grid : sheet_.palette().shade;
      items.emplace_back(PathItem{sheet_.moving(first + k), sectors[k].outline, true,
                                  sheet_.palette().shade, Stroke{edge, sheet_.line_px()}});
    }
  }

  PanelSheet sheet_;
  Gaps gaps_;
  double speed_ = 0;
  double start_angle_ = 0;
  Point centre_;
  double radius_ = 0;
  std::vector<Sector> above_;
  std::vector<Sector> below_;
  bool is_apart_ = false;  ///< whether sectors are wide enough for lines between them
};

}  // namespace

std::unique_ptr<Part> velocity_panel(const Setting& setting, const PanelPlace& place) {
  return std::make_unique<VelocityPanel>(setting, place);
}

}  // namespace piblocks
