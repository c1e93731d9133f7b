// Counts as pictures show them, and the digits of pi, in every base.
#include <gtest/gtest.h>
#include <piblocks/exact.hpp>

#include <algorithm>
#include <string>

namespace piblocks {
namespace {

TEST(CountText, HasSeparatorsInBaseTenAlone) {
  EXPECT_EQ(count_text(3141, 10), "3,141");
  EXPECT_EQ(count_text(-314159, 10), "-314,159");
  EXPECT_EQ(count_text(12, 2), "1100");
  EXPECT_EQ(count_text(-12, 2), "-1100");
  EXPECT_EQ(count_text(0, 16), "0");
  EXPECT_EQ(count_text(0x3243f6a8, 16), "3243f6a8");
  EXPECT_EQ(count_text(35, 36), "z");
}

TEST(PiDigits, AreTheKnownOnes) {
  const std::pair<int, std::string> known[] = {
      {2, "11.001001000011111101101010100010001000010110100011"},
      {3, "10.0102110122220102110021"},
      {8, "3.1103755242102643"},
      {10, "3.14159265358979323846264338327950288419716939937510582097494"},
      {16, "3.243f6a8885a308d3"}};
  for (const auto& [base, expansion] : known) {
    const std::size_t point = expansion.find('.');
    for (std::size_t count = 0; count < expansion.size(); ++count) {
      const std::size_t length = count > point ? count + 1 : count;
      EXPECT_EQ(pi_digits(base, count), expansion.substr(0, length)) << base;
    }
  }
}

/// floor(unit * arctan(1/n)), with an error of less than one for each of its terms.
Integer scaled_arctan_of_inverse(int n, const Integer& unit) {
  Integer sum = 0;
  Integer power = unit / n;
  for (int k = 1; power != 0; k += 2, power /= n * n) {
    const Integer term = power / k;
    sum += k % 4 == 1 ? term : Integer(-term);
  }
  return sum;
}

/// pi = 16 arctan(1/5) - 4 arctan(1/239) (Machin) in whole numbers. @return the digits, no point
std::string machin_digits(int base, unsigned long places) {
  constexpr unsigned long kGuardPlaces = 20;
  const Integer guard = power(base, kGuardPlaces).get_num();
  const Integer unit = power(base, places).get_num() * guard;
  const Integer pi =
      16 * scaled_arctan_of_inverse(5, unit) - 4 * scaled_arctan_of_inverse(239, unit);
  // The error is below 20 for each of the terms, of which there are less than the bits of `unit`.
  const Integer error = 20 * mpz_sizeinbase(unit.get_mpz_t(), 2);
  const Integer low = (pi - error) / guard;
  EXPECT_EQ(low, (pi + error) / guard) << "more guard places are needed";
  return low.get_str(base);
}

TEST(PiDigits, AreThoseOfMachinsFormula) {
  for (int base = kMinBase; base <= kMaxBase; ++base) {
    for (const unsigned long places : {1UL, 2UL, 10UL, 99UL, 1000UL}) {
      const std::string expected = machin_digits(base, places);
      std::string digits = pi_digits(base, expected.size());
      EXPECT_EQ(std::erase(digits, '.'), 1U);
      EXPECT_EQ(digits, expected) << base;
    }
  }
}

/// Some of these need more than the first precision, where digits 0 or B - 1 follow.
TEST(PiDigits, FewerAreTheBeginningOfMore) {
  for (int base = kMinBase; base <= kMaxBase; ++base) {
    const std::string many = pi_digits(base, 1000);
    for (std::size_t count = 1; count < 1000; ++count) {
      EXPECT_TRUE(many.starts_with(pi_digits(base, count))) << base << ' ' << count;
    }
  }
}

}  // namespace
}  // namespace piblocks
