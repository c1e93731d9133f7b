// Only for two blocks beside something immovable: gaps, bounds, the past, the exact count, loss.
// In: a System with two_blocks_of(), or the TwoBlocks. Out: numbers; stored and computed logs look
// alike.
#pragma once

#include <piblocks/exact.hpp>
#include <piblocks/log.hpp>
#include <piblocks/system.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

namespace piblocks {

/// A block that slides without friction along the x axis. Lengths, times and masses are in the
/// scene's own units.
struct Block {
  Rational mass;      ///< > 0
  Rational position;  ///< of the block's centre at time 0
  Rational velocity;  ///< at time 0; positive away from the wall
  Rational width;     ///< > 0
};

/// Two blocks beside something immovable, seen from there: order along the x axis is wall face,
/// blue block, red block. Touching is allowed.
struct TwoBlocks {
  Rational wall_face = 0;  ///< where the wall ends; blue never passes it
  Block blue = {1, 2, 0, 1};
  Block red = {10000, 5, -1, 1};
  /// Coefficients of restitution: what share of the speed at which two bodies approach each other
  /// they have when they part; 0 (they stay together) … 1 (elastic).
  Rational blocks_restitution = 1;
  Rational wall_restitution = 1;  ///< of blue and the wall
  // Which bodies of a System they are, numbered as in Collision.
  std::uint32_t blue_id = 0;
  std::uint32_t red_id = 1;
  std::uint32_t wall_id = 2;  ///< a body or a wall
  int side = 1;               ///< -1: in the system the wall is on the right

  /// The gaps at time 0, between the wall and blue and between blue and red.
  Rational blue_gap() const { return blue.position - blue.width / 2 - wall_face; }
  Rational blocks_gap() const {
    return red.position - red.width / 2 - (blue.position + blue.width / 2);
  }
};

/// The blocks of a system that is nothing but that; nothing for all others, and where contacts are
/// at once.
std::optional<TwoBlocks> two_blocks_of(const System& system);
/// The same as bodies: blue, red, and a wall, with these names.
System system_of(const TwoBlocks& blocks);

/// Whether collisions keep the energy, so that the motion unfolds to a straight line and its past
/// is known.
inline bool is_elastic(const TwoBlocks& system) {
  return system.blocks_restitution == 1 && system.wall_restitution == 1;
}

/// When the blocks are nearest to the corner of wall and blocks, as the plane with axes
/// (sqrt(m) x gap) measures it: the middle of all collisions. It may be before time 0. Nothing if
/// neither block moves. With restitution below 1: when red is nearest to the wall, from time 0 on.
std::optional<Rational> turn_of(const TwoBlocks& system);

/// The article's blocks, with red that many times as heavy as blue.
/// @throws UsageError as mass_ratio_of()
TwoBlocks article_blocks(int digits, int base = kUsualBase);

enum class CollisionKind : std::uint8_t {
  wall,   ///< blue meets the wall
  blocks  ///< blue meets red
};

/// A block's centre and velocity at one instant.
struct BlockMotion {
  double position = 0;
  double velocity = 0;
};

/// One collision; velocities are those just after it.
struct PairCollision {
  Integer index;  ///< as Log counts
  Time time;
  CollisionKind kind = CollisionKind::blocks;
  BlockMotion blue;
  BlockMotion red;
};

/// The blocks at one instant.
struct PairState {
  Integer count;  ///< index of the last collision until then, as Log counts
  BlockMotion blue;
  BlockMotion red;
};

/// Consecutive collisions in columns. The numbers of a batch take 24 KiB, which stay in the
/// first-level cache between producer and consumer.
struct PairBatch {
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
class PairStream {
 public:
  virtual ~PairStream() = default;
  /// Fills `batch` with the next collisions; false, and no rows, if there are no more.
  virtual bool read(PairBatch& batch) = 0;
};

struct PairExposure;  // physics/exposure.hpp

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
class PairLog : public Log {
 public:
  const TwoBlocks& blocks() const noexcept { return blocks_; }

  /// The collision with first_index() <= index <= last().
  /// @throws SimulationError if its time or state is beyond the range of a double.
  virtual PairCollision blocks_collision(const Integer& index) const = 0;
  /// The state at any time, also before the first collision and after the last. A collision exactly
  /// at `time` has happened.
  /// @throws SimulationError as blocks_collision().
  virtual PairState blocks_at(const Rational& time) const = 0;
  /// Collisions first … last with first_index() <= first, last <= last(); none if last < first.
  /// @throws SimulationError as blocks_collision().
  virtual std::unique_ptr<PairStream> stream(const Integer& first, const Integer& last) const;
  /// Of blocks_at(time); nothing for an engine that steps, whose errors add up.
  virtual std::optional<PositionBounds> bounds_at(const Rational& time) const;
  /// Of blocks_at(time), each with a relative error of at most 16 * 2^-53 unless it is below
  /// 1e-290. For an engine that steps they are differences of positions, with the error of these.
  /// @throws SimulationError as blocks_at().
  virtual Gaps gaps_at(const Rational& time) const;
  /// An upper bound of y2 of gaps_at(time) that is quick to compute. For elastic blocks it is the
  /// distance from the corner of the gaps' plane, and at most y2 / cos θ.
  virtual double y2_bound_at(const Rational& time) const { return gaps_at(time).y2; }
  /// The gaps at this collision: y1 is exactly 0 at the wall, and equals y2 exactly if the blocks
  /// meet. @throws SimulationError as blocks_collision().
  virtual Gaps gaps_at_collision(const Integer& index) const;
  /// The interval between two times, from <= to, also before time 0. Valid after the log is gone.
  /// @throws SimulationError as blocks_collision().
  virtual PairExposure expose(const Rational& from, const Rational& to) const;

  /// As impact(), with the position of blue's centre as seen from the wall.
  virtual std::optional<Impact> blocks_impact(CollisionKind kind, const Integer& first,
                                              const Integer& last) const;

  // The same by the numbers of the bodies.
  Integer first_index() const override { return first_index_; }
  Integer last() const override { return last_; }
  bool knows_last() const noexcept override { return true; }
  bool has(const Integer& index) const override { return index >= first_index_ && index <= last_; }
  Collision collision(const Integer& index) const override;
  Time collision_time(const Integer& index) const override { return blocks_collision(index).time; }
  State state_at(const Rational& time) const override;
  std::optional<std::vector<double>> position_bounds(const Rational& time) const override;
  Integer count_at(const Rational& time) const override { return blocks_at(time).count; }
  Integer first_since(const Rational& time) const override;
  std::vector<std::vector<PathPoint>> paths(const Rational& from, const Rational& to,
                                            std::size_t most) const override;
  bool is_exact(const Integer& /*index*/) const override { return false; }
  std::optional<Integer> first_tie(const Integer& last) const override;
  bool is_always_certain() const noexcept override { return true; }
  std::optional<double> certain_until(const std::optional<Rational>& /*time*/) const override {
    return std::nullopt;
  }
  std::optional<Impact> impact(CollisionKind kind, const Integer& first,
                               const Integer& last) const override;
  double impulse_unit() const override { return 1; }
  const PairLog* pair() const noexcept override { return this; }

 protected:
  /// @param system  with two_blocks_of()
  explicit PairLog(const System& system) : Log(system), blocks_(two_blocks_of(system).value()) {}
  void set_range(Integer first_index, Integer last) {
    first_index_ = std::move(first_index);
    last_ = std::move(last);
  }

 private:
  Motion body_motion_of(const BlockMotion& motion) const {
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
/// @throws UsageError if the system is not two blocks beside something immovable; if an engine
///         would store more than kMaxStoredCollisions; if Engine::events gets inelastic blocks;
///         if the closed form gets elastic blocks of a mass ratio beyond 2^2000.
/// @throws SimulationError if a number of an event loop leaves the range of a double.
std::unique_ptr<PairLog> make_pair_log(const System& system, Engine engine = Engine::unfolded);
std::unique_ptr<PairLog> make_pair_log(const TwoBlocks& system, Engine engine = Engine::unfolded);

/// Number of collisions of the whole run. Of two blocks it is decided beyond doubt at any mass
/// ratio, without a log.
/// @param horizon  as make_log()
/// @throws SceneError if problems_of(system) is not empty.
/// @throws UsageError if they are infinitely many: collapse_of(); or as Log::last().
Integer count_collisions(const System& system, const std::optional<Rational>& horizon = {});
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

/// The collapse of a system that has one; nothing if its collisions are finitely many. In the end
/// the blocks have lost all their energy: they rest at the wall and touch each other.
/// @throws SceneError if problems_of(system) is not empty.
std::optional<Collapse> collapse_of(const TwoBlocks& system);

/// How elastic the article's blocks have to be. With less restitution the blocks meet more often,
/// not less: see src/physics/README.md.
struct LeastRestitution {
  Rational below;       ///< too little, of blocks and wall alike
  Rational above;       ///< enough, as every restitution from here to 1
  Integer count_below;  ///< collisions, more than count_above
  Integer count_above;  ///< collisions: those of the elastic run
};

/// Encloses the least restitution with which article_system(digits, base) counts what it counts
/// without loss. 1 - below and 1 - above differ by at most 2^-relative_bits of themselves. If only
/// the elastic run counts right, as with equal masses, above is 1 and below 1 - 2^-relative_bits.
/// @param relative_bits  1 … 4096
/// @throws UsageError as mass_ratio_of(), or if relative_bits is out of range.
LeastRestitution least_restitution(int digits, int base = kUsualBase, int relative_bits = 64);

}  // namespace piblocks
