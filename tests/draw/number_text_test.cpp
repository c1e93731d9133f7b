#include "draw/number_text.hpp"

#include <gtest/gtest.h>

namespace piblocks {
namespace {

TEST(NumberText, FixedHasSeparatorsAndATrueMinus) {
  EXPECT_EQ(fixed_text(0, 2), "0.00");
  EXPECT_EQ(fixed_text(-0.001, 2), "0.00");
  EXPECT_EQ(fixed_text(-1234567.891, 2), "−1,234,567.89");
  EXPECT_EQ(fixed_text(999.5, 0), "1,000");
  EXPECT_EQ(fixed_text(123, 0), "123");
}

TEST(NumberText, FixedHoldsEveryDigitOfAnExactNumber) {
  const auto fixed = [](const char* text, int decimals) {
    return fixed_text(parse_rational(text), decimals);
  };
  EXPECT_EQ(fixed("123456789012345678.25", 2), "123,456,789,012,345,678.25");
  EXPECT_EQ(fixed("-1e25", 1), "−10,000,000,000,000,000,000,000,000.0");
  EXPECT_EQ(fixed("0", 2), "0.00");
  EXPECT_EQ(fixed("-0.001", 2), "0.00");
  EXPECT_EQ(fixed("-0.006", 2), "−0.01");
  EXPECT_EQ(fixed("0.125", 2), "0.12") << "a tie, as of a double";
  EXPECT_EQ(fixed("0.375", 2), "0.38");
  EXPECT_EQ(fixed("999.6", 0), "1,000");
  EXPECT_EQ(fixed("2/3", 4), "0.6667");
}

TEST(NumberText, RoundedStaysShort) {
  EXPECT_EQ(rounded_text(-1.978), "−1.98");
  EXPECT_EQ(rounded_text(99999.99), "99,999.99");
  EXPECT_EQ(rounded_text(-1e19), "−1.00×10¹⁹");
  EXPECT_EQ(rounded_text(1.2345e200), "1.23×10²⁰⁰");
}

TEST(NumberText, ShortIsExactWhereItCanBe) {
  EXPECT_EQ(short_text(1), "1");
  EXPECT_EQ(short_text(10000), "10,000");
  EXPECT_EQ(short_text(-16), "−16");
  EXPECT_EQ(short_text(Rational(5, 2)), "2.5");
  EXPECT_EQ(short_text(Rational(1, 3)), "1/3");
  EXPECT_EQ(short_text(Rational(-1, 3)), "−1/3");
  EXPECT_EQ(short_text(power(100, 19)), "10³⁸");
  EXPECT_EQ(short_text(1 / power(10, 6)), "10⁻⁶");
  EXPECT_EQ(short_text(Rational(123456789)), "1.23×10⁸");
  EXPECT_EQ(short_text(Rational(1234567, 1000001)), "1.23");
  EXPECT_EQ(short_text(Rational(9999999999)), "1.00×10¹⁰");
  EXPECT_EQ(short_text(Rational(9994999999)), "9.99×10⁹");
  EXPECT_EQ(short_text(power(100, 99999)), "10¹⁹⁹⁹⁹⁸");
}

TEST(NumberText, MagnitudeHoldsAnySize) {
  for (const long exponent : {-4000L, -1L, 0L, 1L, 400L, 200'000L}) {
    const Rational ten = exponent < 0 ? 1 / power(10, static_cast<unsigned long>(-exponent))
                                      : power(10, static_cast<unsigned long>(exponent));
    const Magnitude size = magnitude_of(ten * Rational(25, 10));
    EXPECT_EQ(size.exponent, exponent);
    EXPECT_DOUBLE_EQ(size.mantissa, 2.5);
  }
  EXPECT_EQ(magnitude_of(0).mantissa, 0);
}

TEST(Ticks, AreRoundAndFarEnoughApart) {
  const Ticks ticks = ticks_of(-1, 12, 0.7);
  EXPECT_EQ(ticks.step, 1);
  ASSERT_EQ(ticks.values.size(), 14U);
  EXPECT_EQ(ticks.values.front(), -1);
  EXPECT_EQ(ticks.values.back(), 12);
  EXPECT_EQ(ticks_of(0, 1, 0.11).step, 0.2);
  EXPECT_EQ(ticks_of(0, 10, 2.1).step, 5);
  EXPECT_EQ(tick_text(0.5, 0.5), "0.5");
  EXPECT_EQ(tick_text(5, 5), "5");
  EXPECT_EQ(tick_text(0.05, 0.05), "0.05");
}

TEST(Ticks, AreFewWhateverIsAsked) {
  EXPECT_LE(ticks_of(0, 1e300, 1e-300).values.size(), 1001U);
  EXPECT_LE(ticks_of(0, 1e-300, 0).values.size(), 1001U);
  EXPECT_TRUE(ticks_of(0, 0, 0).values.empty());
}

}  // namespace
}  // namespace piblocks
