#include "scene/counted_pi.hpp"

#include <fmt/format.h>
#include <piblocks/exact.hpp>
#include <piblocks/two_blocks.hpp>

#include <cmath>
#include <numbers>

#include "core/rounded.hpp"

namespace piblocks {
namespace {

/// Whether the count is the number of angles θ that half a turn has, without the last one where no
/// rest is left.
bool counts_angles(const TwoBlocks& system) {
  return is_elastic(system) && system.blue.velocity == 0 && system.red.velocity < 0 &&
         system.blue_gap() > 0;
}

/// "31.4…": the decimals are cut off.
std::string cut_text(double value) {
  const Integer tenths(std::floor(10 * value));
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
  constexpr double kMost = 1e6;
  constexpr int kLeastRoot = 10;
  const Rational ratio = system.red.mass / system.blue.mass;
  // No other rational number is the squared tangent of a whole part of pi (Niven, "Irrational
  // Numbers").
  const bool is_whole = ratio == 1 || ratio == 3 || ratio == Rational(1, 3);
  const double angles = std::numbers::pi / rounded::atan2(1, std::sqrt(to_double(ratio)));
  if (is_whole || !counts_angles(system) || !(angles < kMost)) return {};
  const Integer root = sqrt(Integer(ratio.get_num()));
  const double scaled_pi = std::numbers::pi * root.get_d();
  const bool is_near = std::floor(scaled_pi) == std::floor(angles);
  if (root < kLeastRoot || Rational(root * root) != ratio || !is_near) {
    return "π/θ = " + cut_text(angles);
  }
  return fmt::format("π/θ ≈ {}π = {}", with_thousands_separators(root), cut_text(scaled_pi));
}

}  // namespace piblocks
