#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/rounded.hpp"
#include "physics/unfolded_exposure.hpp"

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

}  // namespace

RayPhase RaySums::later(RayPhase ray, double rays) const {
  ray.phase += ray.late ? -rays : rays;
  if (ray.phase > form_.total_phase / 2) return {form_.total_phase - ray.phase, !ray.late};
  return ray;
}

double RaySums::rays_between(const RayPhase& a, const RayPhase& b) const {
  if (a.late == b.late) return a.late ? a.phase - b.phase : b.phase - a.phase;
  const double across = form_.total_phase - a.phase - b.phase;
  return b.late ? across : -across;
}

double RaySums::tau(const RayPhase& ray) const {
  const auto [sine, cosine] = rounded::sin_cos(angle(ray));
  const double size = form_.passage * (cosine / sine);
  return ray.late ? size : -size;
}

double RaySums::duration(const RayPhase& a, const RayPhase& b) const {
  if (a.late != b.late) return tau(b) - tau(a);
  // The difference of the cotangents, without cancellation.
  const double turn = rays_between(a, b) * form_.theta.hi;
  return (rounded::sin(turn) / rounded::sin(angle(a))) * (form_.passage / rounded::sin(angle(b)));
}

double RaySums::inverse_sine(const RayPhase& ray) const { return sine_ / rounded::sin(angle(ray)); }

std::optional<RayRange> RaySums::nearer_than(double gap, const RayRange& odd_rays) const {
  const double sine = form_.ell * sine_ / gap;
  if (!(gap > 0) || sine > 1) return std::nullopt;
  const double cosine = std::sqrt((1 - sine) * (1 + sine));
  const double least = rounded::atan2(sine, cosine) / form_.theta.hi;
  const auto inwards = [&](const RayPhase& ray, double direction, bool towards_middle) {
    const double rays = towards_middle ? 2 * std::max(0.0, std::ceil((least - ray.phase) / 2)) : 0;
    return later(ray, direction * rays);
  };
  const RayRange range{inwards(odd_rays.first, 1, !odd_rays.first.late),
                       inwards(odd_rays.last, -1, odd_rays.last.late)};
  const bool is_empty = range.first.phase < least || range.last.phase < least ||
                        is_before(odd_rays.last, range.first) || is_before(range.last, range.first);
  return is_empty ? std::nullopt : std::optional(range);
}

/// The integral over the angle, in units of the distance 2 theta between summands. In
/// v = ln tan(delta/2), u = sin theta cosh(v) and du has lost its pole.
template <typename Summand>
double RaySums::integral(const RayPhase& from, const RayPhase& to) const {
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

/// What the midpoint rule of Euler and Maclaurin adds at one end, its derivatives written as
/// differences of summands around that end.
template <typename Summand>
double RaySums::end_correction(const RayPhase& between) const {
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

template <typename Summand>
double RaySums::sum(const RayRange& range) const {
  const double steps = std::round(rays_between(range.first, range.last) / 2);
  if (steps < 0) return 0;
  const auto terms = [&](const RayPhase& from, double direction, int count) {
    double result = 0;
    for (int i = 0; i < count; ++i) {
      const RayPhase ray = later(from, direction * i);
      result +=
          Summand::at(inverse_sine(ray), inverse_sine(later(ray, -1)), inverse_sine(later(ray, 1)));
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

double RaySums::sum_of_inverse_sines(const RayRange& range) const {
  return sum<InverseSine>(range);
}

double RaySums::integral_of_blue(const RayRange& odd_rays) const {
  return form_.ell * (form_.ell / form_.speed) * sum<BlueMoment>(odd_rays);
}

double RaySums::integral_of_red(const RayRange& even_rays) const {
  return 2 * form_.step.cosine * form_.ell * (form_.ell / form_.speed) * sum<RedMoment>(even_rays);
}

}  // namespace piblocks
