#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "draw/panels/panels.hpp"
#include "draw/panels/trajectory.hpp"

namespace piblocks {
namespace {

constexpr double kMargin_em = 0.8;
/// Lines between sectors begin where they are this far apart.
constexpr double kLeastApart_px = 4;

PanelTitle title_of(const DrawingContext& context) {
  const FormulaSetter set = context.setter();
  return {set.text(fmt::format("Velocities √m·v ({} →, {} ↑)", context.palette.red.full_name,
                               context.palette.blue.full_name)),
          set.text("Velocities √m·v")};
}

/// The velocities are a point on a circle. A collision of the blocks moves it by two wedge angles
/// to below the axis, and the wall mirrors it to above. Sector by sector both sides fill up.
class VelocityPanel {
 public:
  VelocityPanel(const DrawingContext& context, const PanelPlace& place)
      : diagram_(context, place, title_of(context)), wedge_(context.scene.system) {
    const BlockSystem& system = context.scene.system;
    const Rational energy = twice_energy(system);
    if (energy > 0) {
      moves_ = true;
      red_factor_ = root_of(system.red.mass / energy);
      blue_factor_ = root_of(system.blue.mass / energy);
      const Point start = point_of(to_double(system.blue.velocity), to_double(system.red.velocity));
      start_angle_ = std::abs(std::atan2(start.y, start.x));
    }
    const Rectangle& inside = diagram_.inside();
    const double em = diagram_.text_px();
    circle_ = {{inside.x + inside.width / 2, inside.y + inside.height / 2},
               std::min(inside.width, inside.height) / 2 - kMargin_em * em};
    place_sectors(context.log);
    add_axes();
    if (moves_) add_rays();
    diagram_.finish();
  }

  void operator()(const FrameState& shown, std::vector<DrawItem>& items) const {
    items.emplace_back(diagram_.item());
    if (!moves_) return;
    const Point velocity = point_of(shown.state.blue.velocity, shown.state.red.velocity);
    // Below the axis, sectors are lit up to the point. Above it, they are one collision behind
    // until blue meets the wall. After the last collision all are lit.
    const bool is_over = shown.state.count >= collisions_;
    const double angle = is_over ? 0 : std::abs(std::atan2(velocity.y, velocity.x));
    add_lit(angle, below_, 0, items);
    add_lit(velocity.y < 0 && !is_over ? angle + 2 * wedge_.theta : angle, above_, 1, items);
    if (rays_.plate) items.emplace_back(rays_);
    const Point at{circle_.centre.x + circle_.radius * velocity.x,
                   circle_.centre.y - circle_.radius * velocity.y};
    const Color accent = diagram_.palette().accent;
    items.emplace_back(diagram_.moving_line(3, {circle_.centre, at}, accent, 1.5));
    items.emplace_back(diagram_.dot(4, at, accent));
  }

 private:
  /// A point of the circle of radius 1.
  Point point_of(double blue_velocity, double red_velocity) const {
    return {mpf_class(red_factor_ * red_velocity).get_d(),
            mpf_class(blue_factor_ * blue_velocity).get_d()};
  }

  /// The sectors above or below the axis.
  struct Side {
    double sign;
    double swept;  ///< by all of its collisions together
  };

  Side side_of(const Integer& collisions, double sign) const {
    return {sign, std::min(2 * wedge_.angle(magnitude_of(Rational(collisions))), start_angle_)};
  }

  void place_sectors(const CollisionLog& log) {
    collisions_ = log.size();
    // If blue meets the wall first, that collision sweeps no sector.
    const bool wall_first = collisions_ > 0 && log.collision(1).kind == CollisionKind::wall;
    const Integer sweeping = collisions_ - (wall_first ? 1 : 0);
    below_ = side_of((sweeping + 1) / 2, -1);
    above_ = side_of(sweeping / 2, 1);
  }

  void add_axes() {
    const Palette& palette = diagram_.palette();
    const auto& [centre, radius] = circle_;
    const double reach = radius + 0.5 * diagram_.text_px();
    diagram_.line({{centre.x - reach, centre.y}, {centre.x + reach, centre.y}}, palette.grid);
    diagram_.line({{centre.x, centre.y - reach}, {centre.x, centre.y + reach}}, palette.grid);
    diagram_.shape(circle_.arc(0, 2 * std::numbers::pi), std::nullopt, palette.muted);
  }

  /// Rays between all sectors, lit or not, over what is lit. They are painted once.
  void add_rays() {
    const double inner = kLeastApart_px / (2 * wedge_.theta);
    if (inner > circle_.radius) return;
    Plate plate;
    for (const Side& side : {below_, above_}) {
      const double end = start_angle_ - side.swept - wedge_.theta / 2;
      for (double angle = start_angle_; angle > end; angle -= 2 * wedge_.theta) {
        const double at = side.sign * std::max(0.0, angle);
        plate.items.emplace_back(diagram_.moving_line(
            2, {Circle{circle_.centre, inner}.at(at), circle_.at(at)}, diagram_.palette().grid));
      }
    }
    rays_ = {diagram_.moving(2), diagram_.item().bounds,
             std::make_shared<const Plate>(std::move(plate))};
  }

  void add_lit(double angle, const Side& side, std::size_t n, std::vector<DrawItem>& items) const {
    const double end = std::max(angle, start_angle_ - side.swept);
    // A sector that is lit by less than half of itself is lit by rounding.
    if (end > start_angle_ - wedge_.theta / 2) return;
    std::vector<Point> outline = circle_.arc(side.sign * start_angle_, side.sign * end);
    outline.push_back(circle_.centre);
    items.emplace_back(diagram_.moving_shape(n, std::move(outline), diagram_.palette().shade));
  }

  Diagram diagram_;
  GapWedge wedge_;
  bool moves_ = false;
  // From a velocity to its part of the radius; they may be beyond the range of a double.
  mpf_class red_factor_;
  mpf_class blue_factor_;
  double start_angle_ = 0;
  Circle circle_;
  Integer collisions_;
  Side below_{};
  Side above_{};
  PlateItem rays_;
};

}  // namespace

Drawable velocity_panel(const DrawingContext& context, const PanelPlace& place) {
  return VelocityPanel(context, place);
}

}  // namespace piblocks
