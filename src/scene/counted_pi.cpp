#include "scene/counted_pi.hpp"

#include <piblocks/exact.hpp>
#include <piblocks/two_blocks.hpp>

namespace piblocks {

std::optional<unsigned long> places_of_pi(const TwoBlocks& system, int base) {
  const Rational ratio = system.red.mass / system.blue.mass;
  const bool begins_apart = system.blue_gap() > 0;
  if (system.blue.velocity != 0 || system.red.velocity >= 0 || !begins_apart) return std::nullopt;
  if (!is_elastic(system)) return std::nullopt;
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

}  // namespace piblocks
