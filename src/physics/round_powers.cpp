#include "physics/round_powers.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include "physics/exact_motion.hpp"

namespace piblocks {
namespace {

/// Longest numbers of an exact power that are no slower than the same number by logarithms.
constexpr double kQuickPower_bits = 512;
/// Longest numbers built to test whether a term is 0, for each bit of the precision that has not
/// decided it. The test then takes no longer than more precision would.
constexpr double kTermTest_bits = 16;

long bits_of(const Integer& value) { return long(mpz_sizeinbase(value.get_mpz_t(), 2)); }

[[noreturn]] void give_up() {
  throw SimulationError(fmt::format(
      "restitution: {} bits do not decide how many collisions have happened", kMaxDecisionBits));
}

/// The exponent of the error of a product whose first factor is exact. @param error  of the second
long error_of(const Real& factor, long error) {
  constexpr long kNone = std::numeric_limits<long>::min() / 4;
  return factor.sign() == 0 ? kNone : factor.exponent() + error;
}

}  // namespace

RoundPowers::Kind RoundPowers::kind_of(const Rational& trace, const Rational& determinant,
                                       const Rational& discriminant) {
  if (discriminant < 0) return Kind::circular;
  if (trace <= 0) return Kind::alternating;
  if (determinant == 0) return Kind::singular;
  return discriminant == 0 ? Kind::parabolic : Kind::hyperbolic;
}

RoundPowers::RoundPowers(Rational trace, Rational determinant)
    : trace_(std::move(trace)),
      determinant_(std::move(determinant)),
      discriminant_(trace_ * trace_ - 4 * determinant_),
      kind_(kind_of(trace_, determinant_, discriminant_)),
      size_bits_(double(size_bits(trace_) + size_bits(determinant_))),
      // Rounds are about 1/w; their number, and what a term cancels, have as many bits.
      decision_bits_(96 + std::labs(Real(64, discriminant_).exponent())),
      term_bits_(224 + 2 * (decision_bits_ - 96)),
      decision_rates_(make_rates(decision_bits_)),
      term_rates_(make_rates(term_bits_)) {}

Real RoundPowers::doubled_artanh(const Rational& a, const Rational& b, const Real& root) const {
  const mpfr_prec_t bits = root.bits();
  const Real part = Real(bits, a) * root;
  const Real sum = part + Real(bits, Rational(-b));
  const Real share = scaled(part, 1) / sum;
  if (share.exponent() < 0) return -log1p(-share);  // below 1/2
  // (-b - a w)/(-b + a w), without cancellation.
  return -log(Real(bits, b * b - a * a * discriminant_) / (sum * sum));
}

RoundPowers::Rates RoundPowers::make_rates(mpfr_prec_t bits) const {
  const Real root = sqrt(Real(bits, abs(discriminant_)));
  const Real trace(bits, trace_);
  Rates made{root, Real(bits, 0), Real(bits, 0), Real(bits, 0)};
  if (determinant_ != 0) made.loss = log(Real(bits, determinant_));
  switch (kind_) {
    case Kind::circular:
      made.angle = atan2(root, trace);
      made.growth = scaled(made.loss, -1);
      break;
    case Kind::parabolic:
      made.growth = log(scaled(trace, -1));
      break;
    case Kind::hyperbolic:
      made.angle = doubled_artanh(1, -trace_, root);
      made.growth = log(scaled(trace + root, -1));
      break;
    case Kind::singular:
    case Kind::alternating:
      break;
  }
  return made;
}

RoundPowers::Rates RoundPowers::rates(mpfr_prec_t bits) const {
  if (bits <= decision_bits_) return decision_rates_;
  return bits <= term_bits_ ? term_rates_ : make_rates(bits);
}

bool RoundPowers::lacks_greater(const RoundSequence& z) const {
  // a w + b = 0.
  return z.b * z.b == z.a * z.a * discriminant_ && (z.b == 0 || sgn(z.b) == -sgn(z.a));
}

bool RoundPowers::stays_positive(const RoundSequence& z) const {
  return z.b >= 0 || z.b * z.b <= z.a * z.a * discriminant_;
}

Real RoundPowers::plus_root(const RoundSequence& z, const Real& root) const {
  const mpfr_prec_t bits = root.bits();
  const Real product = Real(bits, z.a) * root;
  const Real rest(bits, z.b);
  if (product.sign() * rest.sign() >= 0) return product + rest;
  return Real(bits, z.a * z.a * discriminant_ - z.b * z.b) / (product - rest);
}

Real RoundPowers::limit_of_ratio(const RoundSequence& y, const RoundSequence& z,
                                 mpfr_prec_t bits) const {
  const Real root = rates(bits).root;
  return plus_root(y, root) / plus_root(z, root);
}

RoundPowers::SignChange RoundPowers::sign_change(const RoundSequence& z) const {
  if (z.a == 0 && z.b < 0) return {0, true};
  if (kind_ == Kind::parabolic) {
    const Rational at = z.a * trace_ / -z.b;
    return {floor(at), at.get_den() == 1};
  }
  for (mpfr_prec_t bits = decision_bits_; bits <= kMaxDecisionBits; bits *= 2) {
    const Rates now = rates(bits);
    const Real swept = kind_ == Kind::circular ? atan2(Real(now.root.bits(), z.a) * now.root,
                                                       Real(now.root.bits(), Rational(-z.b)))
                                               : doubled_artanh(z.a, z.b, now.root);
    const Real at = swept / now.angle;
    // Every rounding is relative, and none of the steps enlarges it much.
    const Real error = scaled(Real(bits, 1), at.exponent() + 8 - bits);
    const Integer low = (at - error).floor();
    const Integer high = (at + error).floor();
    if (low == high) return {low, false};
    const auto term = exact_term(z, high, kTermTest_bits * double(bits));
    if (term && *term == 0) return {high, true};
  }
  give_up();
}

std::optional<Integer> RoundPowers::first_not_positive(const RoundSequence& z) const {
  if (kind_ == Kind::alternating || kind_ == Kind::singular) {
    const Rational second = (z.a * trace_ + z.b) / 2;
    if (second <= 0) return 1;
    return kind_ == Kind::singular ? std::nullopt : std::optional<Integer>(2);
  }
  if (kind_ != Kind::circular && stays_positive(z)) return std::nullopt;
  const auto [whole, is_exact] = sign_change(z);
  return is_exact ? whole : Integer(whole + 1);
}

std::optional<Integer> RoundPowers::first_positive(const RoundSequence& z) const {
  if (kind_ == Kind::alternating || kind_ == Kind::singular) {
    return z.a * trace_ + z.b > 0 ? std::optional<Integer>(1) : std::nullopt;
  }
  const RoundSequence opposite{-z.a, -z.b};
  if (kind_ == Kind::circular ? z.a == 0 && z.b == 0 : stays_positive(opposite)) {
    return std::nullopt;
  }
  return sign_change(opposite).floor + 1;
}

std::optional<RoundPowers::ExactPowers> RoundPowers::exact_powers(const Integer& k,
                                                                  double max_bits) const {
  if (k.get_d() * size_bits_ > max_bits) return std::nullopt;
  ExactPowers result;
  ExactPowers square{trace_ / 2, Rational(1, 2)};
  const auto product = [&](const ExactPowers& p, const ExactPowers& q) {
    return ExactPowers{p.c * q.c + discriminant_ * p.s * q.s, p.c * q.s + p.s * q.c};
  };
  for (unsigned long left = k.get_ui(); left != 0; left /= 2) {
    if (left % 2 == 1) result = product(result, square);
    if (left > 1) square = product(square, square);
  }
  return result;
}

std::optional<Rational> RoundPowers::exact_term(const RoundSequence& z, const Integer& k,
                                                double max_bits) const {
  const auto exact = exact_powers(k, max_bits);
  return exact ? std::optional<Rational>(z.a * exact->c + z.b * exact->s) : std::nullopt;
}

RoundPowers::Powers RoundPowers::powers(const Integer& k, mpfr_prec_t bits) const {
  const Rates now = rates(bits);
  const mpfr_prec_t used = now.root.bits();
  const Real number(used, Rational(k));
  const Real modulus = exp(number * now.growth);
  // The rounding of k ln(modulus), relative to the modulus: an eigenvalue near 1 has lost as much.
  const long error = number.exponent() + 6 - used;
  if (kind_ == Kind::circular) {
    const Real angle = number * now.angle;
    const long size = modulus.exponent() + error;
    const long turned = modulus.exponent() + std::max(0L, angle.exponent()) + 6 - used;
    const long root = now.root.exponent() - 1;
    // A sine is right to the angle's error, which is relative.
    const long sine = modulus.exponent() + angle.exponent() + 6 - used;
    const Real s = modulus * sin(angle) / now.root;
    const long sine_error = std::max(sine - root, s.exponent() + error);
    return {modulus * cos(angle), s, std::max(size, turned), sine_error};
  }
  if (kind_ == Kind::parabolic) {
    const Real s = modulus * number / Real(used, trace_);
    return {modulus, s, modulus.exponent() + error, s.exponent() + error};
  }
  const Real share = number * now.angle;
  const Real lost = -expm1(-share);  // 1 - (lesser/greater)^k
  const Real c = modulus * (Real(used, 1) - scaled(lost, -1));
  const Real s = scaled(modulus * lost, -1) / now.root;
  return {c, s, c.exponent() + error, s.exponent() + error};
}

Real RoundPowers::determinant_power(const Integer& k, mpfr_prec_t good_bits) const {
  if (k == 0) return {good_bits, 1};
  if (determinant_ == 0) return {good_bits, 0};
  const Real loss = rates(good_bits + 16 + bits_of(k)).loss;
  return exp(Real(loss.bits(), Rational(k)) * loss);
}

std::vector<Real> RoundPowers::terms(const std::vector<RoundSequence>& sequences, const Integer& k,
                                     mpfr_prec_t good_bits) const {
  const auto exactly = [&](const ExactPowers& exact) {
    std::vector<Real> values;
    values.reserve(sequences.size());
    for (const auto& [a, b] : sequences) {
      values.emplace_back(good_bits + 2, a * exact.c + b * exact.s);
    }
    return values;
  };
  if (kind_ == Kind::singular && k > 0) {  // T^(k-1) z_1, in which nothing cancels
    const mpfr_prec_t bits = good_bits + 16 + bits_of(k);
    const Real power = exp(Real(bits, Rational(k - 1)) * log(Real(bits, trace_)));
    std::vector<Real> values;
    values.reserve(sequences.size());
    for (const auto& [a, b] : sequences) {
      values.push_back(power * Real(bits, (a * trace_ + b) / 2));
    }
    return values;
  }
  const double quick_bits = kind_ == Kind::alternating ? HUGE_VAL : kQuickPower_bits;
  if (const auto exact = exact_powers(k, quick_bits)) return exactly(*exact);
  mpfr_prec_t bits = std::max<mpfr_prec_t>(term_bits_, good_bits + 32);
  for (; bits <= kMaxDecisionBits; bits *= 2) {
    const Powers power = powers(k, bits);
    std::vector<Real> values;
    bool are_good = true;
    for (const auto& [a, b] : sequences) {
      const Real first(power.c.bits(), a);
      const Real second(power.c.bits(), b);
      const Real& value = values.emplace_back(first * power.c + second * power.s);
      if (a == 0 && b == 0) continue;
      const long error =
          2 + std::max(error_of(first, power.c_error), error_of(second, power.s_error));
      are_good = are_good && value.sign() != 0 && value.exponent() - error >= good_bits;
    }
    if (are_good) return values;
    if (const auto exact = exact_powers(k, kTermTest_bits * double(bits))) return exactly(*exact);
  }
  give_up();
}

}  // namespace piblocks
