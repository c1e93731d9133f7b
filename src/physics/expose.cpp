#include "physics/expose.hpp"

#include <piblocks/run.hpp>

#include <algorithm>

#include "physics/listed_exposure.hpp"
#include "physics/unfolded_log.hpp"

namespace piblocks {
namespace {

/// From collision to collision.
std::unique_ptr<Exposure> listed(const CollisionLog& log, const Rational& begin,
                                 const Rational& end) {
  const BlockState start = state_at(log, begin);
  const BlockState stop = state_at(log, end);
  PieceList pieces(start.blue.position, start.red.position);
  Time now = to_time(begin);
  const auto go_to = [&](const Time& time, const Motion& blue, const Motion& red) {
    // The times of an event loop can be out of order by their rounding.
    pieces.add(std::max(0.0, (time.hi - now.hi) + (time.lo - now.lo)), blue.position, red.position);
    now = time;
  };
  for (Integer index = start.count + 1; index <= stop.count; ++index) {
    const Collision collision = log.at(index);
    go_to(collision.time, collision.blue, collision.red);
  }
  go_to(to_time(end), stop.blue, stop.red);
  return std::make_unique<ListedExposure>(pieces.take());
}

}  // namespace

std::unique_ptr<Exposure> expose(const CollisionLog& log, const Rational& begin,
                                 const Rational& end) {
  const Rational& first = std::min(begin, end);
  const Rational& last = std::max(begin, end);
  if (const auto* const form = dynamic_cast<const UnfoldedLog*>(&log)) {
    return form->expose(first, last);
  }
  return listed(log, first, last);
}

}  // namespace piblocks
