// The log: all collisions of bodies, by index and by time.
// In: a system. Out: collisions, states and ways; up to when they are certain. A question computes
// as far as it asks and no further.
#pragma once

#include <piblocks/exact.hpp>
#include <piblocks/system.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <stop_token>
#include <utility>
#include <vector>

namespace piblocks {

/// The centre and the velocity of a body at one instant.
struct Motion {
  std::array<double, 2> position = {};
  std::array<double, 2> velocity = {};
  bool operator==(const Motion&) const = default;
};

/// Two bodies, or a body and a wall, just after they have met.
struct Collision {
  Integer index;  ///< as Log counts
  Time time = {};
  std::uint32_t first = 0;   ///< place of a body in System::bodies
  std::uint32_t second = 0;  ///< of another, > first; or bodies.size() and the place of a wall
  Motion first_after = {};
  Motion second_after = {};  ///< of a wall: where its point is, and its velocity
  // Velocities just before; 0 for two blocks beside something immovable.
  std::array<double, 2> first_before = {};
  std::array<double, 2> second_before = {};
};

/// A place on a body's way.
struct PathPoint {
  double after = 0;  ///< simulation time since the way began
  std::array<double, 2> position = {};
};

/// All bodies at one instant.
struct State {
  Integer count;  ///< index of the last collision until then
  std::vector<Motion> bodies;
  bool is_infinite = false;  ///< there were infinitely many; the count is of those in the log
};

/// Infinitely many collisions, in which some bodies lose all speed relative to each other.
struct Collapse {
  /// When that is, as the nearest two doubles; nothing if the collisions, each later than the one
  /// before by more, never end.
  std::optional<Time> time;
  /// Collisions in the log, Log::last(). Two blocks beside something immovable rest from the last
  /// of them on; each collision that is not in it begins with less than 2^-200 of the energy, or
  /// less than 2^-100 of the time between the first collision and `time` remains.
  Integer listed;
  /// That collapse, in the order of their numbers. Walls come after bodies, as in Collision.
  std::vector<std::uint32_t> bodies = {};
};

/// On a line, collisions are computed in rational numbers while none of these has more bits, and
/// there are no more collisions; from then on in double precision.
inline constexpr std::size_t kMaxExactBits = 4096;
inline constexpr std::int64_t kMaxExactCollisions = 100'000;

/// Most collisions that are stored, at 160 bytes each.
inline constexpr std::int64_t kMaxSteppedCollisions = 2'000'000;

class PairLog;
struct Impact;  // physics/impact.hpp
enum class CollisionKind : std::uint8_t;

/// Collisions from time 0 on have the indices 1, 2, … For two blocks beside something immovable,
/// earlier collisions are known too, with indices 0, -1, … down to first_index(). Several
/// collisions at one instant happen in the order of TieRank (contact.hpp).
///
/// No answer depends on earlier questions. Const members are thread-safe. Those that have to step
/// more than kMaxSteppedCollisions, or a number beyond the range of a double, throw
/// SimulationError.
class Log {
 public:
  virtual ~Log() = default;
  Log(const Log&) = delete;
  Log& operator=(const Log&) = delete;

  const System& system() const noexcept { return system_; }

  /// Index of the first collision of all time; 1 if there are none before time 0.
  virtual Integer first_index() const { return 1; }
  /// Whether the run has a collision with this index. Computes all collisions until then.
  virtual bool has(const Integer& index) const = 0;
  /// Index of the last collision of the run, and the number of those from time 0 on. Computes all.
  /// Of a run that may never end it is the last one until the horizon.
  /// @throws UsageError if the run may never end and there is no horizon.
  virtual Integer last() const = 0;
  /// Whether collisions may go on for ever: may_never_end(system()).
  virtual bool never_ends() const { return false; }
  /// The time until which collisions count where they may never end; nothing where they do. See
  /// make_log().
  virtual std::optional<Rational> horizon() const { return std::nullopt; }
  /// Whether last() is known without a step.
  virtual bool knows_last() const noexcept { return false; }
  /// Whether last() has an answer: the run ends, or there is a horizon.
  bool has_last() const { return !never_ends() || horizon(); }
  /// Whether the collision is one of first_index() … last(). Asks for no later ones.
  bool is_listed(const Integer& index) const;
  /// The collision with this index, if has(index).
  /// @throws SimulationError if its time or state is beyond the range of a double.
  virtual Collision collision(const Integer& index) const = 0;
  /// When it happens, to two doubles. @throws as collision()
  virtual Time collision_time(const Integer& index) const { return collision(index).time; }
  /// A time at which exactly the collisions up to this one have happened: that of the collision if
  /// its exact value is short, otherwise one so little later that no picture can show the
  /// difference.
  /// @throws UsageError if the next collision happens at the same time.
  /// @throws SimulationError if a stepping engine cannot tell the two times apart.
  virtual Rational time_after(const Integer& index) const = 0;

  /// The bodies at a time. A collision exactly at `time` has happened.
  /// @throws UsageError if the time is negative, unless the past is known; SimulationError if there
  ///         are more than kMaxSteppedCollisions until then.
  virtual State state_at(const Rational& time) const = 0;
  /// How far the position of each body may be from the truth at most, in units of length; nothing
  /// where that is not known, as of all that is stepped. @throws as state_at().
  virtual std::optional<std::vector<double>> position_bounds(const Rational& time) const;
  /// Index of the last collision until then; 0 for times before 0 whose past is not known.
  virtual Integer count_at(const Rational& time) const = 0;
  /// The first collision at this time or later; the one after the last if there is none.
  virtual Integer first_since(const Rational& time) const;
  /// The way of each body between two times, from <= to: its centre at both, and at each of its
  /// collisions between. Of a body with more than `most` collisions there are `most` >= 2 points:
  /// both ends, and one at an irregular time in each of equal parts of the time between.
  /// @throws as state_at().
  virtual std::vector<std::vector<PathPoint>> paths(const Rational& from, const Rational& to,
                                                    std::size_t most) const = 0;

  /// Whether the collision is computed in rational numbers, so that each of its numbers is the
  /// nearest double to the true one. In closed form it is if the outer block is not the heavier
  /// one; else numbers are some units in the last place off.
  virtual bool is_exact(const Integer& index) const = 0;
  /// The first collision up to `last` of a body that has another one at the same time: TieRank then
  /// decides which comes first, if contacts are in order. Looks at collisions in rational numbers
  /// and at contacts at once; nothing if there is none.
  virtual std::optional<Integer> first_tie(const Integer& last) const = 0;
  /// The time up to which rounding cannot have changed which bodies collide, or the order in which
  /// each one meets others. Nothing if this holds until `time`; without a time, if it holds for
  /// some 10^9 times the length of the run.
  virtual std::optional<double> certain_until(const std::optional<Rational>& time) const = 0;
  /// Whether all collisions are certain, at any time. The call does not step the run.
  virtual bool is_always_certain() const noexcept { return false; }

  /// The first collapse until `until`; without a time, of the whole run, or until the horizon.
  /// Nothing if there is none. Of a run that is stepped the log ends with it, and nothing that
  /// follows is certain.
  virtual std::optional<Collapse> collapse(const std::optional<Rational>& /*until*/) const {
    return std::nullopt;
  }

  /// As count_at(), except that collisions within the rounding of `time` and of the engine may
  /// count as earlier or later. For two blocks, more collisions cost no more.
  virtual Integer count_near(const Time& time) const { return count_at(to_rational(time)); }
  /// The collisions of this kind among first … last, taken together, for sound; nothing if there
  /// are none. Immovable bodies count as walls.
  virtual std::optional<Impact> impact(CollisionKind kind, const Integer& first,
                                       const Integer& last) const;
  /// For sound, a run's impulses are divided by this: the impulse that a wall gives a body of mean
  /// mass at the mean speed. Its cost grows with the number of bodies.
  virtual double impulse_unit() const;

  /// The log of two blocks beside something immovable; else nullptr.
  virtual const PairLog* pair() const noexcept { return nullptr; }

 protected:
  explicit Log(System system) : system_(std::move(system)) {}

 private:
  System system_;
};

/// Whether log.last() stands for infinitely many collisions: see Collapse.
inline bool is_endless(const Log& log) { return log.collapse({}).has_value(); }

/// The collapse at which certainty ends; nothing if rounding ends it earlier.
/// @param certain_until  as the log says of the same time
inline std::optional<Collapse> collapse_at(const Log& log, double certain_until,
                                           const std::optional<Rational>& time) {
  std::optional<Collapse> collapse = log.collapse(time);
  const bool is_first = collapse && collapse->time && collapse->time->hi <= certain_until;
  return is_first ? std::move(collapse) : std::nullopt;
}

enum class Engine {
  unfolded,  ///< the cheapest that is right: a closed form, exact or certified steps
  events     ///< the article's event loop in double precision, whose errors nothing bounds
};

/// Most bodies that Engine::events steps; its memory grows with their square.
inline constexpr std::size_t kMaxEventBodies = 1000;

/// Two blocks and one wall or immovable block beside them are in closed form. All others are
/// stepped and stored. Nothing is stepped yet.
/// @param horizon  the time until which collisions count where they may never end, >= 0
/// @param stop     from when it asks to stop on, members that have to step throw Interrupted
/// @throws SceneError if problems_of(system) is not empty; UsageError if the horizon is negative,
/// or
///         Engine::events is asked for more than kMaxEventBodies, for more than
///         kMaxStoredCollisions of two blocks, or for inelastic ones.
std::unique_ptr<Log> make_log(const System& system, const std::optional<Rational>& horizon = {},
                              const std::stop_token& stop = {}, Engine engine = Engine::unfolded);

}  // namespace piblocks
