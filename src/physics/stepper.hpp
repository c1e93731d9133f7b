// What steps bodies from collision to collision.
// In: a System without problems. Out: its collisions one after the other, up to when they are
// certain to be the true ones, and whether they end in a collapse.
#pragma once

#include <piblocks/log.hpp>

#include <limits>
#include <memory>
#include <optional>
#include <vector>

namespace piblocks {

/// What is stored of a collision; motions are those just after it.
struct StoredStep {
  Time time;
  std::uint32_t first = 0;  ///< as in Collision
  std::uint32_t second = 0;
  Motion first_after = {};
  Motion second_after = {};
};

struct SteppedCollision : StoredStep {
  std::optional<Rational> exact_time = {};  ///< if the engine knows it
  /// Whether one of the two has another collision at this time; false if not known.
  bool is_tied = false;
};

inline constexpr double kForEver = std::numeric_limits<double>::infinity();

class Stepper {
 public:
  Stepper() = default;
  Stepper(const Stepper&) = delete;
  Stepper& operator=(const Stepper&) = delete;
  virtual ~Stepper() = default;

  /// The next collision; none if there will be no more. Times never decrease. Several at the same
  /// time are in the order of TieRank (contact.hpp).
  /// @throws SimulationError if a number leaves the range of a double.
  virtual std::optional<SteppedCollision> step() = 0;
  /// Until when rounding cannot have changed what collides with what, as far as is known by now.
  /// Before that time each body meets those bodies and walls that it truly meets, in the true
  /// order. It falls once, from kForEver to a time not before the last certain collision.
  virtual double certain_until() const = 0;
};

/// Discs in a plane, in double precision, with an error bound for every number. A step costs
/// O(log N) for N discs of like size.
std::unique_ptr<Stepper> make_disc_stepper(const System& system);

/// Blocks on a line: in rational numbers while these are short, then in double precision with an
/// error bound.
std::unique_ptr<Stepper> make_line_stepper(const System& system);

/// Engine::events: EventSimulator in double precision. Nothing bounds its errors, so that all of
/// its steps count as certain.
/// @throws UsageError if there are more than kMaxEventBodies, or as require_elastic().
std::unique_ptr<Stepper> make_event_stepper(const System& system);
/// @throws UsageError if Engine::events cannot step this because it loses energy.
void require_elastic(const System& system);

/// Numbers of steps, ascending.
using StepNumbers = std::vector<std::uint32_t>;

inline double flight(const Time& from, const Time& to) {
  return (to.hi - from.hi) + (to.lo - from.lo);
}

/// The share of all time in which bodies that collapse have met very often.
inline constexpr double kCollapseWindow = 0x1p-48;

/// What cannot be stepped on.
struct EndOfSteps {
  std::vector<std::uint32_t> bodies;  ///< as Collapse::bodies
  bool is_collapse = true;            ///< false where doubles cannot tell whether it is one
};

/// The end that the last step is (README.md, "Collapse"); nothing if the run goes on.
/// @param of_body   the numbers of each body's steps
/// @param window    the time in which its bodies have met very often
/// @param is_exact  whether the last step was in rational numbers
std::optional<EndOfSteps> end_of_steps(const System& system, const std::vector<StoredStep>& steps,
                                       const std::vector<StepNumbers>& of_body, double window,
                                       bool is_exact);

}  // namespace piblocks
