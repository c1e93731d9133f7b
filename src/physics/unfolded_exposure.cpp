#include "physics/unfolded_exposure.hpp"

#include <algorithm>
#include <cmath>

#include "physics/listed_exposure.hpp"

namespace piblocks {
namespace {

/// Bounces that stand for the many.
constexpr int kSlowBounces = 128;

}  // namespace

UnfoldedExposure::UnfoldedExposure(const ClosedForm& form, double total_phase, const Gaps& begin,
                                   const Crossing& first, const Crossing& last, const Gaps& end)
    : form_(form),
      rays_(form, total_phase),
      duration_(end.tau - begin.tau),
      blue_gap_{0, std::max(begin.blue, end.blue)},
      red_gap_{std::min(begin.red, end.red), std::max(begin.red, end.red)} {
  cut_ends(begin, first, last, end);
  include(blue_gap_, {rays_.contact(odd_.first), rays_.contact(odd_.last)});
  include(red_gap_, {rays_.contact(odd_.first), rays_.contact(odd_.last)});
  // No contact is nearer to the corner than this one, at right angles to the line.
  if (!odd_.first.late && odd_.last.late) {
    const double nearest = form_.ell * form_.step.sine;
    include(red_gap_, {nearest, nearest});
  }
  make_slow_bounces(begin.tau, end.tau);
}

void UnfoldedExposure::cut_ends(const Gaps& begin, const Crossing& first, const Crossing& last,
                                const Gaps& end) {
  const double to_first = std::max(0.0, rays_.tau(first.ray) - begin.tau);
  const double from_last = std::max(0.0, end.tau - rays_.tau(last.ray));
  even_ = {first.ray, last.ray};
  odd_ = {first.ray, last.ray};
  if (first.is_odd) {
    const double contact = rays_.contact(first.ray);
    even_.first = rays_.later(first.ray, 1);
    blue_ends_.push_back({to_first, {begin.blue, contact}});
    blue_ends_.push_back({rays_.duration(first.ray, even_.first), {contact, 0}});
  } else {
    odd_.first = rays_.later(first.ray, 1);
    blue_ends_.push_back({to_first, {begin.blue, 0}});
  }
  if (last.is_odd) {
    const double contact = rays_.contact(last.ray);
    even_.last = rays_.later(last.ray, -1);
    blue_ends_.push_back({rays_.duration(even_.last, last.ray), {0, contact}});
    blue_ends_.push_back({from_last, {contact, end.blue}});
  } else {
    odd_.last = rays_.later(last.ray, -1);
    blue_ends_.push_back({from_last, {0, end.blue}});
  }
  const auto rest = [&](double duration, const RayPhase& a, const RayPhase& b) {
    return duration + (rays_.is_before(a, b) ? rays_.duration(a, b) : 0);
  };
  red_ends_.push_back(
      {rest(to_first, first.ray, odd_.first), {begin.red, rays_.contact(odd_.first)}});
  red_ends_.push_back({rest(from_last, odd_.last, last.ray), {rays_.contact(odd_.last), end.red}});
}

void UnfoldedExposure::make_slow_bounces(double begin, double end) {
  const auto red_at = [&](double tau) { return std::hypot(form_.impact, form_.speed * tau); };
  const double step = (end - begin) / (2 * kSlowBounces);
  PieceList pieces(form_.blue_offset, form_.red_offset + red_at(begin));
  for (int i = 1; i <= 2 * kSlowBounces; ++i) {
    const double gap = red_at(begin + step * i);
    pieces.add(0.5 / kSlowBounces, form_.blue_offset + (i % 2 == 1 ? gap : 0),
               form_.red_offset + gap);
  }
  slow_bounces_ = pieces.take();
}

Travel UnfoldedExposure::range(BlockName block) const {
  const Travel& gap = block == BlockName::blue ? blue_gap_ : red_gap_;
  return {offset(block) + gap.from, offset(block) + gap.to};
}

double UnfoldedExposure::share_below(BlockName block, double position) const {
  if (position >= range(block).to) return 1;
  const double gap = position - offset(block);
  return std::clamp(sums_below(block, gap).time / duration_, 0.0, 1.0);
}

double UnfoldedExposure::area_below(BlockName block, double position) const {
  // Above the range every moment counts.
  const double top = range(block).to;
  const double gap = std::min(position, top) - offset(block);
  return std::max(0.0, position - top) + sums_below(block, gap).area / duration_;
}

UnfoldedExposure::Sums UnfoldedExposure::sums_below(BlockName block, double gap) const {
  Sums sums = block == BlockName::blue ? blue_below(gap) : red_below(gap);
  for (const Loose& end : block == BlockName::blue ? blue_ends_ : red_ends_) {
    sums.time += end.duration * piblocks::share_below(end.gap, gap);
    sums.area += end.duration * piblocks::area_below(end.gap, gap);
  }
  return sums;
}

UnfoldedExposure::Sums UnfoldedExposure::blue_below(double gap) const {
  if (gap <= 0) return {};
  // Flights that end farther away than `gap`, from the wall to the blocks or back.
  double passes = 0;
  const auto pass = [&](const RayPhase& first_even, const RayPhase& last_even) {
    if (!rays_.is_before(first_even, last_even)) return;
    // Blue leaves the wall as fast as it came: each ray is of two flights but the outermost ones.
    passes += 2 * rays_.sum_of_inverse_sines({first_even, last_even}) -
              rays_.inverse_sine(first_even) - rays_.inverse_sine(last_even);
  };
  Sums sums;
  if (const auto near =
          rays_.nearer_than(gap, {rays_.later(even_.first, 1), rays_.later(even_.last, -1)})) {
    const RayPhase from = rays_.later(near->first, -1);
    const RayPhase to = rays_.later(near->last, 1);
    sums.time = rays_.duration(from, to);
    sums.area = gap * sums.time - rays_.integral_of_blue(*near);
    pass(even_.first, from);
    pass(to, even_.last);
  } else {
    pass(even_.first, even_.last);
  }
  const double time = gap / (form_.speed * form_.step.cosine) * passes;
  return {sums.time + time, sums.area + time * gap / 2};
}

UnfoldedExposure::Sums UnfoldedExposure::red_below(double gap) const {
  const auto near = rays_.nearer_than(gap, odd_);
  if (!near) return {};
  Sums sums;
  if (rays_.is_before(near->first, near->last)) {
    sums.time = rays_.duration(near->first, near->last);
    sums.area = gap * sums.time -
                rays_.integral_of_red({rays_.later(near->first, 1), rays_.later(near->last, -1)});
  }
  if (rays_.rays_between(odd_.first, near->first) > 1) {
    const Sums piece = piece_below(near->first, rays_.later(near->first, -2), gap);
    sums = {sums.time + piece.time, sums.area + piece.area};
  }
  if (rays_.rays_between(near->last, odd_.last) > 1) {
    const Sums piece = piece_below(near->last, rays_.later(near->last, 2), gap);
    sums = {sums.time + piece.time, sums.area + piece.area};
  }
  return sums;
}

/// The flight of red between two contacts.
UnfoldedExposure::Sums UnfoldedExposure::piece_below(const RayPhase& near, const RayPhase& far,
                                                     double gap) const {
  const double duration = std::fabs(rays_.duration(near, far));
  const Travel travel{rays_.contact(near), rays_.contact(far)};
  return {duration * piblocks::share_below(travel, gap),
          duration * piblocks::area_below(travel, gap)};
}

}  // namespace piblocks
