#include "scene/counted_pi.hpp"

#include <fmt/format.h>
#include <piblocks/exact.hpp>
#include <piblocks/two_blocks.hpp>

#include "core/real.hpp"

namespace piblocks {
namespace {

/// Whether the count is the number of whole multiples of θ = arctan √(m1/m2) in half a turn.
bool counts_angles(const TwoBlocks& system) {
  return is_elastic(system) && system.blue.velocity == 0 && system.red.velocity < 0 &&
         system.blue_gap() > 0;
}

/// "31.4…" for 314
std::string text_of_tenths(const Integer& tenths) {
  return fmt::format("{}.{}…", with_thousands_separators(tenths / 10),
                     Integer(tenths % 10).get_str());
}

}  // namespace

std::optional<unsigned long> places_of_pi(const TwoBlocks& system, int base) {
  const Rational ratio = system.red.mass / system.blue.mass;
  if (!counts_angles(system)) return std::nullopt;
  Integer rest;
  const unsigned long places =
      mpz_remove(rest.get_mpz_t(), ratio.get_num_mpz_t(), Integer(base * base).get_mpz_t());
  if (ratio.get_den() != 1 || rest != 1) return std::nullopt;
  return places;
}

std::string counted_pi(const TwoBlocks& system, const Integer& total, int base) {
  if (!places_of_pi(system, base)) return {};
  const std::string counted = total.get_str(base);
  std::string pi = pi_digits(base, counted.size());
  std::string digits = pi;
  std::erase(digits, '.');
  return counted == digits ? pi : std::string();
}

std::string half_turn_text(const TwoBlocks& system) {
  constexpr int kMostTenths = 10'000'000;
  constexpr int kLeastRoot = 10;
  constexpr mpfr_prec_t kBits = 128;
  const Rational ratio = system.red.mass / system.blue.mass;
  // No other rational number is the squared tangent of a whole part of pi (Niven, "Irrational
  // Numbers").
  const bool is_whole = ratio == 1 || ratio == 3 || ratio == Rational(1, 3);
  if (is_whole || !counts_angles(system)) return {};
  const Real tenfold_pi = Real::pi(kBits) * Real(kBits, 10);
  const Integer tenths = (tenfold_pi / atan(sqrt(Real(kBits, 1 / ratio)))).floor();
  if (tenths >= kMostTenths) return {};
  const Integer root = sqrt(Integer(ratio.get_num()));
  const Integer scaled_pi = (tenfold_pi * Real(kBits, root)).floor();
  if (root < kLeastRoot || Rational(root * root) != ratio || scaled_pi / 10 != tenths / 10) {
    return "π/θ = " + text_of_tenths(tenths);
  }
  return fmt::format("π/θ ≈ {}π = {}", with_thousands_separators(root), text_of_tenths(scaled_pi));
}

}  // namespace piblocks
