// The motion of blocks that lose energy where they collide, in exact numbers.
// In: a TwoBlocks with restitutions below 1. Out: how many collisions have happened, decided
// beyond doubt, and the numbers of each. Notation: README.md, "Restitution".
#pragma once

#include <piblocks/two_blocks.hpp>

#include <array>
#include <optional>
#include <utility>

#include "physics/round_powers.hpp"

namespace piblocks {

/// Collision n and the one after it. The gap that collision n closes is r_n - s_n t at time t.
struct InelasticNumbers {
  Real speed;       ///< s_n > 0: with which the bodies approach each other
  Real reach;       ///< r_n = s_n t_n
  Real next_speed;  ///< s_{n+1}; not positive if there is no further collision
};

/// Sums over every other collision of a range.
struct InelasticSums {
  Real speeds;   ///< of s_n
  Real reaches;  ///< of r_n = s_n t_n
};

/// Where collisions follow each other fastest.
struct DensestCollisions {
  Rational time;
  /// Collisions per unit of time; nothing if there is no limit to that.
  std::optional<Rational> rate;
};

/// The gaps and their rates at one instant.
struct InelasticGaps {
  Real y1;
  Real y2;
  Real u1;
  Real u2;
};

struct InelasticMotion {
  /// Of two collisions that are due at once the blocks' is first.
  /// @throws SimulationError as RoundPowers.
  explicit InelasticMotion(const TwoBlocks& system);
  /// What happens if of collisions that are all due at once the others come first; nothing if they
  /// are infinitely many, or do not happen together from the first one on.
  std::optional<Corner> corner() const;

  /// A vector of the plane of the gaps: (y1, y2) or (u1, u2).
  struct Pair {
    Rational first;
    Rational second;
  };

  Rational ratio;               ///< m_blue / m_red
  Rational wall_restitution;    ///< e_w
  Rational blocks_restitution;  ///< e
  Pair gaps;                    ///< at time 0
  Pair rates;                   ///< at time 0
  Rational areal_velocity;      ///< L = y2 u1 - y1 u2 at time 0
  bool blocks_first = true;     ///< kind of collision 1
  bool collides = false;        ///< whether there is a collision 1
  Rational first_time;          ///< t_1
  RoundPowers powers;
  std::array<RoundSequence, 3> speeds;   ///< s_1, s_3, s_5 …; s_2, s_4 …; s_3, s_5 …
  std::array<RoundSequence, 3> reaches;  ///< r_n in the same way
  std::optional<Integer> total;          ///< nothing: infinitely many collisions
  Integer listed;                        ///< collisions in the log: total, if there is one

  CollisionKind kind(const Integer& n) const {
    return (mpz_odd_p(n.get_mpz_t()) != 0) == blocks_first ? CollisionKind::blocks
                                                           : CollisionKind::wall;
  }
  const Rational& restitution(CollisionKind kind) const {
    return kind == CollisionKind::wall ? wall_restitution : blocks_restitution;
  }
  /// Whether all collisions from this one on happen at the same time, in the corner.
  bool coincides_from(const Integer& n) const;
  /// When the last of infinitely many collisions would happen; nothing if never.
  std::optional<Real> collapse_time(mpfr_prec_t bits) const;
  /// The index of the last collision until then, those at it included.
  Integer count_at(const Rational& time) const;
  /// Whether the blocks rest from this collision on.
  bool is_end(const Integer& n) const { return !total && n == listed; }
  /// Of collision n >= 1, each with a relative error below 2^-good_bits, unless it is 0.
  InelasticNumbers numbers(const Integer& n, mpfr_prec_t good_bits) const;
  /// At a time that is not before the first collision, with count_at(time). The gaps have relative
  /// errors below 2^-good_bits. The rates are meaningless if the blocks rest.
  std::pair<Integer, InelasticGaps> state_at(const Rational& time, mpfr_prec_t good_bits) const;
  /// As in state_at(), just after collision n.
  InelasticGaps gaps_after(const Integer& n, mpfr_prec_t good_bits) const {
    return gaps_after(n, numbers(n, good_bits + 8), good_bits);
  }
  /// @param now  numbers(n, good_bits + 8)
  InelasticGaps gaps_after(const Integer& n, const InelasticNumbers& now,
                           mpfr_prec_t good_bits) const;
  /// Over the collisions first, first + 2, … last, which are of one kind; relative errors as above.
  InelasticSums sums(const Integer& first, const Integer& last, mpfr_prec_t good_bits) const;
  /// A time at which collision n has happened and the next has not: the collision's if that is a
  /// short number, otherwise one later by at most 2^-100 of the time between the two.
  Rational time_past(const Integer& n) const;

  /// When red is nearest to the wall, since time 0, as time_past(); nothing if that is never, or if
  /// nothing moves.
  std::optional<Rational> turn() const;
  /// Nothing if fewer than two collisions happen, or if infinitely many never end.
  std::optional<DensestCollisions> densest() const;

 private:
  /// All that follows from collision 1.
  void unroll();
  /// (sequence, k) of collision n.
  static std::size_t sequence_of(const Integer& n) { return mpz_even_p(n.get_mpz_t()) != 0; }
  static Integer round_of(const Integer& n) { return (n - 1) / 2; }
  Pair after(CollisionKind kind, const Pair& before) const;
  static Rational closing(CollisionKind kind, const Pair& rates);
  /// @param opened  minus the gap that n closed, before it is enlarged by the restitution
  /// @param to_close  the gap that n + 1 closes
  InelasticGaps folded(const Integer& n, const Real& opened, const Real& to_close,
                       const Real& speed, const Real& next_speed, mpfr_prec_t good_bits) const;
  InelasticGaps gaps_at(const Rational& time, const Integer& n, mpfr_prec_t good_bits) const;
  /// How many of the collisions 1, 3, 5 … have happened; nothing if all that are listed have, and
  /// no other is.
  std::optional<Integer> odd_until(const Rational& time) const;
  /// The collision beside which flights are shortest, of finitely many.
  Integer densest_index() const;
  /// The time between collision n and the next one, relative error below 2^-good_bits.
  Real flight_after(const Integer& n, mpfr_prec_t good_bits) const;
  /// |L| just before collision n, relative error below 2^-good_bits.
  Real areal_velocity_before(const Integer& n, mpfr_prec_t good_bits) const;
  /// Whether the log lists this one of infinitely many collisions: see Collapse::listed.
  bool is_listed(const Integer& n) const;
  void find_first_collision();
  void find_sequences();
  /// The gap that collisions of a sequence close, as it would be at this time without them.
  RoundSequence gap_at(std::size_t sequence, const Rational& time) const;
  std::optional<Integer> find_total() const;
  Integer find_listed() const;
  Real sum(const RoundSequence& z, const Integer& first, const Integer& last,
           mpfr_prec_t good_bits) const;
  Rational rounded_time(const Integer& n, mpfr_prec_t bits) const;
};

}  // namespace piblocks
