#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "draw/panels/gaps.hpp"
#include "draw/panels/panels.hpp"

namespace piblocks {
namespace {

constexpr double kCircleStep = 0.05;  // radians between points of a circle: 0.03 % of its radius
constexpr double kMargin_em = 0.8;
/// Lines between sectors begin where they are so far apart.
constexpr double kLeastApart_px = 4;

PanelTitle title_of(const Palette& palette) {
  constexpr const char* kBrief = "Velocities √m·v";
  return {fmt::format("{} ({} →, {} ↑)", kBrief, palette.red.full_name, palette.blue.full_name),
          kBrief};
}

/// The velocities as a point of the plane whose distance from the origin never changes. A collision
/// of the blocks turns it by two wedge angles to below the axis, and the wall mirrors it to above:
/// on either side sector joins sector, until none fits any more.
class VelocityPanel {
 public:
  VelocityPanel(const Setting& setting, const PanelPlace& place)
      : sheet_(setting, place, title_of(setting.palette)), gaps_(setting.scene.system) {
    const BlockSystem& system = setting.scene.system;
    const Rational energy = twice_energy(system);
    if (energy > 0) {
      moves_ = true;
      red_factor_ = root_of(system.red.mass / energy);
      blue_factor_ = root_of(system.blue.mass / energy);
      const Point start = point_of(to_double(system.blue.velocity), to_double(system.red.velocity));
      start_angle_ = std::abs(std::atan2(start.y, start.x));
    }
    const Rectangle& inside = sheet_.inside();
    const double em = sheet_.text_px();
    centre_ = {inside.x + inside.width / 2, inside.y + inside.height / 2};
    radius_ = std::min(inside.width, inside.height) / 2 - kMargin_em * em;
    place_sectors(setting.log);
    add_axes();
    if (moves_) add_rays();
    sheet_.finish();
  }

  void operator()(const FrameState& shown, std::vector<DrawItem>& items) const {
    items.emplace_back(sheet_.item());
    if (!moves_) return;
    const Point velocity = point_of(shown.state.blue.velocity, shown.state.red.velocity);
    // The last point below the axis is as far along as the present one; the last one above it is a
    // collision behind until the wall is met. After the last collision every sector is lit, and the
    // point may be back in one.
    const bool is_over = shown.state.count >= collisions_;
    const double angle = is_over ? 0 : std::abs(std::atan2(velocity.y, velocity.x));
    add_lit(angle, below_, 0, items);
    add_lit(velocity.y < 0 && !is_over ? angle + 2 * gaps_.theta : angle, above_, 1, items);
    if (rays_.plate) items.emplace_back(rays_);
    const Point at{centre_.x + radius_ * velocity.x, centre_.y - radius_ * velocity.y};
    items.emplace_back(sheet_.moving_line(3, {centre_, at}, sheet_.palette().accent, 1.5));
    items.emplace_back(sheet_.dot(4, at, sheet_.palette().accent));
  }

 private:
  /// On the circle of radius 1.
  Point point_of(double blue_velocity, double red_velocity) const {
    return {mpf_class(red_factor_ * red_velocity).get_d(),
            mpf_class(blue_factor_ * blue_velocity).get_d()};
  }

  Point on_circle(double radius, double angle) const {
    return {centre_.x + radius * std::cos(angle), centre_.y - radius * std::sin(angle)};
  }
  Point on_rim(double angle) const { return on_circle(radius_, angle); }
  std::vector<Point> arc(double from, double to) const {
    std::vector<Point> points;
    const int steps = std::max(1, static_cast<int>(std::ceil(std::abs(to - from) / kCircleStep)));
    for (int i = 0; i <= steps; ++i) points.push_back(on_rim(from + (to - from) * i / steps));
    return points;
  }

  /// Sectors of this side that are reached, for `collisions` on it.
  struct Side {
    double sign;
    double swept;  ///< by all of its collisions together
  };

  Side side_of(const Integer& collisions, double sign) const {
    return {sign, std::min(2 * gaps_.angle(magnitude_of(Rational(collisions))), start_angle_)};
  }

  void place_sectors(const CollisionLog& log) {
    collisions_ = log.size();
    // Where blue meets the wall first, no sector is swept by that.
    const bool wall_first = collisions_ > 0 && log.collision(1).kind == CollisionKind::wall;
    const Integer sweeping = collisions_ - (wall_first ? 1 : 0);
    below_ = side_of((sweeping + 1) / 2, -1);
    above_ = side_of(sweeping / 2, 1);
  }

  void add_axes() {
    const Palette& palette = sheet_.palette();
    const double em = sheet_.text_px();
    const double reach = radius_ + 0.5 * em;
    sheet_.line({{centre_.x - reach, centre_.y}, {centre_.x + reach, centre_.y}}, palette.grid);
    sheet_.line({{centre_.x, centre_.y - reach}, {centre_.x, centre_.y + reach}}, palette.grid);
    sheet_.shape(arc(0, 2 * std::numbers::pi), std::nullopt, palette.muted);
  }

  /// Between all sectors, lit or not; they are over what is lit, and painted once.
  void add_rays() {
    const double inner = kLeastApart_px / (2 * gaps_.theta);
    if (inner > radius_) return;
    Plate plate;
    for (const Side& side : {below_, above_}) {
      const double end = start_angle_ - side.swept - gaps_.theta / 2;
      for (double angle = start_angle_; angle > end; angle -= 2 * gaps_.theta) {
        const double at = side.sign * std::max(0.0, angle);
        plate.items.emplace_back(
            sheet_.moving_line(2, {on_circle(inner, at), on_rim(at)}, sheet_.palette().grid));
      }
    }
    rays_ = {sheet_.moving(2), sheet_.item().bounds,
             std::make_shared<const Plate>(std::move(plate))};
  }

  void add_lit(double angle, const Side& side, std::size_t n, std::vector<DrawItem>& items) const {
    const double end = std::max(angle, start_angle_ - side.swept);
    // Of rounding: what is reached is reached by more than a hair.
    if (end > start_angle_ - gaps_.theta / 2) return;
    std::vector<Point> outline = arc(side.sign * start_angle_, side.sign * end);
    outline.push_back(centre_);
    items.emplace_back(sheet_.moving_shape(n, std::move(outline), sheet_.palette().shade));
  }

  PanelSheet sheet_;
  PanelGaps gaps_;
  bool moves_ = false;
  // From a velocity to its part of the circle's radius; they may be beyond a double.
  mpf_class red_factor_;
  mpf_class blue_factor_;
  double start_angle_ = 0;
  Point centre_;
  double radius_ = 0;
  Integer collisions_;
  Side below_{};
  Side above_{};
  PlateItem rays_;
};

}  // namespace

Drawable velocity_panel(const Setting& setting, const PanelPlace& place) {
  return VelocityPanel(setting, place);
}

}  // namespace piblocks
