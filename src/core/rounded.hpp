// Elementary functions that are correctly rounded: the nearest double to the exact value.
// In: doubles. Out: the same bits on every machine; those of the C library differ by version and
// processor.
// Infinities, zeros and what is not defined are as in IEEE 754-2008, 9.2, and Annex F of C.
#pragma once

namespace piblocks::rounded {

// Fast: 20 to 60 ns, except for arguments that near_functions.hpp leaves out.
double sin(double x);
double cos(double x);
struct SinCos {
  double sin;
  double cos;
};
/// Both, for little more than one.
SinCos sin_cos(double x);
double atan2(double y, double x);
double exp(double x);
double log(double x);
double log1p(double x);
double hypot(double x, double y);

/// By MPFR: microseconds.
double log10(double x);

}  // namespace piblocks::rounded
