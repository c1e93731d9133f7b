#include "physics/unfolded_exposure.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "core/rounded.hpp"

namespace piblocks {
namespace {

/// Collisions at each end that are listed among the pieces; even.
constexpr int kOutermost = 128;
/// Bounces that stand for all between.
constexpr int kSlowBounces = 128;

class Bounces {
 public:
  Bounces(const ClosedForm& form, const IntervalEnd& begin, const IntervalEnd& end)
      : form_(form),
        rays_(form),
        duration_(end.tau - begin.tau),
        blue_gap_{0, std::max(begin.blue_gap, end.blue_gap)},
        red_gap_{std::min(begin.red_gap, end.red_gap), std::max(begin.red_gap, end.red_gap)} {
    cut_ends(begin, end);
    const Travel contacts{rays_.contact(odd_.first), rays_.contact(odd_.last)};
    blue_gap_.include(contacts);
    red_gap_.include(contacts);
    // No contact is nearer to the corner than this one, at right angles to the line.
    if (!odd_.first.late && odd_.last.late) {
      const double nearest = form_.ell * form_.step.sine;
      red_gap_.include({nearest, nearest});
    }
  }

  Travel range(BlockName block) const {
    const Travel& gap = block == BlockName::blue ? blue_gap_ : red_gap_;
    return {offset(block) + gap.from, offset(block) + gap.to};
  }

  /// The outermost collisions, which take long, as they are; between them the slow ones.
  std::vector<UniformPiece> pieces(const IntervalEnd& begin, const IntervalEnd& end) const {
    PieceList pieces(form_.blue_offset + begin.blue_gap, form_.red_offset + begin.red_gap);
    double now = begin.tau;
    const auto fly_to = [&](double tau, double blue, double red) {
      pieces.add(std::max(0.0, tau - now), form_.blue_offset + blue, form_.red_offset + red);
      now = tau;
    };
    const auto meet = [&](const RayPhase& ray, bool is_odd) {
      const double contact = rays_.contact(ray);
      fly_to(rays_.tau(ray), is_odd ? contact : 0, is_odd ? contact : contact / form_.step.cosine);
    };
    if (rays_.is_before(odd_.first, even_.first)) meet(odd_.first, true);
    for (int i = 0; i <= kOutermost; ++i) meet(rays_.later(even_.first, i), i % 2 == 1);
    const double slow_begin = now;
    const double step =
        (rays_.tau(rays_.later(even_.last, -kOutermost)) - slow_begin) / (2 * kSlowBounces);
    for (int i = 1; i < 2 * kSlowBounces; ++i) {
      const double tau = slow_begin + step * i;
      const double gap = rounded::hypot(form_.corner_distance, form_.speed * tau);
      fly_to(tau, i % 2 == 1 ? gap : 0, gap);
    }
    for (int i = kOutermost; i >= 0; --i) meet(rays_.later(even_.last, -i), i % 2 == 1);
    if (rays_.is_before(even_.last, odd_.last)) meet(odd_.last, true);
    fly_to(end.tau, end.blue_gap, end.red_gap);
    return pieces.take(duration_);
  }

  double area_below(BlockName block, double position) const {
    // Above the range every moment counts.
    const double top = range(block).to;
    const double gap = std::min(position, top) - offset(block);
    double area = block == BlockName::blue ? blue_below(gap) : red_below(gap);
    for (const EndFlight& end : block == BlockName::blue ? blue_ends_ : red_ends_) {
      area += end.duration * end.gap.area_below(gap);
    }
    return std::max(0.0, position - top) + area / duration_;
  }

 private:
  /// Even motion from an end of the interval to the rays that are summed.
  struct EndFlight {
    double duration = 0;
    Travel gap;
  };

  void cut_ends(const IntervalEnd& begin, const IntervalEnd& end) {
    const RayPhase& first = begin.ray;
    const RayPhase& last = end.ray;
    const double to_first = std::max(0.0, rays_.tau(first) - begin.tau);
    const double from_last = std::max(0.0, end.tau - rays_.tau(last));
    even_ = {first, last};
    odd_ = {first, last};
    if (begin.ray_is_odd) {
      const double contact = rays_.contact(first);
      even_.first = rays_.later(first, 1);
      blue_ends_.push_back({to_first, {begin.blue_gap, contact}});
      blue_ends_.push_back({rays_.duration(first, even_.first), {contact, 0}});
    } else {
      odd_.first = rays_.later(first, 1);
      blue_ends_.push_back({to_first, {begin.blue_gap, 0}});
    }
    if (end.ray_is_odd) {
      const double contact = rays_.contact(last);
      even_.last = rays_.later(last, -1);
      blue_ends_.push_back({rays_.duration(even_.last, last), {0, contact}});
      blue_ends_.push_back({from_last, {contact, end.blue_gap}});
    } else {
      odd_.last = rays_.later(last, -1);
      blue_ends_.push_back({from_last, {0, end.blue_gap}});
    }
    const auto rest = [&](double duration, const RayPhase& a, const RayPhase& b) {
      return duration + (rays_.is_before(a, b) ? rays_.duration(a, b) : 0);
    };
    red_ends_ = {{rest(to_first, first, odd_.first), {begin.red_gap, rays_.contact(odd_.first)}},
                 {rest(from_last, odd_.last, last), {rays_.contact(odd_.last), end.red_gap}}};
  }

  // Integrals over the time of the share below a gap, in units of time by length.
  double blue_below(double gap) const {
    if (gap <= 0) return 0;
    // Flights that end farther away than `gap`, from the wall to the blocks or back.
    double passes = 0;
    const auto pass = [&](const RayPhase& first_even, const RayPhase& last_even) {
      if (!rays_.is_before(first_even, last_even)) return;
      // Blue leaves the wall as fast as it came: each ray is of two flights but the outermost ones.
      passes += 2 * rays_.sum_of_inverse_sines({first_even, last_even}) -
                rays_.inverse_sine(first_even) - rays_.inverse_sine(last_even);
    };
    double area = 0;
    if (const auto near =
            rays_.nearer_than(gap, {rays_.later(even_.first, 1), rays_.later(even_.last, -1)})) {
      const RayPhase from = rays_.later(near->first, -1);
      const RayPhase to = rays_.later(near->last, 1);
      area = gap * rays_.duration(from, to) - rays_.integral_of_blue(*near);
      pass(even_.first, from);
      pass(to, even_.last);
    } else {
      pass(even_.first, even_.last);
    }
    const double time = gap / (form_.speed * form_.step.cosine) * passes;
    return area + time * gap / 2;
  }

  double red_below(double gap) const {
    const auto near = rays_.nearer_than(gap, odd_);
    if (!near) return 0;
    double area = 0;
    if (rays_.is_before(near->first, near->last)) {
      area = gap * rays_.duration(near->first, near->last) -
             rays_.integral_of_red({rays_.later(near->first, 1), rays_.later(near->last, -1)});
    }
    if (rays_.rays_between(odd_.first, near->first) > 1) {
      area += flight_below(near->first, rays_.later(near->first, -2), gap);
    }
    if (rays_.rays_between(near->last, odd_.last) > 1) {
      area += flight_below(near->last, rays_.later(near->last, 2), gap);
    }
    return area;
  }

  /// The flight of red between two contacts.
  double flight_below(const RayPhase& near, const RayPhase& far, double gap) const {
    const Travel travel{rays_.contact(near), rays_.contact(far)};
    return std::fabs(rays_.duration(near, far)) * travel.area_below(gap);
  }

  double offset(BlockName block) const {
    return block == BlockName::blue ? form_.blue_offset : form_.red_offset;
  }

  ClosedForm form_;
  RaySums rays_;
  double duration_;
  Travel blue_gap_;
  Travel red_gap_;
  RayRange even_;  // between them blue flies to red and back
  RayRange odd_;   // between them red flies evenly from each to the next
  std::vector<EndFlight> blue_ends_;
  std::vector<EndFlight> red_ends_;
};

}  // namespace

PairExposure expose_bounces(const ClosedForm& form, const IntervalEnd& begin,
                            const IntervalEnd& end) {
  const auto bounces = std::make_shared<const Bounces>(form, begin, end);
  return {.pieces = bounces->pieces(begin, end),
          .blue_range = bounces->range(BlockName::blue),
          .red_range = bounces->range(BlockName::red),
          .area_below = [bounces](BlockName block, double position) {
            return bounces->area_below(block, position);
          }};
}

}  // namespace piblocks
