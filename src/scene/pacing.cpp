#include "scene/pacing.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "core/smooth_step.hpp"
#include "physics/exact_motion.hpp"
#include "physics/inelastic_motion.hpp"

namespace piblocks {
namespace {

constexpr const char* kSlowMotionKey = "time.slow-motion";

// Automatic windows are nested around the turn, or, of bodies and where blocks lose energy, around
// the densest collisions. Each is 10 times slower than the one around it, and alone would show 3 s
// of video on either side. Windows are added until at most 10 collisions happen in a second of the
// innermost one.
constexpr int kHalfWindow_s = 3;
constexpr int kStep = 10;
constexpr double kTellApart_hz = 10;

// Collisions of bodies are densest where so many, after another one, take the shortest time.
constexpr int kTogether = 10;

/// Collisions per second of video at the turn, where each takes theta b/|V| (notation:
/// src/physics/README.md). Infinite if all happen at once.
double rate_at_turn(const TwoBlocks& system, const Rational& speed) {
  constexpr mpfr_prec_t kBits = 64;  // squares of velocities can be beyond the range of a double
  const ExactMotion motion(system);
  if (motion.through_corner()) return std::numeric_limits<double>::infinity();
  const Real sigma = motion.sigma(kBits);
  const Real rate(kBits, motion.speed_squared * speed / abs(motion.areal_velocity));
  return (rate / (atan(sigma) * sigma)).to_double();
}

/// The middle of automatic windows, and collisions per second of video there. Nothing if there are
/// no windows.
struct Middle {
  Rational time;
  double rate;
};

std::optional<Middle> middle_of_bodies(const Log& log, const Span& span, const Rational& speed) {
  const Integer first = log.count_at(span.from) + 1;
  const Integer last = log.count_at(span.to);
  if (last <= first) return std::nullopt;
  const Integer steps = std::min(Integer(kTogether), Integer(last - first));
  double shortest = HUGE_VAL;
  Integer begin;
  for (Integer index = first; index <= last - steps; ++index) {
    const Time from = log.collision_time(index);
    const Time to = log.collision_time(index + steps);
    const double length = to.hi - from.hi + (to.lo - from.lo);
    if (length >= shortest) continue;
    shortest = length;
    begin = index;
  }
  const Rational from = to_rational(log.collision_time(begin));
  const Rational to = to_rational(log.collision_time(begin + steps));
  const double rate = steps.get_d() * to_double(speed) / shortest;
  return Middle{(from + to) / 2, shortest > 0 ? rate : HUGE_VAL};
}

std::optional<Middle> middle_of_blocks(const PairLog& log, const Rational& speed) {
  const TwoBlocks& system = log.blocks();
  if (!is_elastic(system)) {
    const auto densest = InelasticMotion(system).densest();
    if (!densest) return std::nullopt;
    const auto& [time, rate] = *densest;
    return Middle{time, rate ? to_double(Rational(*rate * speed)) : HUGE_VAL};
  }
  const std::optional<Rational> turn = turn_of(system);
  if (!turn || !log.has(log.first_index())) return std::nullopt;
  return Middle{*turn, rate_at_turn(system, speed)};
}

std::vector<Move> automatic_windows(const Scene& scene, const Log& log, const Span& span) {
  const Rational speed = nominal_speed(scene);
  const std::optional<Middle> middle =
      log.pair() ? middle_of_blocks(*log.pair(), speed) : middle_of_bodies(log, span, speed);
  if (!middle) return {};
  std::vector<Rational> halves;
  int factor = 1;
  while (factor < kMaxAutomaticFactor && middle->rate > kTellApart_hz * factor) {
    factor *= kStep;
    halves.emplace_back(speed * kHalfWindow_s / factor);
  }
  // From the outermost to the innermost and out again.
  std::vector<Move> windows;
  const std::size_t count = halves.size();
  Rational slowdown = 1;
  for (std::size_t i = 0; i < count; ++i) {
    slowdown *= kStep;
    if (i + 1 == count) {
      windows.push_back({middle->time - halves[i], middle->time + halves[i], slowdown});
      break;
    }
    windows.push_back({middle->time - halves[i], middle->time - halves[i + 1], slowdown});
    windows.push_back({middle->time + halves[i + 1], middle->time + halves[i], slowdown});
  }
  return windows;
}

/// @param item  its text, as of Problem
void check(const Move& window, const Span& span, const std::string& item) {
  const std::string name =
      fmt::format("the window from {} to {}", to_text(window.from), to_text(window.to));
  if (window.from >= window.to)
    throw UsageError(kSlowMotionKey, name + " must end after it begins", item);
  if (window.from < span.to && window.to > span.from) return;
  throw UsageError(kSlowMotionKey,
                   fmt::format("{} is outside of what is shown, {} to {}", name, to_text(span.from),
                               to_text(span.to)),
                   item);
}

/// In order, apart, inside the span. A window is half-open: from <= time < to.
std::vector<Move> slow_windows(const Scene& scene, const Log& log, const Span& span) {
  std::vector<Move> windows;
  if (scene.pacing.automatic_slow_motion) windows = automatic_windows(scene, log, span);
  for (const SlowMotion& slow : scene.pacing.slow_motion) {
    const std::string item = exact_text(slow);
    windows.push_back({time_of(slow.from, kSlowMotionKey, log, item),
                       time_of(slow.to, kSlowMotionKey, log, item), slow.factor});
    check(windows.back(), span, item);
  }
  std::ranges::sort(windows, {}, &Move::from);
  for (std::size_t i = 1; i < windows.size(); ++i) {
    if (windows[i].from >= windows[i - 1].to) continue;
    throw UsageError(kSlowMotionKey,
                     fmt::format("windows overlap at {}; let one begin where the other ends",
                                 to_text(windows[i].from)));
  }
  for (Move& window : windows) {
    window.from = std::max(window.from, span.from);
    window.to = std::min(window.to, span.to);
  }
  std::erase_if(windows, [](const Move& window) { return window.from >= window.to; });
  return windows;
}

/// In order, inside the span.
std::vector<Move> freezes_of(const Scene& scene, const Log& log, const Span& span) {
  std::vector<Move> freezes;
  for (const Freeze& freeze : scene.pacing.freezes) {
    const Rational time = time_of(freeze.at, "time.freeze", log, exact_text(freeze));
    if (time < span.from || time > span.to) {
      throw UsageError("time.freeze",
                       fmt::format("{} is outside of what is shown, {} to {}",
                                   exact_text(freeze.at), to_text(span.from), to_text(span.to)),
                       exact_text(freeze));
    }
    freezes.push_back({time, time, 1, whole_frames(freeze.length_s, scene.view.frame_rate)});
  }
  std::ranges::stable_sort(freezes, {}, &Move::from);
  return freezes;
}

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

/// The same moves, with steps along a smooth curve from one speed to the next. The slower of two
/// moves stays as it is; the steps replace a part of the faster one. If the faster move is too
/// short, its steps are shorter. A freeze begins and ends at once.
/// @param ease_s  how long a change of speed takes, in seconds of video at `speed`; >= 0
/// @param speed   simulation time per second of video where nothing is slower; > 0
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

}  // namespace

Rational time_of(const Instant& instant, const char* key, const Log& log, const std::string& item) {
  try {
    return time_of(instant, log);
  } catch (const UsageError& error) {
    throw UsageError(key, error.what(), item);
  }
}

Rational nominal_speed(const Scene& scene) {
  return scene.pacing.duration_s ? Rational(1) : scene.time.speed;
}

Rational whole_frames(const Rational& length_s, const Rational& frame_rate) {
  return Rational(ceil(length_s * frame_rate)) / frame_rate;
}

std::vector<Move> moves_of(const Scene& scene, const Log& log, const Span& span) {
  const std::vector<Move> windows = slow_windows(scene, log, span);
  const std::vector<Move> freezes = freezes_of(scene, log, span);
  std::vector<Move> moves;
  Rational now = span.from;
  auto freeze = freezes.begin();
  const auto move_to = [&](const Rational& time, const Rational& slowdown) {
    if (time > now) moves.push_back({now, time, slowdown});
    now = std::max(now, time);
  };
  const auto pass_freezes = [&](const Rational& time, const Rational& slowdown) {
    for (; freeze != freezes.end() && freeze->from < time; ++freeze) {
      move_to(freeze->from, slowdown);
      moves.push_back({now, now, slowdown, freeze->frozen_s});
    }
    move_to(time, slowdown);
  };
  for (const Move& window : windows) {
    pass_freezes(window.from, 1);
    pass_freezes(window.to, window.slowdown);
  }
  pass_freezes(span.to, 1);
  for (; freeze != freezes.end(); ++freeze) {
    moves.push_back({now, now, moves.back().slowdown, freeze->frozen_s});
  }
  return eased(moves, scene.pacing.ease_s, nominal_speed(scene));
}

}  // namespace piblocks
