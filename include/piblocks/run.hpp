// A run: the blocks, all their collisions, their state at any time, and the exact count.
// In: a BlockSystem. Out: numbers; stored and computed logs look alike.
#pragma once

#include <piblocks/exact.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace piblocks {

/// A block that slides without friction along the x axis. Lengths, times and masses are in the
/// scene's own units.
struct Block {
  Rational mass;      ///< > 0
  Rational position;  ///< of the block's centre at time 0
  Rational velocity;  ///< at time 0; positive away from the wall
  Rational width;     ///< > 0
};

/// Order along the x axis: wall face, blue block, red block. Touching is allowed.
struct BlockSystem {
  Rational wall_face = 0;  ///< where the wall ends; blue never passes it
  Block blue = {1, 2, 0, 1};
  Block red = {10000, 5, -1, 1};
  /// Coefficients of restitution: what share of the speed at which two bodies approach each other
  /// they have when they part; 0 (they stay together) … 1 (elastic).
  Rational blocks_restitution = 1;
  Rational wall_restitution = 1;  ///< of blue and the wall

  /// The gaps at time 0, between the wall and blue and between blue and red.
  Rational blue_gap() const { return blue.position - blue.width / 2 - wall_face; }
  Rational blocks_gap() const {
    return red.position - red.width / 2 - (blue.position + blue.width / 2);
  }
};

/// Whether collisions keep the energy, so that the motion unfolds to a straight line and its past
/// is known.
inline bool is_elastic(const BlockSystem& system) {
  return system.blocks_restitution == 1 && system.wall_restitution == 1;
}

/// When the blocks are nearest to the corner of wall and blocks, as the plane with axes
/// (sqrt(m) x gap) measures it: the middle of all collisions. It may be before time 0. Nothing if
/// neither block moves. With restitution below 1: when red is nearest to the wall, from time 0 on.
std::optional<Rational> turn_of(const BlockSystem& system);

inline constexpr int kMaxDigits = 100'000;

/// The mass ratio at which the collisions count pi to digits - 1 places after the point:
/// base^(2 (digits - 1)). In base 10 these are its first `digits` digits; in base 2 and 3, where
/// pi's whole part has two digits, there is one more.
/// @throws UsageError unless 1 <= digits <= kMaxDigits and kMinBase <= base <= kMaxBase.
Rational mass_ratio_of(int digits, int base = kUsualBase);

/// The article's system with red that many times as heavy as blue.
/// @throws UsageError as mass_ratio_of()
BlockSystem article_system(int digits, int base = kUsualBase);

/// What is wrong with one value of a scene.
struct Problem {
  std::string key;     ///< as in a scene file: "red.mass"
  std::string reason;  ///< with the value: "= -1: must be greater than 0"
};

/// Everything that is wrong with a system; empty if nothing is.
std::vector<Problem> problems_of(const BlockSystem& system);

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

/// The collisions of a run by index, whatever collides. Those from time 0 on have the indices 1, 2,
/// …, size(), those before time 0 the indices 0, -1, … down to first_index(). Const members are
/// thread-safe.
class Timeline {
 public:
  Timeline() = default;
  virtual ~Timeline() = default;
  Timeline(const Timeline&) = delete;
  Timeline& operator=(const Timeline&) = delete;

  /// Number of collisions from time 0 on, and the index of the last of all time.
  const Integer& size() const noexcept { return size_; }
  /// Index of the first collision of all time; 1 if there are none before time 0.
  const Integer& first_index() const noexcept { return first_index_; }
  /// Index of the last collision until then. A collision exactly at `time` has happened. The logs
  /// of bodies, which begin at time 0, say 0 for earlier times.
  virtual Integer count_at(const Rational& time) const = 0;
  /// When the collision happens, first_index() <= index <= size(), to two doubles.
  /// @throws SimulationError if that is beyond the range of a double.
  virtual Time collision_time(const Integer& index) const = 0;
  /// Whether collisions may go on for ever, size() being those until some time.
  virtual bool may_go_on() const { return false; }
  /// A time at which exactly the collisions up to this one have happened: that of the collision if
  /// its exact value is short, otherwise one so little later that no picture can show the
  /// difference. first_index() <= index <= size().
  /// @throws UsageError if the next collision happens at the same time.
  /// @throws SimulationError if a stepping engine cannot tell the two times apart.
  virtual Rational time_after(const Integer& index) const = 0;
  /// When collisions are densest, if the run has such an instant: as turn_of().
  virtual std::optional<Rational> turn() const = 0;

 protected:
  void set_range(Integer first_index, Integer size) {
    first_index_ = std::move(first_index);
    size_ = std::move(size);
  }

 private:
  Integer first_index_ = 1;
  Integer size_ = 0;
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
  unfolded,   ///< closed form; any number of collisions at the price of one
  events,     ///< the article's event loop in double precision, stored
  velocities  ///< a loop over velocities alone in double precision, stored
};

/// Most collisions that Engine::events and Engine::velocities store, at 56 bytes each: seven digits
/// of pi.
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
