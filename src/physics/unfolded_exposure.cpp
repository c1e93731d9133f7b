#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/rounded.hpp"
#include "physics/exposure.hpp"
#include "physics/unfolding.hpp"

namespace piblocks {
namespace {

/// Summands taken one by one at each end. The error of the rest falls with the eighth power of
/// this.
constexpr int kEndTerms = 32;

/// Each struct is a summand. at() takes u = sin theta/sin(delta) of a ray and of the rays before
/// and after it. over_u() is the summand over u; it needs u alone: before * after = u^2/(1 - u^2).
struct InverseSine {
  static double at(double u, double /*before*/, double /*after*/) { return u; }
  static double over_u(double /*u*/) { return 1; }
};
struct BlueMoment {
  static double at(double u, double before, double after) { return u * before * after; }
  static double over_u(double u) { return u * u / (1 - u * u); }
};
struct RedMoment {
  static double at(double u, double before, double after) {
    return before * after * (before * after / u);
  }
  static double over_u(double u) { return u * u / ((1 - u * u) * (1 - u * u)); }
};

/// Gauss-Legendre, eight nodes: positive ones on [-1, 1] and their weights.
constexpr std::array<std::pair<double, double>, 4> kNodes{
    {{0.1834346424956498, 0.3626837833783620},
     {0.5255324099163290, 0.3137066458778873},
     {0.7966664774136267, 0.2223810344533745},
     {0.9602898564975363, 0.1012285362903763}}};

double log_tan_half(double angle) {
  const auto [sine, cosine] = rounded::sin_cos(angle / 2);
  return rounded::log(sine / cosine);
}

/// Rays first, first + 2, …, last.
struct RayRange {
  RayPhase first;
  RayPhase last;
};

/// Times between rays, and sums over every other ray between two, at the cost of few.
class RaySums {
 public:
  explicit RaySums(const ClosedForm& form) : form_(form), sine_(form.step.sine) {}

  /// So many rays later; earlier if negative.
  RayPhase later(RayPhase ray, double rays) const {
    ray.phase += ray.late ? -rays : rays;
    if (ray.phase > form_.total_phase / 2) return {form_.total_phase - ray.phase, !ray.late};
    return ray;
  }
  bool is_before(const RayPhase& a, const RayPhase& b) const { return rays_between(a, b) > 0; }
  double rays_between(const RayPhase& a, const RayPhase& b) const {
    if (a.late == b.late) return a.late ? a.phase - b.phase : b.phase - a.phase;
    const double across = form_.total_phase - a.phase - b.phase;
    return b.late ? across : -across;
  }
  /// Scaled time since closest approach.
  double tau(const RayPhase& ray) const {
    const auto [sine, cosine] = rounded::sin_cos(angle(ray));
    const double size = form_.passage * (cosine / sine);
    return ray.late ? size : -size;
  }
  /// Scaled time from a to b.
  double duration(const RayPhase& a, const RayPhase& b) const {
    if (a.late != b.late) return tau(b) - tau(a);
    // The difference of the cotangents, without cancellation.
    const double turn = rays_between(a, b) * form_.theta.hi;
    return (rounded::sin(turn) / rounded::sin(angle(a))) * (form_.passage / rounded::sin(angle(b)));
  }
  /// y1 = y2 where the line crosses an odd ray.
  double contact(const RayPhase& odd_ray) const { return form_.ell * inverse_sine(odd_ray); }
  /// The odd rays of a range whose contact() is at most `gap`, up to a rounding.
  std::optional<RayRange> nearer_than(double gap, const RayRange& odd_rays) const {
    const double sine = form_.ell * sine_ / gap;
    if (!(gap > 0) || sine > 1) return std::nullopt;
    const double cosine = std::sqrt((1 - sine) * (1 + sine));
    const double least = rounded::atan2(sine, cosine) / form_.theta.hi;
    const auto inwards = [&](const RayPhase& ray, double direction, bool towards_middle) {
      const double rays =
          towards_middle ? 2 * std::max(0.0, std::ceil((least - ray.phase) / 2)) : 0;
      return later(ray, direction * rays);
    };
    const RayRange range{inwards(odd_rays.first, 1, !odd_rays.first.late),
                         inwards(odd_rays.last, -1, odd_rays.last.late)};
    const bool is_empty = range.first.phase < least || range.last.phase < least ||
                          is_before(odd_rays.last, range.first) ||
                          is_before(range.last, range.first);
    return is_empty ? std::nullopt : std::optional(range);
  }

  /// The sum of sin theta/sin(delta), delta being the angle of a ray.
  double sum_of_inverse_sines(const RayRange& range) const { return sum<InverseSine>(range); }
  /// The sum over odd rays of the time integral of y1 from the ray before to the ray after.
  double integral_of_blue(const RayRange& odd_rays) const {
    return form_.ell * (form_.ell / form_.speed) * sum<BlueMoment>(odd_rays);
  }
  /// The sum over even rays of the time integral of y2 from the ray before to the ray after.
  double integral_of_red(const RayRange& even_rays) const {
    return 2 * form_.step.cosine * form_.ell * (form_.ell / form_.speed) *
           sum<RedMoment>(even_rays);
  }

  /// sin theta/sin(delta)
  double inverse_sine(const RayPhase& ray) const { return sine_ / rounded::sin(angle(ray)); }

 private:
  template <typename Summand>
  double sum(const RayRange& range) const {
    const double steps = std::round(rays_between(range.first, range.last) / 2);
    if (steps < 0) return 0;
    const auto terms = [&](const RayPhase& from, double direction, int count) {
      double result = 0;
      for (int i = 0; i < count; ++i) {
        const RayPhase ray = later(from, direction * i);
        result += Summand::at(inverse_sine(ray), inverse_sine(later(ray, -1)),
                              inverse_sine(later(ray, 1)));
      }
      return result;
    };
    if (steps < 3 * kEndTerms) return terms(range.first, 2, static_cast<int>(steps) + 1);
    const RayPhase begin = later(range.first, 2 * kEndTerms - 1);
    const RayPhase end = later(range.last, -(2 * kEndTerms - 1));
    return terms(range.first, 2, kEndTerms) + terms(range.last, -2, kEndTerms) +
           integral<Summand>(begin, end) + end_correction<Summand>(end) -
           end_correction<Summand>(begin);
  }
  /// What the midpoint rule of Euler and Maclaurin adds at one end, its derivatives written as
  /// differences of summands around that end.
  template <typename Summand>
  double end_correction(const RayPhase& between) const {
    const auto term = [&](double rays) {
      const auto u = [&](double at) { return inverse_sine(later(between, at)); };
      return Summand::at(u(rays), u(rays - 1), u(rays + 1));
    };
    const double inner = term(1) - term(-1);
    const double middle = term(3) - term(-3);
    const double outer = term(5) - term(-5);
    const double third = middle - 3 * inner;
    const double fifth = outer - 5 * middle + 10 * inner;
    return -inner / 24 + third * 17 / 5760 - fifth * 367 / 967680;
  }
  /// The integral over the angle, in units of the distance 2 theta between summands. In
  /// v = ln tan(delta/2), u = sin theta cosh(v) and du has lost its pole.
  template <typename Summand>
  double integral(const RayPhase& from, const RayPhase& to) const {
    const double a = angle(from);
    const double b = angle(to);
    const double low = log_tan_half(a) * (from.late ? -1 : 1);
    double length = 0;
    if (from.late == to.late) {
      const double turn = rays_between(from, to) * form_.theta.hi;
      const double near = std::min(a, b);
      const double far = std::max(a, b);
      length =
          rounded::log1p((rounded::sin(turn / 2) / rounded::sin(near / 2)) / rounded::cos(far / 2));
    } else {
      length = -log_tan_half(a) - log_tan_half(b);
    }
    const double panels = std::ceil(length);
    const double half = length / panels / 2;
    double sum = 0;
    for (double panel = 0; panel < panels; ++panel) {
      const double middle = low + (2 * panel + 1) * half;
      for (const auto& [x, weight] : kNodes) {
        for (const double v : {middle - half * x, middle + half * x}) {
          const double power = rounded::exp(v);
          sum += weight * Summand::over_u(sine_ * ((power + 1 / power) / 2));  // cosh v
        }
      }
    }
    return sine_ / (2 * form_.theta.hi) * half * sum;
  }
  double angle(const RayPhase& ray) const { return ray.phase * form_.theta.hi; }

  ClosedForm form_;
  double sine_;
};

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
