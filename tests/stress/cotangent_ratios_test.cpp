// Mass ratios nearest to those whose last collision is never reached.
#include <gtest/gtest.h>
#include <mpfr.h>
#include <piblocks/two_blocks.hpp>

#include <algorithm>

#include "stress/cases.hpp"
#include "support/oracle.hpp"

namespace piblocks::stress {
namespace {

/// The double nearest to cot^2(pi/n).
double cotangent_squared(unsigned long n) {
  mpfr_t value;
  mpfr_init2(value, 256);
  mpfr_const_pi(value, MPFR_RNDN);
  mpfr_div_ui(value, value, n, MPFR_RNDN);
  mpfr_cot(value, value, MPFR_RNDN);
  mpfr_sqr(value, value, MPFR_RNDN);
  const double nearest = mpfr_get_d(value, MPFR_RNDN);
  mpfr_clear(value);
  return nearest;
}

// With the ratio cot^2(pi/n) itself pi/theta would be n and there would be n - 1 collisions. The
// double is beside it, on a side that only exact arithmetic knows: n - 1 or n.
TEST(CotangentRatios, AreCountedOnTheRightSide) {
  const auto last = static_cast<unsigned long>(std::min<std::int64_t>(many(400), 8000));
  long above = 0;
  for (unsigned long n = 3; n <= last; ++n) {
    TwoBlocks system;
    system.red.mass = Rational(cotangent_squared(n));
    const Integer total = oracle::high_precision_total(system);
    EXPECT_EQ(count_collisions(system), total) << "n = " << n;
    EXPECT_EQ(make_pair_log(system)->last(), total) << "n = " << n;
    EXPECT_TRUE(total == n - 1 || total == n) << "n = " << n << ": " << total;
    above += total == n ? 1 : 0;
  }
  EXPECT_GT(above, static_cast<long>(last / 3)) << "both sides occur";
  EXPECT_LT(above, static_cast<long>(last * 2 / 3)) << "both sides occur";
}

}  // namespace
}  // namespace piblocks::stress
