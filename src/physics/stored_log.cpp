#include "physics/stored_log.hpp"

#include <piblocks/interpolator.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include "physics/impact_sum.hpp"
#include "physics/indexed_stream.hpp"
#include "physics/listed_exposure.hpp"

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

StoredLog::StoredLog(double mass_ratio, FreeFlight initial, std::vector<StoredCollision> forward,
                     std::vector<StoredCollision> backward)
    : mass_ratio_(mass_ratio),
      initial_(std::move(initial)),
      forward_(std::move(forward)),
      backward_(std::move(backward)),
      size_(forward_.size()) {}

Collision StoredLog::at(const Integer& index) const {
  const StoredCollision& c = forward_[index.get_ui() - 1];
  return {index, c.time, c.kind, c.blue, c.red};
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
    // Seen forwards, what the reversed run does after a collision ends with that collision; one
    // exactly at `time` has happened.
    const StoredCollision& c = backward_[to_come - 1];
    since = negated(c.time);
    flight = {-Integer(to_come), 0, reversed(c.blue), reversed(c.red)};
  }
  flight.age = (t.hi - since.hi) + (t.lo - since.lo);
  return flight;
}

double StoredLog::impulse_of(const StoredCollision& collision) const {
  const double blue = collision.blue.velocity;
  const double red = collision.red.velocity;
  const double speed = std::hypot(std::sqrt(mass_ratio_) * blue, red);
  const double change =
      collision.kind == CollisionKind::wall ? (1 + mass_ratio_) * blue : red - blue;
  return std::fabs(change) / speed;
}

std::optional<Impact> StoredLog::impact(CollisionKind kind, const Integer& first,
                                        const Integer& last) const {
  ImpactSum sum(kind);
  for (long index = first.get_si(); index <= last.get_si(); ++index) {
    const bool is_late = index > 0;
    const StoredCollision& c = is_late ? forward_[static_cast<std::size_t>(index - 1)]
                                       : backward_[static_cast<std::size_t>(-index)];
    if (c.kind != kind) continue;
    sum.add(is_late ? c.time : negated(c.time), impulse_of(c), c.blue.position);
  }
  return sum.result();
}

Integer StoredLog::count_near(const Time& time) const {
  const std::size_t happened = count_until(forward_, time);
  if (happened > 0) return Integer(happened);
  return -Integer(count_before(backward_, negated(time)));
}

std::unique_ptr<Exposure> StoredLog::expose(const Rational& begin, const Rational& end) const {
  const Rational& first = std::min(begin, end);
  const Rational& last = std::max(begin, end);
  const BlockState start = state_at(*this, first);
  PieceList pieces(start.blue.position, start.red.position);
  Time now = to_time(first);
  const Time until = to_time(last);
  const auto go_to = [&](const Time& time, double blue, double red) {
    // The doubles of an event loop can be out of order by their rounding.
    pieces.add(std::max(0.0, (time.hi - now.hi) + (time.lo - now.lo)), blue, red);
    now = time;
  };
  const auto meet = [&](const Time& time, const StoredCollision& c) {
    go_to(time, c.blue.position, c.red.position);
  };
  for (std::size_t i = count_before(backward_, negated(now)),
                   end_of_past = count_until(backward_, negated(until));
       i > end_of_past; --i) {
    meet(negated(backward_[i - 1].time), backward_[i - 1]);
  }
  for (std::size_t i = count_until(forward_, now), end_of_run = count_before(forward_, until);
       i < end_of_run; ++i) {
    meet(forward_[i].time, forward_[i]);
  }
  const BlockState stop = state_at(*this, last);
  go_to(until, stop.blue.position, stop.red.position);
  return std::make_unique<ListedExposure>(pieces.take());
}

}  // namespace piblocks
