// Any number of bodies: blocks on a line or discs in a plane, between walls, and all their
// collisions.
// In: a BodySystem. Out: collisions and states by index and by time; up to when they are certain.
#pragma once

#include <piblocks/exact.hpp>
#include <piblocks/run.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace piblocks {

/// x and y. On a line y is 0.
using ExactVector = std::array<Rational, 2>;

/// A block on a line or a disc in a plane. It does not rotate; collisions are elastic and without
/// friction.
struct Body {
  std::optional<Rational> mass = 1;  ///< > 0; nothing for a body that no collision moves
  ExactVector position = {};         ///< of the centre, at time 0
  ExactVector velocity = {};         ///< at time 0; 0 for a body without mass
  Rational size = 1;                 ///< > 0; the width of a block, the radius of a disc
};

/// A straight wall that no collision moves. Bodies are on the side to which the normal points.
struct Wall {
  std::string name;    ///< in logs and messages, as "left"
  ExactVector point;   ///< on the wall
  ExactVector normal;  ///< not 0, of any length
};

/// Bodies do not overlap each other nor the walls. Touching is allowed.
struct BodySystem {
  int dimensions = 1;  ///< 1: blocks on the x axis; 2: discs
  std::vector<Body> bodies = {};
  std::vector<Wall> walls = {};
};

/// Most bodies of a system. A scene file has room for fewer: kMaxSceneFile_bytes in script.hpp.
inline constexpr std::size_t kMaxBodies = 100'000;
inline constexpr std::size_t kMaxWalls = 16;

/// Everything that is wrong with a system; empty if nothing is. Keys are "body 3.mass", counted
/// from 1, "wall 1.normal", "body" and "wall".
std::vector<Problem> problems_of(const BodySystem& system);

/// The centre and the velocity of a body at one instant.
struct BodyMotion {
  std::array<double, 2> position = {};
  std::array<double, 2> velocity = {};
  bool operator==(const BodyMotion&) const = default;
};

/// Two bodies, or a body and a wall, just after they have met.
struct BodyCollision {
  Integer index;  ///< as Timeline counts
  Time time = {};
  std::uint32_t first = 0;   ///< place of a body in BodySystem::bodies
  std::uint32_t second = 0;  ///< of another, > first; or bodies.size() and the place of a wall
  BodyMotion first_after = {};
  BodyMotion second_after = {};  ///< of a wall: where it is, and no velocity
};

/// A place on a body's way.
struct PathPoint {
  double after = 0;  ///< simulation time since the way began
  std::array<double, 2> position = {};
};

/// All bodies at one instant.
struct BodiesState {
  Integer count;  ///< index of the last collision until then
  std::vector<BodyMotion> bodies;
};

/// On a line, collisions are computed in rational numbers while none of these has more bits, and
/// there are no more collisions; from then on in double precision.
inline constexpr std::size_t kMaxExactBits = 4096;
inline constexpr std::int64_t kMaxExactCollisions = 100'000;

/// Most collisions that are stored, at 160 bytes each.
inline constexpr std::int64_t kMaxBodyCollisions = 2'000'000;

/// All collisions of bodies from time 0 on, by index. Several collisions at one instant happen in
/// the order of TieRank (contact.hpp). Const members are thread-safe.
class BodyLog : public Timeline {
 public:
  const BodySystem& system() const noexcept { return system_; }
  /// The collision with 1 <= index <= size().
  virtual BodyCollision collision(const Integer& index) const = 0;
  Time collision_time(const Integer& index) const override { return collision(index).time; }
  /// The bodies at a time >= 0. A collision exactly at `time` has happened.
  /// @throws UsageError if the time is negative; SimulationError if there are more than
  ///         kMaxBodyCollisions until then.
  virtual BodiesState state_at(const Rational& time) const = 0;
  /// The way of each body between two times, 0 <= from <= to: its centre at both, and at each of
  /// its collisions between. Of a body with more than `most` collisions there are `most` >= 2
  /// points: both ends, and one at an irregular time in each of equal parts of the time between.
  /// @throws as state_at().
  virtual std::vector<std::vector<PathPoint>> paths(const Rational& from, const Rational& to,
                                                    std::size_t most) const = 0;
  /// How many collisions from the first on are computed in rational numbers, so that each number is
  /// the nearest double to the true one; size() if all are. Those of the closed form are if the
  /// outer block is not the heavier one; else none is, and numbers are some units in the last place
  /// off.
  virtual Integer exact_size() const = 0;
  /// The first collision of a body that is about to meet another one at the same time, so that the
  /// order of pairs decides what comes next. Nothing if there is none, as far as the log has been
  /// computed, and computed in rational numbers.
  virtual std::optional<Integer> first_tie() const = 0;
  /// Until when rounding cannot have changed which bodies collide, nor in which order each of them
  /// meets the others. Nothing if it cannot at all, as far as the log has been computed.
  virtual std::optional<double> certain_until() const = 0;

 protected:
  explicit BodyLog(BodySystem system) : system_(std::move(system)) {}

 private:
  BodySystem system_;
};

/// Two blocks and one wall or immovable block beside them are in closed form. All others are
/// stepped and stored.
/// @param until  up to which time collisions count; nothing for all. States can be asked for later
///               times, too.
/// @throws SceneError if problems_of(system) is not empty; UsageError if collisions never end and
///         there is no `until`; SimulationError if there are more than kMaxBodyCollisions.
std::unique_ptr<BodyLog> make_body_log(const BodySystem& system,
                                       const std::optional<Rational>& until);

/// Whether collisions may never end: bodies that move between two walls, or in a closed box.
bool may_never_end(const BodySystem& system);

}  // namespace piblocks
