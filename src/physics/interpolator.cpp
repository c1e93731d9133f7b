#include <piblocks/error.hpp>
#include <piblocks/run.hpp>

#include <cmath>
#include <utility>

namespace piblocks {
namespace {

double advanced(const Motion& motion, double duration) {
  return motion.position + motion.velocity * duration;
}

}  // namespace

BlockState state_at(const CollisionLog& log, const Rational& time) {
  FreeFlight flight = log.flight_at(time);
  BlockState state{std::move(flight.count),
                   {advanced(flight.blue, flight.age), flight.blue.velocity},
                   {advanced(flight.red, flight.age), flight.red.velocity}};
  if (!std::isfinite(state.blue.position) || !std::isfinite(state.red.position)) {
    throw SimulationError("state: a position is beyond a double's range");
  }
  return state;
}

}  // namespace piblocks
