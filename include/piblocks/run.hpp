// A run: all collisions of blocks and wall, their state at any time, and the exact count.
// In: a BlockSystem. Out: numbers; stored and computed logs look alike.
#pragma once

#include <piblocks/block_system.hpp>
#include <piblocks/exact.hpp>
#include <piblocks/timeline.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace piblocks {

enum class CollisionKind : std::uint8_t {
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
  Integer index;  ///< as CollisionLog counts
  Time time;
  CollisionKind kind = CollisionKind::blocks;
  Motion blue;
  Motion red;
};

/// The blocks at one instant.
struct BlockState {
  Integer count;  ///< index of the last collision until then, as CollisionLog counts
  Motion blue;
  Motion red;
};

/// Consecutive collisions in columns. The numbers of a batch take 24 KiB, which stay in the
/// first-level cache between producer and consumer.
struct CollisionBatch {
  static constexpr std::size_t kCapacity = 512;
  using Column = std::array<double, kCapacity>;

  Integer first;         ///< index of row 0
  std::size_t size = 0;  ///< rows in use
  std::array<CollisionKind, kCapacity> kind;
  Column time_hi;  ///< as Time
  Column time_lo;
  Column blue_position;
  Column blue_velocity;  ///< just after the collision, as in Collision
  Column red_position;
  Column red_velocity;
};

/// Reads a range of a log from its first collision to its last. Must not outlive the log.
class CollisionStream {
 public:
  virtual ~CollisionStream() = default;
  /// Fills `batch` with the next collisions; false, and no rows, if there are no more.
  virtual bool read(CollisionBatch& batch) = 0;
};

/// All collisions of two blocks and a wall. Blocks that touch at time 0 and move apart, or blue
/// that then leaves the wall, have had collision 0 at time 0.
class CollisionLog : public Timeline {
 public:
  const BlockSystem& system() const noexcept { return system_; }
  /// The collision with first_index() <= index <= size().
  /// @throws SimulationError if its time or state is beyond the range of a double.
  virtual Collision collision(const Integer& index) const = 0;
  /// The state at any time, also before the first collision and after the last. A collision exactly
  /// at `time` has happened.
  /// @throws SimulationError as collision().
  virtual BlockState state_at(const Rational& time) const = 0;
  /// Collisions first … last with first_index() <= first, last <= size(); none if last < first.
  /// @throws SimulationError as collision().
  virtual std::unique_ptr<CollisionStream> stream(const Integer& first, const Integer& last) const;

  Integer count_at(const Rational& time) const override { return state_at(time).count; }
  Time collision_time(const Integer& index) const override { return collision(index).time; }
  std::optional<Rational> turn() const override { return turn_of(system_); }

 protected:
  explicit CollisionLog(BlockSystem system) : system_(std::move(system)) {}

 private:
  BlockSystem system_;
};

enum class Engine {
  unfolded,  ///< closed form; any number of collisions at the price of one
  events     ///< the article's event loop in double precision, stored
};

/// Most collisions that Engine::events stores, at 56 bytes each: seven digits of pi.
inline constexpr std::int64_t kMaxStoredCollisions = 5'000'000;

/// @throws SceneError if problems_of(system) is not empty.
/// @throws UsageError if an engine would have to store more than kMaxStoredCollisions, or is not
///         the closed form and collisions are not elastic, or the closed form is asked for a mass
///         ratio beyond 2^2000 of elastic blocks.
/// @throws SimulationError if a number of an event loop leaves the range of a double.
std::unique_ptr<CollisionLog> make_collision_log(const BlockSystem& system,
                                                 Engine engine = Engine::unfolded);

/// Number of collisions of the whole run, decided beyond doubt at any mass ratio, without a log.
/// @throws SceneError if problems_of(system) is not empty.
/// @throws UsageError if they are infinitely many: collapse_of() in restitution.hpp.
Integer count_collisions(const BlockSystem& system);

/// A run whose collisions all happen at once, in the corner of wall and blocks. Their number
/// depends on which is taken to be first, the wall or the blocks.
struct Corner {
  Rational time;        ///< of all collisions
  bool blocks_first;    ///< the convention; the wall where the blocks arrive touching
  Integer count;        ///< collisions by the convention
  Integer other_count;  ///< collisions if the others had met first
};

/// The corner of a system that has collisions, finitely many, and has them all at once.
/// @throws SceneError if problems_of(system) is not empty.
std::optional<Corner> corner_of(const BlockSystem& system);

/// Bounds for the error of the positions of a state, in units of length.
struct PositionBounds {
  double blue = 0;
  double red = 0;
};

/// Of state_at(time); nothing for an engine that steps, whose errors add up.
std::optional<PositionBounds> position_bounds(const CollisionLog& log, const Rational& time);

/// The blocks as seen from the wall, without widths: they touch where y1 = y2. Near the turn
/// of many digits both are far smaller than the rounding error of a position. 0 <= y1 <= y2.
struct Gaps {
  double y1 = 0;  ///< between the wall and blue
  double y2 = 0;  ///< between the wall and red, less blue's width
};

/// Of state_at(time), each with a relative error of at most 16 * 2^-53 unless it is below 1e-290.
/// For an engine that steps they are differences of positions, with the error of these.
/// @throws SimulationError as CollisionLog::state_at().
Gaps gaps_at(const CollisionLog& log, const Rational& time);

/// The gaps at this collision: y1 is exactly 0 at the wall, and equals y2 exactly if the blocks
/// meet. @param index  of the log
/// @throws SimulationError as CollisionLog::collision().
Gaps gaps_at_collision(const CollisionLog& log, const Integer& index);

}  // namespace piblocks
