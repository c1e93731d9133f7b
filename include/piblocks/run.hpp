// Only for two blocks beside something immovable: gaps, bounds, the past, the exact count. In: a
// TwoBlocks. Out: numbers; stored and computed logs look alike.
#pragma once

#include <piblocks/block_system.hpp>
#include <piblocks/exact.hpp>
#include <piblocks/log.hpp>

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
  Integer index;  ///< as Log counts
  Time time;
  CollisionKind kind = CollisionKind::blocks;
  Motion blue;
  Motion red;
};

/// The blocks at one instant.
struct BlockState {
  Integer count;  ///< index of the last collision until then, as Log counts
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

struct Exposure;  // physics/exposure.hpp

/// Bounds for the error of the positions of a state, in units of length.
struct PositionBounds {
  double blue = 0;
  double red = 0;
};

/// The blocks as seen from the wall, without widths: they touch where y1 = y2. Near the turn
/// of many digits both are far smaller than the rounding error of a position. 0 <= y1 <= y2.
struct Gaps {
  double y1 = 0;  ///< between the wall and blue
  double y2 = 0;  ///< between the wall and red, less blue's width
};

/// All collisions of two blocks and a wall. Blocks that touch at time 0 and move apart, or blue
/// that then leaves the wall, have had collision 0 at time 0.
class CollisionLog : public Log {
 public:
  const TwoBlocks& blocks() const noexcept { return blocks_; }

  /// The collision with first_index() <= index <= last().
  /// @throws SimulationError if its time or state is beyond the range of a double.
  virtual Collision blocks_collision(const Integer& index) const = 0;
  /// The state at any time, also before the first collision and after the last. A collision exactly
  /// at `time` has happened.
  /// @throws SimulationError as blocks_collision().
  virtual BlockState blocks_at(const Rational& time) const = 0;
  /// Collisions first … last with first_index() <= first, last <= last(); none if last < first.
  /// @throws SimulationError as blocks_collision().
  virtual std::unique_ptr<CollisionStream> stream(const Integer& first, const Integer& last) const;
  /// Of blocks_at(time); nothing for an engine that steps, whose errors add up.
  virtual std::optional<PositionBounds> bounds_at(const Rational& time) const;
  /// Of blocks_at(time), each with a relative error of at most 16 * 2^-53 unless it is below
  /// 1e-290. For an engine that steps they are differences of positions, with the error of these.
  /// @throws SimulationError as blocks_at().
  virtual Gaps gaps_at(const Rational& time) const;
  /// The gaps at this collision: y1 is exactly 0 at the wall, and equals y2 exactly if the blocks
  /// meet. @throws SimulationError as blocks_collision().
  virtual Gaps gaps_at_collision(const Integer& index) const;
  /// Whether last() stands for infinitely many: see Collapse in restitution.hpp.
  virtual bool is_endless() const { return false; }
  /// The interval between two times, from <= to, also before time 0. Valid after the log is gone.
  /// @throws SimulationError as blocks_collision().
  virtual Exposure expose(const Rational& from, const Rational& to) const;

  /// As impact(), with positions as seen from the wall.
  virtual std::optional<Impact> blocks_impact(CollisionKind kind, const Integer& first,
                                              const Integer& last) const;

  // The same by the numbers of the bodies.
  Integer first_index() const override { return first_index_; }
  Integer last() const override { return last_; }
  bool has(const Integer& index) const override { return index >= first_index_ && index <= last_; }
  BodyCollision collision(const Integer& index) const override;
  Time collision_time(const Integer& index) const override { return blocks_collision(index).time; }
  BodiesState state_at(const Rational& time) const override;
  Integer count_at(const Rational& time) const override { return blocks_at(time).count; }
  Integer first_since(const Rational& time) const override;
  std::vector<std::vector<PathPoint>> paths(const Rational& from, const Rational& to,
                                            std::size_t most) const override;
  bool is_exact(const Integer& /*index*/) const override { return false; }
  std::optional<Integer> first_tie(const Integer& last) const override;
  std::optional<double> certain_until(const std::optional<Rational>& /*time*/) const override {
    return std::nullopt;
  }
  std::optional<Impact> impact(CollisionKind kind, const Integer& first,
                               const Integer& last) const override;
  const CollisionLog* pair() const noexcept override { return this; }

 protected:
  /// @param system  with two_blocks_of()
  explicit CollisionLog(const BodySystem& system)
      : Log(system), blocks_(two_blocks_of(system).value()) {}
  void set_range(Integer first_index, Integer last) {
    first_index_ = std::move(first_index);
    last_ = std::move(last);
  }

 private:
  BodyMotion body_motion_of(const Motion& motion) const {
    return {{blocks_.side * motion.position, 0}, {blocks_.side * motion.velocity, 0}};
  }

  TwoBlocks blocks_;
  Integer first_index_ = 1;
  Integer last_ = 0;
};

/// As turn_of(log.pair()->blocks()); nothing of other bodies.
std::optional<Rational> turn_of(const Log& log);

/// Most collisions of two blocks that Engine::events stores, at 56 bytes each: seven digits of pi.
inline constexpr std::int64_t kMaxStoredCollisions = 5'000'000;

/// @throws SceneError if problems_of(system) is not empty.
/// @throws UsageError unless they are two blocks beside something immovable; if an engine would
/// have to store more than kMaxStoredCollisions, or is not
///         the closed form and collisions are not elastic, or the closed form is asked for a mass
///         ratio beyond 2^2000 of elastic blocks.
/// @throws SimulationError if a number of an event loop leaves the range of a double.
std::unique_ptr<CollisionLog> make_collision_log(const BodySystem& system,
                                                 Engine engine = Engine::unfolded);
std::unique_ptr<CollisionLog> make_collision_log(const TwoBlocks& system,
                                                 Engine engine = Engine::unfolded);

/// Number of collisions of the whole run. Of two blocks it is decided beyond doubt at any mass
/// ratio, without a log.
/// @param horizon  as make_log()
/// @throws SceneError if problems_of(system) is not empty.
/// @throws UsageError if they are infinitely many: collapse_of() in restitution.hpp; or as
///         Log::last().
Integer count_collisions(const BodySystem& system, const std::optional<Rational>& horizon = {});
Integer count_collisions(const TwoBlocks& system);

/// A run whose collisions all happen at once, in the corner of wall and blocks. Their number
/// depends on which is taken to be first, the wall or the blocks.
struct Corner {
  Rational time;        ///< of all collisions
  bool blocks_first;    ///< the convention; the wall where the blocks arrive touching
  Integer count;        ///< collisions by the convention
  Integer other_count;  ///< collisions if the others had met first
};

/// The corner of a system that has collisions, finitely many, and has them all at once.
std::optional<Corner> corner_of(const TwoBlocks& system);

}  // namespace piblocks
