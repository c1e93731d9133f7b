#include "physics/unfolded_exposure.hpp"

#include <algorithm>
#include <cmath>

#include "physics/listed_exposure.hpp"

namespace piblocks {
namespace {

/// Collisions at each end that are listed among the pieces; even.
constexpr int kOutermost = 128;
/// Bounces that stand for all between.
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
  make_pieces(begin, end);
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

/// The outermost collisions, which take long, as they are; between them the slow ones.
void UnfoldedExposure::make_pieces(const Gaps& begin, const Gaps& end) {
  PieceList pieces(form_.blue_offset + begin.blue, form_.red_offset + begin.red);
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
    const double gap = std::hypot(form_.impact, form_.speed * tau);
    fly_to(tau, i % 2 == 1 ? gap : 0, gap);
  }
  for (int i = kOutermost; i >= 0; --i) meet(rays_.later(even_.last, -i), i % 2 == 1);
  if (rays_.is_before(even_.last, odd_.last)) meet(odd_.last, true);
  fly_to(end.tau, end.blue, end.red);
  pieces_ = pieces.take();
  for (UniformPiece& piece : pieces_) piece.share /= duration_;
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
