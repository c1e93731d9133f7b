#include "physics/stored_log.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <utility>

#include "physics/block_motion.hpp"
#include "physics/indexed_stream.hpp"

namespace piblocks {
namespace {

bool is_before(const Time& a, const Time& b) {
  return a.hi < b.hi || (a.hi == b.hi && a.lo < b.lo);
}

Time negated(const Time& time) { return {-time.hi, -time.lo}; }

Motion reversed(const Motion& motion) { return {motion.position, -motion.velocity}; }

/// Number of collisions at or before `time`.
std::size_t count_until(const std::vector<StoredCollision>& collisions, const Time& time) {
  const auto next = std::upper_bound(
      collisions.begin(), collisions.end(), time,
      [](const Time& t, const StoredCollision& c) { return is_before(t, c.time); });
  return static_cast<std::size_t>(next - collisions.begin());
}

/// Number of collisions before `time`.
std::size_t count_before(const std::vector<StoredCollision>& collisions, const Time& time) {
  const auto next = std::lower_bound(
      collisions.begin(), collisions.end(), time,
      [](const StoredCollision& c, const Time& t) { return is_before(c.time, t); });
  return static_cast<std::size_t>(next - collisions.begin());
}

}  // namespace

StoredLog::StoredLog(const BlockSystem& system, std::vector<StoredCollision> forward,
                     std::vector<StoredCollision> backward)
    : CollisionLog(system),
      initial_{0, 0, motion_of(system.blue), motion_of(system.red)},
      forward_(std::move(forward)),
      backward_(std::move(backward)),
      size_(forward_.size()),
      first_index_(1 - Integer(backward_.size())) {}

/// Before time 0 the velocities just after a collision are the opposite of those just before it in
/// the reversed run.
Collision StoredLog::at(const Integer& index) const {
  if (index > 0) {
    const StoredCollision& c = forward_[index.get_ui() - 1];
    return {index, c.time, c.kind, c.blue, c.red};
  }
  const std::size_t place = Integer(-index).get_ui();
  const StoredCollision& c = backward_[place];
  const bool is_first = place == 0;
  const Motion& blue = is_first ? initial_.blue : backward_[place - 1].blue;
  const Motion& red = is_first ? initial_.red : backward_[place - 1].red;
  const double sign = is_first ? 1 : -1;
  return {index,
          negated(c.time),
          c.kind,
          {c.blue.position, sign * blue.velocity},
          {c.red.position, sign * red.velocity}};
}

Rational StoredLog::time_after(const Integer& index) const {
  Rational time = to_rational(at(index).time);
  if (flight_at(time).count == index) return time;
  throw SimulationError(fmt::format(
      "collision #{}: in double precision it cannot be told apart from its neighbours; use the "
      "closed form (--engine unfolded)",
      index.get_str()));
}

std::unique_ptr<CollisionStream> StoredLog::stream(const Integer& first,
                                                   const Integer& last) const {
  return std::make_unique<IndexedStream>(*this, first, last);
}

FreeFlight StoredLog::flight_at(const Rational& time) const {
  const Time t = to_time(time);
  FreeFlight flight = initial_;
  Time since;  // when it was where it says
  if (const std::size_t happened = count_until(forward_, t); happened > 0) {
    const StoredCollision& c = forward_[happened - 1];
    since = c.time;
    flight = {Integer(happened), 0, c.blue, c.red};
  } else if (const std::size_t to_come = count_before(backward_, negated(t)); to_come > 0) {
    // The velocities just before a collision are the opposite of those just after it in the
    // reversed run. A collision exactly at `time` has happened.
    const StoredCollision& c = backward_[to_come - 1];
    since = negated(c.time);
    flight = {-Integer(to_come), 0, reversed(c.blue), reversed(c.red)};
  }
  flight.age = (t.hi - since.hi) + (t.lo - since.lo);
  return flight;
}

}  // namespace piblocks
