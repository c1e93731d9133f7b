#include "physics/stored_log.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <utility>

#include "physics/blocks.hpp"

namespace piblocks {
namespace {

bool is_before(const Time& a, const Time& b) {
  return a.hi < b.hi || (a.hi == b.hi && a.lo < b.lo);
}

Time negated(const Time& time) { return {-time.hi, -time.lo}; }

/// Collisions before `time`, by binary search; with `or_at` also those at it.
std::size_t count(const std::vector<StoredCollision>& collisions, const Time& time, bool or_at) {
  const auto next = std::ranges::partition_point(
      collisions, [&](const Time& t) { return is_before(t, time) || (or_at && t == time); },
      &StoredCollision::time);
  return static_cast<std::size_t>(next - collisions.begin());
}

Motion advanced(const Motion& motion, double duration) {
  return {motion.position + motion.velocity * duration, motion.velocity};
}

}  // namespace

StoredLog::StoredLog(const BlockSystem& system, std::vector<StoredCollision> forward,
                     std::vector<StoredCollision> backward)
    : CollisionLog(system), forward_(std::move(forward)), backward_(std::move(backward)) {
  set_range(1 - Integer(backward_.size()), forward_.size());
}

/// Before time 0 the velocities just after a collision are the opposite of those just before it in
/// the reversed run.
Collision StoredLog::collision(const Integer& index) const {
  if (index > 0) {
    const StoredCollision& c = forward_[index.get_ui() - 1];
    return {index, c.time, c.kind, c.blue, c.red};
  }
  const std::size_t place = Integer(-index).get_ui();
  const StoredCollision& c = backward_[place];
  const Motion blue = place == 0 ? motion_of(system().blue) : reversed(backward_[place - 1].blue);
  const Motion red = place == 0 ? motion_of(system().red) : reversed(backward_[place - 1].red);
  return {index,
          negated(c.time),
          c.kind,
          {c.blue.position, blue.velocity},
          {c.red.position, red.velocity}};
}

Rational StoredLog::time_after(const Integer& index) const {
  Rational time = to_rational(collision(index).time);
  if (state_at(time).count == index) return time;
  throw SimulationError(fmt::format(
      "collision #{}: in double precision it cannot be told apart from its neighbours; use the "
      "closed form (--engine unfolded)",
      index.get_str()));
}

BlockState StoredLog::state_at(const Rational& time) const {
  const Time now = to_time(time);
  BlockState state{0, motion_of(system().blue), motion_of(system().red)};
  Time since;
  if (const std::size_t happened = count(forward_, now, true); happened > 0) {
    const StoredCollision& c = forward_[happened - 1];
    since = c.time;
    state = {Integer(happened), c.blue, c.red};
  } else if (const std::size_t to_come = count(backward_, negated(now), false); to_come > 0) {
    // The velocities just before a collision are the opposite of those just after it in the
    // reversed run.
    const StoredCollision& c = backward_[to_come - 1];
    since = negated(c.time);
    state = {-Integer(to_come), reversed(c.blue), reversed(c.red)};
  }
  const double age = (now.hi - since.hi) + (now.lo - since.lo);
  state.blue = advanced(state.blue, age);
  state.red = advanced(state.red, age);
  require_finite(now, state.blue, state.red, "state");
  return state;
}

}  // namespace piblocks
