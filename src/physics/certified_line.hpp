// Blocks on a line, from collision to collision in double precision, with a bound of the error.
// In: the exact state at one instant. Out: collisions, and up to when rounding cannot have changed
// their order.
#pragma once

#include <piblocks/system.hpp>

#include <optional>
#include <span>
#include <vector>

#include "physics/exact_line.hpp"
#include "physics/stepper.hpp"
#include "physics/tournament.hpp"

namespace piblocks {

/// README.md, "Blocks on a line", derives the bound. Each element has its own clock; clocks count
/// from the instant at which the line begins.
class CertifiedLine {
 public:
  /// @param elements    as ExactLine has them just after the collision at `begin`.
  /// @param is_at_once  whether the system has contacts at once. Pairs are taken in order here, so
  ///                    certainty ends where the two might differ.
  CertifiedLine(std::span<const LineElement> elements, const Rational& begin, bool is_at_once);
  CertifiedLine(const CertifiedLine&) = delete;
  CertifiedLine& operator=(const CertifiedLine&) = delete;
  ~CertifiedLine() = default;

  /// The next collision; none if there will be no more.
  /// @throws SimulationError if a number leaves the range of a double.
  std::optional<SteppedCollision> step();
  double certain_until() const;

 private:
  struct Element {
    std::uint32_t id = 0;
    double half_width = 0;
    double position = 0;
    double velocity = 0;
    double since = 0;      ///< clock of position
    double root_mass = 0;  ///< square root of the mass; 0 if no collision moves it
    bool is_movable = true;
  };
  /// Two neighbours.
  struct Pair {
    TieRank rank;
    double left_factor = 0;  ///< of the closing speed: by how much the left one's velocity changes
    double right_factor = 0;
    /// sqrt(1/m_left + 1/m_right): an error of norm E changes their gap by E times this at most.
    /// 0 if no collision moves them.
    double gap_per_norm = 0;
    double speed_rounding = 0;  ///< of the velocities that no collision changes
    bool has_met = false;       ///< and neither has met another since
    double due = kNever;        ///< clock of what comes next
    bool is_doubt = false;      ///< not a collision, but the earliest that there might be one
  };
  /// A gap, and how fast it closes.
  struct Approach {
    double clock = 0;
    double gap = 0;
    double rounding = 0;  ///< of the gap
    double closing = 0;
  };
  struct Earlier {
    const CertifiedLine& line;
    bool operator()(std::size_t a, std::size_t b) const;
  };
  static constexpr double kNever = piblocks::kForEver;

  bool is_certain() const noexcept { return certain_until_ == kNever; }
  Approach approach(std::size_t pair) const;
  /// The earliest clock at which the two may meet.
  double earliest(std::size_t pair, const Approach& approach) const;
  void predict(std::size_t pair);
  void replay_around(std::size_t pair);
  void predict_all();
  void end_certainty(double clock);
  /// @return whether what doubts were predicted with still holds.
  bool move_bounds_to(double clock);
  void check_order(std::size_t pair, double clock);
  void advance(Element& element, double clock);
  void collide(std::size_t pair);

  std::vector<Element> elements_;
  std::vector<Pair> pairs_;
  Tournament<Earlier> next_;
  Time begin_;
  double clock_ = 0;
  double certain_until_ = kNever;  // on the clock
  bool is_lossy_ = false;
  bool is_at_once_;
  // Norms of the errors of all positions and of all velocities, each weighted by the root of its
  // mass; and the larger ones that doubts have been predicted with.
  double position_error_ = 0;
  double velocity_error_ = 0;
  double position_budget_ = 0;
  double velocity_budget_ = 0;
};

}  // namespace piblocks
