// Blocks on a line, from collision to collision in rational numbers.
// In: a System of one dimension, without problems. Out: its collisions, without rounding; the
// state from which another engine goes on.
#pragma once

#include <piblocks/contact.hpp>
#include <piblocks/system.hpp>

#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "physics/stepper.hpp"
#include "physics/tournament.hpp"

namespace piblocks {

/// A block or a wall, at one instant.
struct LineElement {
  std::uint32_t id = 0;          ///< as in Collision
  std::optional<Rational> mass;  ///< nothing: no collision moves it
  Rational half_width;           ///< 0 for a wall
  Rational position;             ///< of the centre, at the time `since`
  Rational velocity;
  Rational since = 0;
  Rational restitution = 1;  ///< of the next element on the right and this one

  Rational position_at(const Rational& time) const { return position + velocity * (time - since); }
};

TieRank rank_of(const LineElement& a, const LineElement& b);

/// The blocks, and the walls next to them, from left to right.
std::vector<LineElement> elements_of(const System& system);

/// Of two neighbours on the line whose motions come from an engine: the step, with the lower id
/// first.
SteppedCollision step_of(const Time& time, std::uint32_t left_id, const Motion& left,
                         std::uint32_t right_id, const Motion& right);

class ExactLine {
 public:
  explicit ExactLine(const System& system);
  // The tournament's comparison refers to this.
  ExactLine(const ExactLine&) = delete;
  ExactLine& operator=(const ExactLine&) = delete;
  ~ExactLine() = default;

  /// The next collision; none if there will be no more. If two that no collision moves meet, this
  /// is a step, too, which changes nothing.
  std::optional<SteppedCollision> step();
  /// Whether elements() are already those after further steps, which happen at once with the last.
  bool is_within_stage() const noexcept { return !pending_.empty(); }
  /// The longest number of the last step, numerator and denominator together.
  std::size_t bits() const noexcept { return bits_; }
  const std::vector<LineElement>& elements() const noexcept { return elements_; }
  /// Of the last step; 0 before the first.
  const Rational& time() const noexcept { return time_; }

 private:
  struct Earlier {
    const ExactLine& line;
    bool operator()(std::size_t a, std::size_t b) const;
  };

  void predict(std::size_t pair);
  bool meet();
  void take_stage();
  bool strike_at_once();
  void put_back_all_but_first();
  void report(std::size_t pair);
  bool is_jam(std::size_t pair) const { return !elements_[pair].mass && !elements_[pair + 1].mass; }
  bool is_in_stage(std::size_t pair) const {
    return std::ranges::find(stage_, pair) != stage_.end();
  }
  /// Whether there is this pair and it meets now.
  bool is_due(std::size_t pair) const {
    return pair < meetings_.size() && meetings_[pair] && *meetings_[pair] == time_;
  }

  std::vector<LineElement> elements_;
  std::vector<std::optional<Rational>> meetings_;  // of elements n and n + 1: when they meet
  Tournament<Earlier> next_;
  bool is_at_once_;
  std::vector<std::size_t> stage_;         // pairs that collide now, in their order
  std::vector<SteppedCollision> pending_;  // of the stage, the next one last
  Rational time_ = 0;
  std::size_t bits_ = 0;
};

/// From there on in double precision, with a bound of the error: up to when rounding cannot have
/// changed the order of collisions.
/// @param elements    as ExactLine has them just after the collision at `begin`.
/// @param is_at_once  whether the system has contacts at once. Pairs are taken in order here, so
///                    certainty ends where the two might differ.
std::unique_ptr<Stepper> make_certified_line(std::span<const LineElement> elements,
                                             const Rational& begin, bool is_at_once);

}  // namespace piblocks
