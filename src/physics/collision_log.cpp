#include <fmt/format.h>
#include <piblocks/collision_log.hpp>
#include <piblocks/error.hpp>

#include "physics/event_loop.hpp"
#include "physics/exact_events.hpp"
#include "physics/stored_log.hpp"
#include "physics/unfolded_log.hpp"

namespace piblocks {
namespace {

using Simulate = std::vector<StoredCollision>(const BlockSystem&);

BlockSystem reversed(BlockSystem system) {
  system.blue.velocity = -system.blue.velocity;
  system.red.velocity = -system.red.velocity;
  return system;
}

Motion motion_of(const Block& block) {
  return {to_double(block.position), to_double(block.velocity)};
}

std::unique_ptr<CollisionLog> store(const BlockSystem& system, Simulate* simulate) {
  const FreeFlight initial{0, {}, motion_of(system.blue), motion_of(system.red)};
  return std::make_unique<StoredLog>(initial, simulate(system), simulate(reversed(system)));
}

bool is_at_rest(const BlockSystem& system) {
  return system.blue.velocity == 0 && system.red.velocity == 0;
}

void check(const BlockSystem& system) {
  const std::vector<Problem> problems = problems_of(system);
  if (!problems.empty()) throw SceneError(describe(problems));
}

void check_storable(const BlockSystem& system) {
  const Integer count = ExactMotion(system).total();
  if (count <= kMaxStoredCollisions) return;
  throw UsageError(fmt::format(
      "event loop: {} collisions are more than the limit of {}; use the closed form (--engine "
      "unfolded)",
      readable(count), readable(kMaxStoredCollisions)));
}

}  // namespace

std::unique_ptr<CollisionLog> make_collision_log(const BlockSystem& system, Engine engine) {
  check(system);
  if (engine == Engine::events) {
    check_storable(system);
    return store(system, event_loop);
  }
  // At theta >= pi/4 the closed form has nothing to skip, and would lose a very light red block
  // in the rounding of its phase.
  if (system.red.mass <= system.blue.mass || is_at_rest(system)) return store(system, exact_events);
  return std::make_unique<UnfoldedLog>(system);
}

Integer count_collisions(const BlockSystem& system) {
  check(system);
  return ExactMotion(system).total();
}

}  // namespace piblocks
