// How near a count of digits of pi comes to another digit.
// In: a base and the places after the point. Out: exact distances, and digits that are certain.
#pragma once

#include <piblocks/exact.hpp>

#include <string>

namespace piblocks {

/// With s = base^-places and theta = arctan s, the count is ceil(pi/theta) - 1, and the first
/// digits of pi are floor(pi/s). pi/theta is a little more than pi/s, by about pi s/3.
class DigitMargin {
 public:
  /// @param base  kMinBase … kMaxBase
  DigitMargin(int base, unsigned long places);

  int base() const noexcept { return base_; }
  unsigned long places() const noexcept { return places_; }
  /// The digits of pi that are counted, as one whole number.
  const Integer& whole() const noexcept { return whole_; }

  // Relative errors are below 2^-100.
  const Rational& fraction() const noexcept { return fraction_; }  ///< pi/s - whole()
  const Rational& excess() const noexcept { return excess_; }      ///< pi/theta - pi/s, > 0
  /// Whether the count is one more than whole().
  bool is_wrong() const noexcept { return fraction_ + excess_ > 1; }

  // Truncated to so many places of the base: "314.159", with separators in base 10.
  std::string scaled_pi(std::size_t digits) const;      ///< pi/s
  std::string pi_over_theta(std::size_t digits) const;  ///< "4" where there are no places
  /// The next digits of pi.
  std::string following(std::size_t digits) const;
  /// The next digits of the least pi with which the count would be more than whole().
  std::string needed(std::size_t digits) const;
  /// With how many digits base - 1 (nines in base 10) needed() begins.
  std::size_t nines() const;

 private:
  int base_;
  unsigned long places_;
  Rational scale_;  ///< 1/s
  Integer whole_;
  Rational fraction_;
  Rational excess_;
};

}  // namespace piblocks
