#include "scene/easing.hpp"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <utility>

#include "core/smooth_step.hpp"

namespace piblocks {
namespace {

constexpr int kEaseSteps_hz = 60;
// The curve is nowhere steeper than 3/2, so that no step changes the speed by more than an eighth
// of the whole change.
constexpr int kLeastEaseSteps = 12;

/// A change of speed; speeds are simulation time per second of video.
struct Ease {
  Rational first;
  Rational last;
  Rational length_s;  ///< of video

  /// Simulation time that it takes: the curve is symmetric, so the mean speed is that of both ends.
  Rational span() const { return length_s * (first + last) / 2; }
};

/// Adds the steps, each with the speed of its middle. @return the time at their end.
Rational add_steps(const Ease& ease, const Rational& from, const Rational& speed,
                   std::vector<Move>& moves) {
  const long count = std::max<long>(kLeastEaseSteps, ceil(ease.length_s * kEaseSteps_hz).get_si());
  const Rational step_s = ease.length_s / count;
  Rational now = from;
  for (long i = 0; i < count; ++i) {
    const Rational middle = Rational(2 * i + 1) / (2 * count);
    const Rational in_step = ease.first + (ease.last - ease.first) * smooth_step(middle);
    Rational end = now + in_step * step_s;
    moves.push_back({std::move(now), end, speed / in_step});
    now = std::move(end);
  }
  assert(now == from + ease.span());
  return now;
}

}  // namespace

std::vector<Move> eased(const std::vector<Move>& moves, const Rational& ease_s,
                        const Rational& speed) {
  if (ease_s == 0) return moves;
  std::vector<Move> smooth;
  for (std::size_t i = 0; i < moves.size(); ++i) {
    const Move& move = moves[i];
    const Rational own = speed / move.slowdown;
    // The speed at a border: the neighbour's if that is slower, so that the change happens here.
    const auto speed_beside = [&](const Move& neighbour) -> Rational {
      const bool is_moving = move.frozen_s == 0 && neighbour.frozen_s == 0;
      return is_moving ? std::min<Rational>(own, speed / neighbour.slowdown) : own;
    };
    Ease in{i > 0 ? speed_beside(moves[i - 1]) : own, own, ease_s};
    Ease out{own, i + 1 < moves.size() ? speed_beside(moves[i + 1]) : own, ease_s};
    if (in.first == own) in.length_s = 0;
    if (out.last == own) out.length_s = 0;
    const Rational needed = in.span() + out.span();
    const Rational room = move.to - move.from;
    if (needed > room) {
      in.length_s *= room / needed;
      out.length_s *= room / needed;
    }
    Move middle = move;
    middle.to -= out.span();
    if (in.length_s > 0) middle.from = add_steps(in, move.from, speed, smooth);
    const Rational end = middle.to;
    if (end > middle.from || move.frozen_s > 0) smooth.push_back(std::move(middle));
    if (out.length_s > 0) add_steps(out, end, speed, smooth);
  }
  return smooth;
}

}  // namespace piblocks
