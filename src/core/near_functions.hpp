// Elementary functions to more than a double's precision, for rounded.hpp.
// In: doubles. Out: sums of two doubles, hi the nearest double to the sum, that are off by less
// than kNearError of the value. Bits depend on IEEE 754 alone: not on a C library, nor on FMA.
#pragma once

#include <piblocks/exact.hpp>

#include <cmath>
#include <optional>

namespace piblocks::near {

/// Of the value; near_functions.cpp derives it for each function.
inline constexpr double kNearError = 0x1p-68;

/// The nearest double, if all values within the error of `near` round alike (Ziv's test).
inline std::optional<double> nearest_double(const DoubleDouble& near) {
  const double error = kNearError * std::fabs(near.hi);
  const double most = near.hi + (near.lo + error);
  if (most == near.hi + (near.lo - error)) return most;
  return std::nullopt;
}

/// Each function has a domain: the arguments for which this is cheap. Outside, lo is NaN.

/// 2^-27 <= |x| <= 2^10, and x not so near to a multiple of pi/2 that the value nearly vanishes.
DoubleDouble sin(double x);
DoubleDouble cos(double x);
struct SinCos {
  DoubleDouble sin;
  DoubleDouble cos;
};
SinCos sin_cos(double x);
/// |x| <= 600
DoubleDouble exp(double x);
/// x positive and normal
DoubleDouble log(double x);
/// log(1 + x) for x > -1 + 2^-53, and |x| from 2^-60 to 2^900
DoubleDouble log1p(double x);
/// |x| and |y| from 2^-480 to 2^480
DoubleDouble atan2(double y, double x);
/// a and b from 2^-480 to 2^480
DoubleDouble hypot(double a, double b);

}  // namespace piblocks::near
