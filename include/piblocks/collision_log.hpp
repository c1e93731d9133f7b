// Who meets whom, and when: the events of a run as a random-access sequence.
// In: a BlockSystem. Out: any collision by its index, and the free flight that holds at any
// time. Stored and computed logs look alike.
#pragma once

#include <piblocks/blocks.hpp>
#include <piblocks/exact.hpp>
#include <piblocks/time.hpp>

#include <cstdint>
#include <memory>

namespace piblocks {

enum class CollisionKind {
  wall,   ///< blue meets the wall
  blocks  ///< blue meets red
};

/// A block's centre and velocity at one instant.
struct Motion {
  double position = 0;
  double velocity = 0;
};

/// One collision; velocities are those just after it.
struct Collision {
  Integer index;  ///< from 1
  Time time;
  CollisionKind kind = CollisionKind::blocks;
  Motion blue;
  Motion red;
};

/// Uniform motion between two collisions, known at one instant of it.
struct FreeFlight {
  Integer count;  ///< collisions since time 0; negative before it, where the motion runs back
  Time anchor;    ///< when the blocks are where blue and red say
  Motion blue;
  Motion red;
};

/// A log's collisions are those from time 0 on. Const members are thread-safe.
class CollisionLog {
 public:
  virtual ~CollisionLog() = default;
  /// Number of collisions of the whole run.
  virtual const Integer& size() const = 0;
  /// The collision with 1 <= index <= size().
  /// @throws SimulationError if its time or state is beyond the range of a double.
  virtual Collision at(const Integer& index) const = 0;
  /// The flight that holds at `time`. Flights are half-open, t_i <= time < t_{i+1}: a collision
  /// exactly at `time` has happened.
  /// @throws SimulationError as at().
  virtual FreeFlight flight_at(const Rational& time) const = 0;
};

enum class Engine {
  unfolded,  ///< closed form; any number of collisions at the price of one
  events     ///< the article's event loop in double precision, stored
};

/// Most collisions that Engine::events stores, at 56 bytes each: seven digits of pi.
inline constexpr std::int64_t kMaxStoredCollisions = 5'000'000;

/// @throws SceneError if problems_of(system) is not empty.
/// @throws UsageError if Engine::events would have to store more than kMaxStoredCollisions, or the
///         closed form is asked for a mass ratio beyond 2^2000.
/// @throws SimulationError if a number of an event loop leaves the range of a double.
std::unique_ptr<CollisionLog> make_collision_log(const BlockSystem& system,
                                                 Engine engine = Engine::unfolded);

/// Number of collisions of the whole run, decided beyond doubt at any mass ratio, without a log.
/// @throws SceneError if problems_of(system) is not empty.
Integer count_collisions(const BlockSystem& system);

}  // namespace piblocks
