#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/run.hpp>

#include <algorithm>

#include "physics/block_motion.hpp"
#include "physics/event_loop.hpp"
#include "physics/exact_log.hpp"
#include "physics/stored_log.hpp"
#include "physics/unfolded_log.hpp"

namespace piblocks {
namespace {

using Simulate = std::vector<StoredCollision>(const BlockSystem&);

std::unique_ptr<CollisionLog> store(const BlockSystem& system, Simulate* simulate) {
  return std::make_unique<StoredLog>(system, simulate(system), simulate(reversed(system)));
}

bool is_at_rest(const BlockSystem& system) {
  return system.blue.velocity == 0 && system.red.velocity == 0;
}

void check(const BlockSystem& system) {
  const std::vector<Problem> problems = problems_of(system);
  if (!problems.empty()) throw SceneError(describe(problems));
}

void check_storable(const BlockSystem& system, Engine engine) {
  const Integer count =
      std::max(ExactMotion(system).total(), ExactMotion(reversed(system)).total());
  if (count <= kMaxStoredCollisions) return;
  throw UsageError(fmt::format(
      "{} loop: {} collisions are more than the limit of {}; use the closed form (--engine "
      "unfolded)",
      engine == Engine::events ? "event" : "velocity", readable(count),
      readable(kMaxStoredCollisions)));
}

}  // namespace

std::unique_ptr<CollisionLog> make_collision_log(const BlockSystem& system, Engine engine) {
  check(system);
  if (engine != Engine::unfolded) {
    check_storable(system, engine);
    return store(system, engine == Engine::events ? event_loop : velocity_loop);
  }
  // At theta >= pi/4 the closed form has nothing to skip, and would lose a very light red block
  // in the rounding of its phase.
  if (system.red.mass <= system.blue.mass || is_at_rest(system))
    return std::make_unique<ExactLog>(system);
  return std::make_unique<UnfoldedLog>(system);
}

Integer count_collisions(const BlockSystem& system) {
  check(system);
  return ExactMotion(system).total();
}

std::optional<Corner> corner_of(const BlockSystem& system) {
  check(system);
  ExactMotion motion(system);
  // The line comes into the corner between the rays of wall and blocks; otherwise, starting in it,
  // only one of the two can be first.
  const bool comes_in = motion.u2 < 0 && motion.u1 <= 0 && motion.u2 <= motion.u1;
  if (motion.at_rest() || !motion.through_corner() || !comes_in || motion.closest_approach < 0) {
    return std::nullopt;
  }
  Corner corner{motion.closest_approach, motion.blocks_first, motion.total(), 0};
  motion.blocks_first = !motion.blocks_first;
  corner.other_count = motion.total();
  return corner;
}

}  // namespace piblocks
