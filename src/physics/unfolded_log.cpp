#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <optional>

#include "core/rounded.hpp"
#include "core/two_sum.hpp"
#include "physics/exact_motion.hpp"
#include "physics/exposure.hpp"
#include "physics/impact.hpp"
#include "physics/logs.hpp"
#include "physics/unfolding.hpp"

namespace piblocks {
namespace {

constexpr double kUnitRoundoff = 0x1p-53;

/// Largest |log2(m_red/m_blue)| for which positions can be computed: beyond it the wedge angle
/// leaves the range of a double.
constexpr long kMaxRatioExponent = 2000;

/// Rays to a landmark from the direction half-way between two rays.
DoubleDouble steps_from(const Landmark& landmark, const Integer& from, const Integer& to) {
  const DoubleDouble a = landmark.steps_from(from);
  if (from == to) return a;
  const DoubleDouble b = landmark.steps_from(to);
  const DoubleDouble sum = two_sum(a.hi, b.hi);
  return {sum.hi / 2, (sum.lo + a.lo + b.lo) / 2};
}

ExactMotion checked(const TwoBlocks& system) {
  ExactMotion motion(system);
  if (std::labs(Real(64, motion.ratio).exponent()) > kMaxRatioExponent) {
    throw UsageError(
        fmt::format("masses: the ratio is beyond 1e{0} or 1e-{0}; positions can be computed up to "
                    "it, the count "
                    "alone at any size",
                    kMaxRatioExponent * 30103 / 100000));  // log10(2)
  }
  return motion;
}

/// Doubles are enough for positions at any number of digits (README.md, "Why doubles are enough").
class UnfoldedLog final : public PairLog {
 public:
  explicit UnfoldedLog(const System& system)
      : PairLog(system), exact_(checked(blocks())), form_(blocks(), exact_) {
    set_range(form_.first_index, form_.size);
    const bool touches = exact_.y1 == 0 || exact_.y1 == exact_.y2;
    if (touches && !exact_.through_corner()) contact_ = blocks_at(0).count;
  }

  PairCollision blocks_collision(const Integer& index) const override {
    const Integer ray = ray_of(index);
    const bool odd = is_odd(ray);
    const RayView seen = view_of(ray, ray);
    const int sign = seen.end->sign;
    const Direction step{-sign * form_.step.sine, form_.step.cosine};
    const CollisionNumbers now =
        form_.collision(sign, seen.ray, odd ? seen.ray + step : seen.ray, form_.kind(odd));
    const Time crossed = time(ray, ray, seen);
    // Only rounding can carry a collision past time 0.
    const bool is_wrong = index > 0 ? crossed.hi < 0 : crossed.hi > 0;
    PairCollision collision{index,
                            is_wrong || contact_ == index ? Time{} : crossed,
                            odd ? CollisionKind::blocks : CollisionKind::wall,
                            {now.blue_position, now.blue_velocity},
                            {now.red_position, now.red_velocity}};
    require_finite(collision.time, collision.blue, collision.red, "closed form");
    return collision;
  }

  PairState blocks_at(const Rational& time) const override {
    const LinePoint point = point_at(time);
    return state_of(point, phase_of(point, time), time);
  }

  Rational time_after(const Integer& index) const override {
    if (!exact_.through_corner()) return exact_.time_past(ray_of(index));
    require_last(index, blocks_at(exact_.closest_approach).count);
    return exact_.closest_approach;
  }

  std::unique_ptr<PairStream> stream(const Integer& first, const Integer& last) const override {
    // Times and distances are greatest at the ends of a range. If a double can hold those, it can
    // hold all between.
    if (first <= last) {
      blocks_collision(first);
      blocks_collision(last);
    }
    return make_unfolded_stream(form_, {ray_of(first), ray_of(last), first}, contact_);
  }

  std::optional<PositionBounds> bounds_at(const Rational& time) const override {
    const double distance =
        rounded::hypot(form_.corner_distance, form_.speed * tau_at(time, to_time(time)));
    // An offset is rounded once, and once more in the sum.
    const auto bound = [&](double gap, double offset) {
      return kUnitRoundoff * (8 * gap + 2 * std::fabs(offset) + distance);
    };
    return PositionBounds{bound(distance + form_.ell, form_.blue_offset),
                          bound(distance, form_.red_offset)};
  }

  Gaps gaps_at(const Rational& time) const override {
    const LinePoint point = point_at(time);
    if (exact_.count_from_ray(phase_of(point, time).ray) == 0) {
      return {to_double(exact_.y1 + exact_.u1 * time), to_double(exact_.y2 + exact_.u2 * time)};
    }
    // The phase in doubles would lose what is small beside the angle to its landmark.
    double phase = 0;
    if (!exact_.through_corner()) {
      phase = exact_.phase_from_wall(time);
    } else {
      const auto& [ray, beyond, sign] = *point.end;
      phase = is_odd(ray) ? (1 - beyond.hi) - beyond.lo : beyond.hi;
    }
    const double angle = phase * form_.theta.hi;
    const double distance = y2_bound_at(time);
    // sin(angle)/sigma, which does not lose a small angle among the denormal numbers.
    const auto [sine, cosine] = rounded::sin_cos(angle);
    const double sine_share = angle < 0x1p-30 ? 1 : sine / angle;
    const double y2 = distance * cosine;
    return {std::min(distance * phase * (form_.theta.hi / form_.sigma) * sine_share, y2), y2};
  }

  double y2_bound_at(const Rational& time) const override {
    const Rational free_y1 = exact_.y1 + exact_.u1 * time;
    const Rational free_y2 = exact_.y2 + exact_.u2 * time;
    return rounded::hypot(form_.sigma * to_double(free_y1), to_double(free_y2));
  }

  Gaps gaps_at_collision(const Integer& index) const override {
    const Integer ray = ray_of(index);
    const RayKind kind = form_.kind(is_odd(ray));
    const double distance = form_.ell * (form_.sigma / view_of(ray, ray).ray.sine);
    return {kind.blue_reach * distance, kind.red_reach * distance};
  }

  std::optional<Impact> blocks_impact(CollisionKind kind, const Integer& first,
                                      const Integer& last) const override {
    const bool odd = kind == CollisionKind::blocks;
    Integer from = ray_of(first);
    Integer to = ray_of(last);
    if (is_odd(from) != odd) ++from;
    if (is_odd(to) != odd) --to;
    if (from > to) return std::nullopt;
    const RayView seen = view_of(from, to);
    // The impulse of a collision in the middle, times sin(n theta)/sin theta (README.md, "Many
    // collisions as one").
    const double one = seen.ray.sine / form_.step.sine / (odd ? 1 : form_.step.cosine);
    double number = 1;
    if (from != to) {
      const Integer n = (to - from) / 2 + 1;
      number = form_.direction(to_time(Rational(n)), {}).sine / form_.step.sine;
    }
    const double reach = form_.kind(odd).blue_reach * (form_.sigma / seen.ray.sine);
    return Impact{kind, time(from, to, seen), one * number, form_.blue_offset + reach * form_.ell};
  }

  Integer count_near(const Time& time) const override {
    LinePoint point = point_at(tau_near(time), time);
    point.decided = true;
    const Rational exact = exact_.through_corner() ? to_rational(time) : Rational(0);
    return exact_.count_from_ray(phase_of(point, exact).ray);
  }

  PairExposure expose(const Rational& first, const Rational& last) const override {
    if (exact_.through_corner()) return expose_corner(first, last);
    const LinePoint first_point = point_at(first);
    const LinePoint last_point = point_at(last);
    const Phase first_phase = phase_of(first_point, first);
    const Phase last_phase = phase_of(last_point, last);
    const PairState start = state_of(first_point, first_phase, first);
    const PairState stop = state_of(last_point, last_phase, last);
    const Integer first_ray = ray_of(start.count) + 1;
    const Integer last_ray = ray_of(stop.count);
    if (last_ray - first_ray >= Integer(long(kMaxListedCollisions))) {
      const auto interval_end = [&](const LinePoint& point, const PairState& state,
                                    const Integer& ray) {
        return IntervalEnd{point.tau, state.blue.position - form_.blue_offset,
                           state.red.position - form_.red_offset, ray_phase(ray), is_odd(ray)};
      };
      return expose_bounces(form_, interval_end(first_point, start, first_ray),
                            interval_end(last_point, stop, last_ray));
    }
    // Durations come from triangles with the corner, so that a long turn costs no precision. This
    // is one between a point and a ray, less than one ray apart, with the sine of the ray.
    const auto time_to_ray = [&](const LinePoint& point, double rays, double sine) {
      return rounded::hypot(form_.passage, point.tau) *
             (rounded::sin(rays * form_.theta.hi) / sine);
    };
    PieceList pieces(start.blue.position, start.red.position);
    double before = 0;  // the sine of the ray before
    for (Integer ray = first_ray; ray <= last_ray; ++ray) {
      const double sine = view_of(ray, ray).ray.sine;
      const double distance = form_.ell * (form_.sigma / sine);
      const RayKind kind = form_.kind(is_odd(ray));
      const double duration = ray == first_ray
                                  ? time_to_ray(first_point, 1 - first_phase.fraction, sine)
                                  : form_.passage / before * (form_.step.sine / sine);
      pieces.add(duration, form_.blue_offset + kind.blue_reach * distance,
                 form_.red_offset + kind.red_reach * distance);
      before = sine;
    }
    pieces.add(first_ray <= last_ray ? time_to_ray(last_point, last_phase.fraction, before)
                                     : std::max(0.0, last_point.tau - first_point.tau),
               stop.blue.position, stop.red.position);
    return pieces.exposure();
  }

 private:
  /// A point on the line, seen from the nearer end of time.
  struct LinePoint {
    Time time;       // as a double-double
    double tau = 0;  // scaled, since closest approach
    const Landmark* end = nullptr;
    double distance = 0;  // R
    double sine = 0;      // of the angle from the line of sight to that end
    double cosine = 1;
    const Integer* ray = nullptr;  // next to the nearest landmark: an end, the turn or the start
    double phase = 0;              // minus that ray
    bool decided = false;          // whether the rounding of the phase cannot change its floor
  };

  /// Scaled time since closest approach, as near as double-doubles tell.
  double tau_near(const Time& t) const {
    const Time& turn = form_.closest_approach;
    const Time difference = two_sum(t.hi / form_.time_unit, -turn.hi);
    return difference.hi + (difference.lo + (t.lo / form_.time_unit - turn.lo));
  }
  /// The same, rounded once. `t` is the time as a double-double.
  double tau_at(const Rational& time, const Time& t) const {
    const double tau = tau_near(t);
    // Both times are right to 2^-106 of them. Where the difference is so small that this would
    // matter beside it, it is taken of the exact times.
    const double error =
        0x1p-104 * (std::fabs(t.hi / form_.time_unit) + std::fabs(form_.closest_approach.hi));
    if (error <= 0x1p-56 * std::fabs(tau)) return tau;
    return to_double((time - exact_.closest_approach) / Rational(form_.time_unit));
  }
  LinePoint point_at(double tau, const Time& t) const {
    // Seen from the corner, in units of ell; the line passes it at distance sigma.
    const double ahead = exact_.through_corner() ? kFarAway : form_.distance_at(tau);
    const double range = rounded::hypot(form_.sigma, ahead);

    LinePoint point;
    point.time = t;
    point.tau = tau;
    point.end = tau < 0 ? &form_.past : &form_.future;
    point.distance = rounded::hypot(form_.corner_distance, form_.speed * tau);
    point.sine = form_.sigma / range;
    point.cosine = ahead / range;
    const Landmark* landmark = point.end;
    double angle = rounded::atan2(form_.sigma, ahead);
    const auto nearer = [&](const Landmark& other, double its_angle) {
      if (its_angle >= angle) return;
      landmark = &other;
      angle = its_angle;
    };
    if (!exact_.through_corner()) {
      nearer(form_.turn.seen(tau >= 0), rounded::atan2(std::fabs(tau), form_.passage));
      const double now = t.hi / form_.time_unit;
      if (std::fabs(now) < std::fabs(tau)) {
        nearer(form_.start.seen(now >= 0), std::fabs(form_.angle_since_start(now)));
      }
    }
    const double rays = angle / form_.theta.hi;
    point.ray = &landmark->ray;
    point.phase = landmark->sign * (landmark->beyond.hi - rays);

    // Eleven roundings at most in the number of rays, and three in the difference.
    const double error = 16 * kUnitRoundoff * (rays + 1);
    point.decided = std::floor(point.phase - error) == std::floor(point.phase + error);
    return point;
  }
  LinePoint point_at(const Rational& time) const {
    const Time rounded = to_time(time);
    return point_at(tau_at(time, rounded), rounded);
  }
  /// Computed exactly if the phase of the point is not decided.
  Phase phase_of(const LinePoint& point, const Rational& time) const {
    const Landmark& end = *point.end;
    if (exact_.through_corner()) {
      // All rays are crossed at once: the line keeps the direction of the nearer end.
      const bool on_ray = end.beyond.hi == 0;
      if (time < exact_.closest_approach) {
        return on_ray ? Phase{end.ray, 0} : Phase{end.ray - 1, 1 - end.beyond.hi};
      }
      return on_ray ? Phase{end.ray - 1, 1} : Phase{end.ray, end.beyond.hi};
    }
    if (!point.decided) return exact_.phase_at(time);
    const double whole = std::floor(point.phase);
    return {*point.ray + Integer(whole), point.phase - whole};
  }
  PairState state_of(const LinePoint& point, const Phase& at, const Rational& time) const {
    const auto finite = [&](const PairState& state) {
      require_finite(point.time, state.blue, state.red, "closed form");
      return state;
    };
    const Integer count = exact_.count_from_ray(at.ray);
    // Until the first collision the motion of the system is more exact than any angle.
    if (count == 0) {
      return finite({count, motion_at(blocks().blue, time), motion_at(blocks().red, time)});
    }
    // Folded back by an even number of rays, the point is at this angle to the wall. After an odd
    // ray it is on the other side, and its velocity is reflected once more.
    const bool odd = is_odd(at.ray);
    const double angle = (odd ? 1 - at.fraction : at.fraction) * form_.theta.hi;
    const auto [sine, cosine] = rounded::sin_cos(angle);
    const double y2 = point.distance * cosine;
    const double y1 = std::min(point.distance * (sine / form_.sigma), y2);  // never past contact

    // The line's direction is that of the point, turned by the angle to go.
    const int sign = point.end->sign;
    const double side = odd ? -sign : sign;
    const double ahead_sine = point.sine * cosine + side * (point.cosine * sine);
    const double ahead_cosine = point.cosine * cosine - side * (point.sine * sine);
    return finite({count,
                   {form_.blue_offset + y1, (odd ? -1 : 1) * (form_.blue_speed * ahead_sine)},
                   {form_.red_offset + y2, sign * (form_.red_speed * ahead_cosine)}});
  }
  /// Before all collisions, which happen at once, and after them.
  PairExposure expose_corner(const Rational& begin, const Rational& end) const {
    const PairState start = blocks_at(begin);
    const PairState stop = blocks_at(end);
    PieceList pieces(start.blue.position, start.red.position);
    Rational now = begin;
    if (begin < exact_.closest_approach && exact_.closest_approach < end) {
      now = exact_.closest_approach;
      pieces.add(to_double(now - begin), form_.blue_offset, form_.red_offset);
    }
    pieces.add(to_double(end - now), stop.blue.position, stop.red.position);
    return pieces.exposure();
  }
  /// A ray as seen from the nearer end of time.
  struct RayView {
    const Landmark* end = nullptr;
    Direction ray{};
  };
  /// The ray half-way between two.
  RayView view_of(const Integer& from, const Integer& to) const {
    const bool late = form_.is_late(floor_mean(from, to));
    const Landmark& end = form_.end_near(late);
    const Landmark& turn = form_.turn.seen(late);
    const DoubleDouble to_end = steps_from(end, from, to);
    const DoubleDouble to_turn = steps_from(turn, from, to);
    return {&end, to_turn.hi < to_end.hi ? form_.direction(to_turn, turn.beyond).complement()
                                         : form_.direction(to_end, end.beyond)};
  }
  Time time(const Integer& from, const Integer& to, const RayView& view) const {
    const Integer middle = floor_mean(from, to);
    if (!form_.is_near_start(middle)) return form_.time(view.end->sign, view.ray);
    const Landmark& start = form_.start.seen(middle > form_.start.ahead.ray);
    const Direction from_start = form_.direction(steps_from(start, from, to), start.beyond);
    return {form_.time_from_start(-start.sign, from_start, view.ray), 0};
  }
  RayPhase ray_phase(const Integer& ray) const {
    const auto from = [&](const Landmark& end) {
      const DoubleDouble steps = end.steps_from(ray);
      return steps.hi + (steps.lo + end.beyond.hi);
    };
    const double past = from(form_.past);
    const double future = from(form_.future);
    return future < past ? RayPhase{future, true} : RayPhase{past, false};
  }
  Integer ray_of(const Integer& index) const { return exact_.blocks_first ? index : index - 1; }

  ExactMotion exact_;
  Unfolding form_;
  std::optional<Integer> contact_;  // index of the collision that happens exactly at time 0
};

}  // namespace

std::unique_ptr<PairLog> make_unfolded_log(const System& system) {
  return std::make_unique<UnfoldedLog>(system);
}

}  // namespace piblocks
