#include "physics/stored_log.hpp"

#include <algorithm>
#include <limits>

namespace piblocks {
namespace {

bool is_before(const Time& a, const Time& b) {
  return a.hi < b.hi || (a.hi == b.hi && a.lo < b.lo);
}

Time negated(const Time& time) { return {-time.hi, -time.lo}; }

Motion reversed(const Motion& motion) { return {motion.position, -motion.velocity}; }

}  // namespace

StoredLog::StoredLog(const FreeFlight& initial, const std::vector<StoredCollision>& forward,
                     const std::vector<StoredCollision>& backward)
    : initial_(backward.size()), size_(forward.size()) {
  flights_.reserve(backward.size() + 1 + forward.size());
  // Seen forwards, the flight after the reversed run's i-th collision ends there and begins at
  // its next one.
  for (std::size_t i = backward.size(); i-- > 0;) {
    const StoredCollision& end = backward[i];
    const bool is_first = i + 1 == backward.size();
    flights_.push_back({is_first ? Time{} : negated(backward[i + 1].time),
                        is_first ? CollisionKind{} : backward[i + 1].kind, negated(end.time),
                        reversed(end.blue), reversed(end.red)});
  }
  flights_.push_back({backward.empty() ? Time{} : negated(backward.front().time),
                      backward.empty() ? CollisionKind{} : backward.front().kind, initial.anchor,
                      initial.blue, initial.red});
  for (const StoredCollision& collision : forward) {
    flights_.push_back(
        {collision.time, collision.kind, collision.time, collision.blue, collision.red});
  }
  flights_.front().start = {-std::numeric_limits<double>::infinity(), 0};
}

Collision StoredLog::at(const Integer& index) const {
  const Flight& flight = flights_[initial_ + index.get_ui()];
  return {index, flight.start, flight.kind, flight.blue, flight.red};
}

FreeFlight StoredLog::flight_at(const Rational& time) const {
  const auto next = std::upper_bound(
      flights_.begin(), flights_.end(), to_time(time),
      [](const Time& t, const Flight& flight) { return is_before(t, flight.start); });
  const Flight& flight = *std::prev(next);
  const std::ptrdiff_t count = (next - flights_.begin()) - 1 - std::ptrdiff_t(initial_);
  return {Integer(long(count)), flight.anchor, flight.blue, flight.red};
}

}  // namespace piblocks
