// Holds the elementary functions to MPFR.
// In: a function of core/rounded.hpp by its number in kFunctions. Out: how often it differs from
// MPFR, how often it needed MPFR, and how wrong its approximation is.
#pragma once

#include <piblocks/exact.hpp>

#include <array>
#include <cstdint>
#include <ostream>

#include "support/property.hpp"

namespace piblocks {

/// One argument, or two.
using Arguments = std::array<double, 2>;

/// A function of one argument leaves the second alone.
struct RoundedFunction {
  const char* name;
  double (*rounded)(double, double);
  double (*by_mpfr)(double, double);
  DoubleDouble (*near)(double, double);  ///< none if MPFR does all
  /// Distance of `near` from MPFR's value of 200 bits, in parts of that.
  double (*error)(const DoubleDouble& near, double, double);
  double (*from_c_library)(double, double);
  Arguments (*random_arguments)(Random& random);

  friend void PrintTo(const RoundedFunction& function, std::ostream* out) { *out << function.name; }
};

extern const std::array<RoundedFunction, 10> kRoundedFunctions;

struct RoundingTally {
  std::int64_t wrong = 0;
  std::int64_t unlike_c = 0;   ///< differs from the C library
  std::int64_t outside = 0;    ///< of the approximation's domain
  std::int64_t undecided = 0;  ///< the approximation could not tell how to round
  double largest_error = 0;    ///< of the approximation
  Arguments wrong_at{};
  Arguments largest_error_at{};
};

/// Whether two doubles have the same bits, or both are no numbers.
bool is_same(double a, double b);

/// @param error_every  the approximation's error is measured for one of so many arguments
RoundingTally check_rounding(const RoundedFunction& function, std::int64_t arguments, Random random,
                             std::int64_t error_every);

}  // namespace piblocks
