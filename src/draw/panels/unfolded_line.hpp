// The unfolded wedges and the straight line through them, laid out in a rectangle, and what panels
// say about them.
// In: a scene, its log, a rectangle. Out: where in pixels the line and its mirrors are; formulas.
#pragma once

#include <piblocks/scene.hpp>
#include <piblocks/two_blocks.hpp>

#include <optional>
#include <vector>

#include "draw/draw_list.hpp"
#include "draw/panels/panels.hpp"
#include "draw/panels/trajectory.hpp"

namespace piblocks {

/// The line, turned about the corner so that it is level and above it. Lengths are those of the
/// plane with axes (sqrt(m) x gap), divided by the root of the sum of both masses.
class StraightLine {
 public:
  explicit StraightLine(const TwoBlocks& system);

  /// False if neither block moves: then the line is a point.
  bool moves() const noexcept { return velocity_ != 0; }
  /// Whether it goes through the corner, in which all collisions happen at once.
  bool meets_corner() const noexcept { return height_ == 0; }
  /// Distance from the corner.
  double height() const noexcept { return height_; }
  /// How far to the right of the corner the point is at a time.
  double at(const Rational& time) const;
  /// How far a place near the corner may be off if its time is rounded as those of collisions are.
  double rounding() const;
  /// When it is there. Only if it moves.
  Rational time_at(double position) const;
  /// < 0 if the point moves to the left, as it does unless it turns clockwise about the corner.
  double velocity() const noexcept { return velocity_; }
  /// Of the ray on which blue meets the wall before all reflections, counter-clockwise.
  double first_ray() const noexcept { return first_ray_; }
  double theta() const noexcept { return wedge_.theta; }

 private:
  GapWedge wedge_;
  double start_ = 0;  ///< position of a point that does not move
  double velocity_ = 0;
  double height_ = 0;
  double first_ray_ = 0;
  Rational turn_;
};

/// A ray from the corner, which the line crosses at a collision.
struct Mirror {
  Integer index;  ///< of the collision
  CollisionKind kind = CollisionKind::wall;
  double x = 0;         ///< of the crossing, in pixels
  bool is_met = true;   ///< within the time that the scene shows
  double apart_px = 0;  ///< distance to the nearest of the other crossings listed
  Point towards = {};   ///< direction of the ray in the picture, y up
};

/// A map from the plane to pixels. Angles are true where all crossings have room then; mirrors end
/// at an arc around the corner, or where they are crossed. Else it keeps straight lines straight,
/// and stretches heights so that the line is at a fifth of the area's height.
class UnfoldedMap {
 public:
  /// @param margin_px  left and right of what is shown, and the least height of a line that has
  /// true
  ///                   angles
  /// @param arc_px     the arc's radius, at most
  /// @throws Error as PairLog::time_after(), where collisions are that near to each other.
  UnfoldedMap(const Scene& scene, const PairLog& log, const Rect& area, double margin_px,
              double arc_px);

  const StraightLine& line() const noexcept { return line_; }
  const Rect& area() const noexcept { return area_; }
  double base_y() const noexcept { return area_.bottom(); }
  double line_y() const noexcept { return base_y() - level_px_; }
  Point corner() const noexcept { return {corner_x_, base_y()}; }
  double x_at(double position) const noexcept { return corner_x_ + scale_ * position; }
  double x_at(const Rational& time) const { return x_at(line_.at(time)); }
  double left() const noexcept { return area_.x; }
  /// Nothing unless angles are true.
  std::optional<Circle> arc() const {
    return has_true_angles_ ? std::optional(Circle{corner(), arc_px_}) : std::nullopt;
  }
  double right() const noexcept { return area_.right(); }

  /// Direction in the picture, y up, of a direction in the plane, and back.
  Point picture_of(const Point& plane) const { return {plane.x * across_, plane.y * level_px_}; }
  Point plane_of(const Point& picture) const {
    return {picture.x / across_, picture.y / level_px_};
  }
  /// Where a ray with this direction ends. With true angles that is the arc, or the crossing that
  /// it points at.
  Point end_of(const Point& towards) const;
  /// What is between two rays, of which `a` is to the right of `b`.
  std::vector<Point> sector(const Point& a, const Point& b) const;

  /// The mirrors in the order of time. If they cannot all be told apart, only mirrors that are at
  /// least this far apart, on the line or at the area's sides.
  std::vector<Mirror> mirrors(const PairLog& log, double least_apart_px) const;

 private:
  void place_corner(const PairLog& log);
  bool place_with_true_angles(double first, double last);
  std::vector<Mirror> evenly_spaced_mirrors() const;
  Rational time_of(const PairLog& log, const PairCollision& collision) const;
  Mirror mirror_of(const PairLog& log, const Integer& index) const;
  double reach_px(double least_apart_px) const;

  StraightLine line_;
  Rect most_area_;
  Rect area_;
  double margin_px_;
  double most_arc_px_;
  double arc_px_ = 0;
  bool has_true_angles_ = false;
  double level_px_ = 0;  ///< height of the line above the base
  Span span_;
  double corner_x_ = 0;
  double scale_ = 1;  ///< pixels per unit, across
  bool is_exact_ = false;
  double across_ = 1;  ///< pixels across for the line's distance from the corner
};

/// The path is straight; in the end, how many mirrors it has crossed, and why.
/// @param unfolds  whether mirrors appear one by one
PhasedTitle::Sentences unfolded_sentences(const DrawingContext& context, bool unfolds);

/// How many wedge angles fit into half a turn, as half_turn_text(); without digits in other bases.
std::optional<Formula> half_turn_ratio(const DrawingContext& context);

/// The wedge angle, as an expression and a number.
Formula angle_note(const DrawingContext& context);
/// How many of the mirrors are drawn; nothing if all are.
std::optional<Formula> thinning_note(const FormulaSetter& set, const std::vector<Mirror>& mirrors);

}  // namespace piblocks
