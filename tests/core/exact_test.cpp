#include <gtest/gtest.h>
#include <piblocks/error.hpp>
#include <piblocks/exact.hpp>

#include <cmath>
#include <limits>
#include <string>

#include "core/two_sum.hpp"

namespace piblocks {
namespace {

TEST(ParseRational, ReadsEveryForm) {
  EXPECT_EQ(parse_rational("42"), 42);
  EXPECT_EQ(parse_rational(" -7 "), -7);
  EXPECT_EQ(parse_rational("1.\r\n"), 1);
  EXPECT_EQ(parse_rational("+.5"), Rational(1, 2));
  EXPECT_EQ(parse_rational("2.50e-1"), Rational(1, 4));
  EXPECT_EQ(parse_rational("1/3"), Rational(1, 3));
  EXPECT_EQ(parse_rational("2/6"), Rational(1, 3));
  EXPECT_EQ(parse_rational("100^2"), 10000);
  EXPECT_EQ(parse_rational("2^-3"), Rational(1, 8));
  EXPECT_EQ(parse_rational("100^3/7^2"), Rational(1000000, 49));
  EXPECT_EQ(parse_rational("0^0"), 1);
}

TEST(ParseRational, IsExactWhereADoubleIsNot) {
  EXPECT_EQ(parse_rational("100^16").get_str(), "1" + std::string(32, '0'));
  EXPECT_EQ(parse_rational("0.1") * 10, 1);
}

TEST(ParseRational, RefusesWhatIsNoNumber) {
  for (const char* text : {"",    " ",   "x",     "1x",  "1/",    "/2",  "1/0",   "1//2",
                           "^2",  "2^",  "2^0.5", "--1", "1e",    "1e+", ".",     "0^-1",
                           "nan", "inf", "0x10",  "1 2", "1/2/3", "1,5", "1_000", "\u0663"}) {
    EXPECT_THROW(parse_rational(text), UsageError) << text;
  }
}

TEST(ParseRational, RefusesToEatMemory) {
  for (const char* text : {"10^999999999", "1e999999999", "1e-999999999", "9^9999999999999999999",
                           "1e1000000^4000000", "0.9^1000000", "1/3^1000000"}) {
    EXPECT_THROW(parse_rational(text), UsageError) << text;
    EXPECT_THROW(parse_rational(text, kMaxMassBits), UsageError) << text;
  }
  EXPECT_EQ(parse_rational("1^16384"), 1);
}

TEST(ParseRational, LimitsNumeratorAndDenominatorHoweverTheyAreWritten) {
  const std::string digits(4931, '9');
  EXPECT_EQ(parse_rational(digits).get_num().get_str(), digits);
  EXPECT_EQ(parse_rational("2^16383"), power(2, 16383));
  EXPECT_EQ(parse_rational("1/2^16383"), 1 / power(2, 16383));
  EXPECT_NO_THROW(parse_rational("0.9^4932"));
  EXPECT_EQ(parse_rational("0." + digits.substr(0, 4900)), 1 - 1 / power(10, 4900));
  for (const std::string& text :
       {digits + "99", "0." + digits + "9", digits + ".99e-2", std::string("2^16384"),
        std::string("2^-16384"), std::string("1/2^16384"), std::string("0.9^4933"),
        std::string("0.9^4000/0.71^4000"), std::string("1e4933"), std::string("1e4000/1e-4000")}) {
    EXPECT_THROW(parse_rational(text), UsageError) << text;
  }
}

TEST(ParseRational, TakesTheMassesOfAHundredThousandDigitsInAnyBase) {
  for (const char* text : {"4^99999", "100^99999", "10^199998", "36^199998", "1/36^199998"}) {
    EXPECT_NO_THROW(parse_rational(text, kMaxMassBits)) << text;
  }
}

TEST(RationalFromDecimal, MeansTheShortestDecimal) {
  EXPECT_EQ(rational_from_decimal(0.1), Rational(1, 10));
  EXPECT_EQ(rational_from_decimal(-2.5), Rational(-5, 2));
  EXPECT_EQ(rational_from_decimal(1e22), parse_rational("1e22"));
  EXPECT_EQ(rational_from_decimal(5e-324), parse_rational("5e-324"));
  EXPECT_THROW(rational_from_decimal(std::nan("")), UsageError);
  EXPECT_THROW(rational_from_decimal(std::numeric_limits<double>::infinity()), UsageError);
}

TEST(ToDouble, IsNearest) {
  EXPECT_EQ(to_double(Rational(1, 3)), 1.0 / 3.0);
  EXPECT_EQ(to_double(parse_rational("0.1")), 0.1);
  EXPECT_EQ(to_double(parse_rational("5e-324")), 5e-324);
  EXPECT_EQ(to_double(parse_rational("1e-400")), 0.0);
  EXPECT_EQ(to_double(parse_rational("-1e400")), -std::numeric_limits<double>::infinity());
}

TEST(Rounding, GoesTheRightWayOnBothSidesOfZero) {
  EXPECT_EQ(ceil(Rational(7, 2)), 4);
  EXPECT_EQ(ceil(Rational(-7, 2)), -3);
  EXPECT_EQ(floor(Rational(-7, 2)), -4);
  EXPECT_EQ(floor(Rational(6)), 6);
}

TEST(ThousandsSeparators, GroupFromTheRight) {
  EXPECT_EQ(with_thousands_separators(0), "0");
  EXPECT_EQ(with_thousands_separators(314), "314");
  EXPECT_EQ(with_thousands_separators(3141), "3,141");
  EXPECT_EQ(with_thousands_separators(-314159), "-314,159");
  EXPECT_EQ(with_thousands_separators(Integer("31415926535897932384")),
            "31,415,926,535,897,932,384");
}

TEST(Readable, ShortensWhatFillsTheLine) {
  EXPECT_EQ(readable(31415926), "31,415,926");
  EXPECT_EQ(readable(Integer("1" + std::string(29, '0'))),
            "100,000,000,000,000,000,000,000,000,000");
  EXPECT_EQ(readable(Integer("7" + std::string(400, '0'))), "about 10^400");
  EXPECT_EQ(readable(-Integer("7" + std::string(400, '0'))), "about -10^400");
}

TEST(Time, HoldsMoreThanADouble) {
  const Rational exact = Rational(1) / 3;
  const Time time = to_time(exact);
  EXPECT_EQ(time.hi, 1.0 / 3.0);
  EXPECT_NE(time.lo, 0.0);
  EXPECT_LT(abs(to_rational(time) - exact), parse_rational("1e-32"));
}

TEST(Time, IsExactForDoubles) {
  EXPECT_EQ(to_time(Rational(0.1)), (Time{0.1, 0}));
  EXPECT_EQ(to_rational({0.1, 0}), Rational(0.1));
}

TEST(Time, RefusesWhatIsNotFinite) {
  EXPECT_THROW(to_rational({std::numeric_limits<double>::infinity(), 0}), SimulationError);
}

TEST(TwoSum, LosesNothing) {
  const Time sum = two_sum(1e16, 1.25);
  EXPECT_EQ(Rational(sum.hi) + Rational(sum.lo), Rational(1e16) + Rational(1.25));
  const Time swapped = two_sum(1.25, 1e16);
  EXPECT_EQ(sum, swapped);
}

}  // namespace
}  // namespace piblocks
