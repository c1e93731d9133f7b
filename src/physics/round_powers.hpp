// What n rounds of two collisions do: the n-th power of one 2x2 matrix, at the price of one.
// In: its trace and determinant, and sequences that it governs. Out: their terms, and where they
// change sign, decided beyond doubt. Notation: README.md, "Restitution".
#pragma once

#include <piblocks/exact.hpp>

#include <optional>
#include <vector>

#include "core/real.hpp"

namespace piblocks {

/// A sequence z_k = a C_k + b S_k, which obeys z_{k+1} = T z_k - D z_{k-1}.
struct RoundSequence {
  Rational a;  ///< z_0
  Rational b;  ///< 2 z_1 - T z_0
};

/// C_k and S_k, where the eigenvalues of the matrix to the power k are C_k ± S_k sqrt(T^2 - 4D).
class RoundPowers {
 public:
  /// @param trace        T
  /// @param determinant  D >= 0
  RoundPowers(Rational trace, Rational determinant);

  const Rational& trace() const noexcept { return trace_; }
  const Rational& determinant() const noexcept { return determinant_; }
  RoundSequence sequence(const Rational& z_0, const Rational& z_1) const {
    return {z_0, 2 * z_1 - trace_ * z_0};
  }

  /// First k with z_k <= 0 of a sequence with z_0 > 0; nothing if there is none.
  /// @throws SimulationError if kMaxDecisionBits do not decide.
  std::optional<Integer> first_not_positive(const RoundSequence& z) const;
  /// First k with z_k > 0 of a sequence with z_0 <= 0; nothing if there is none, or if the terms
  /// have changed sign twice by then.
  /// @throws SimulationError as first_not_positive().
  std::optional<Integer> first_positive(const RoundSequence& z) const;
  /// Whether the greater eigenvalue, which is real and positive, has no part in the sequence.
  bool lacks_greater(const RoundSequence& z) const;
  /// The limit of y_k/z_k as k grows, for real positive eigenvalues, of which the greater has a
  /// part in z.
  Real limit_of_ratio(const RoundSequence& y, const RoundSequence& z, mpfr_prec_t bits) const;

  /// D^k, with a relative error below 2^-good_bits.
  Real determinant_power(const Integer& k, mpfr_prec_t good_bits) const;
  /// The terms number k, each with a relative error below 2^-good_bits.
  /// @throws SimulationError if kMaxDecisionBits do not suffice.
  std::vector<Real> terms(const std::vector<RoundSequence>& sequences, const Integer& k,
                          mpfr_prec_t good_bits) const;
  /// The term exactly, unless that takes numbers of more than about max_bits.
  std::optional<Rational> exact_term(const RoundSequence& z, const Integer& k,
                                     double max_bits) const;

 private:
  /// What the eigenvalues are, and so how sequences change sign.
  enum class Kind {
    circular,    // complex: sequences swing about 0
    parabolic,   // equal and positive
    hyperbolic,  // different and positive
    singular,    // one is 0, the other positive
    alternating  // real and not positive: no two consecutive rounds have the same signs
  };
  /// The numbers that do not depend on k.
  struct Rates {
    Real root;    // w = sqrt(|T^2 - 4D|)
    Real angle;   // circular: of a round; hyperbolic: ln(greater/lesser eigenvalue)
    Real growth;  // ln of the greater eigenvalue's modulus
    Real loss;    // ln D, if D > 0
  };
  /// C_k and S_k with errors below 2^c_error and 2^s_error.
  struct Powers {
    Real c;
    Real s;
    long c_error;
    long s_error;
  };
  struct ExactPowers {
    Rational c = 1;
    Rational s = 0;
  };
  /// The real number k at which a C_k + b S_k changes sign.
  struct SignChange {
    Integer floor;
    bool is_exact;  // at a whole k, so that this term is 0
  };

  static Kind kind_of(const Rational& trace, const Rational& determinant,
                      const Rational& discriminant);
  Rates make_rates(mpfr_prec_t bits) const;
  Rates rates(mpfr_prec_t bits) const;
  /// 2 artanh(a w/-b) for 0 < a w < -b.
  Real doubled_artanh(const Rational& a, const Rational& b, const Real& root) const;
  /// a w + b without cancellation.
  Real plus_root(const RoundSequence& z, const Real& root) const;
  /// For z.a >= 0.
  SignChange sign_change(const RoundSequence& z) const;
  Powers powers(const Integer& k, mpfr_prec_t bits) const;
  std::optional<ExactPowers> exact_powers(const Integer& k, double max_bits) const;
  /// Whether all terms from a positive one on are positive.
  bool stays_positive(const RoundSequence& z) const;

  Rational trace_;
  Rational determinant_;
  Rational discriminant_;  // T^2 - 4D
  Kind kind_;
  double size_bits_;  // of the numbers of one round
  /// Precisions with which answers begin: a decision, and a term with what its sum cancels.
  mpfr_prec_t decision_bits_;
  mpfr_prec_t term_bits_;
  Rates decision_rates_;
  Rates term_rates_;
};

}  // namespace piblocks
