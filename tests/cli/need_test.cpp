// `piblocks need`: how elastic blocks must be to count the digits of pi.
#include <fmt/format.h>
#include <piblocks/exact.hpp>

#include <cmath>

#include "cli/cli_fixture.hpp"

namespace piblocks {
namespace {

class NeedCli : public CliFixture {};

/// The least restitution lies between numbers that differ in the last printed digit.
TEST_F(NeedCli, IsWhatCountNeeds) {
  const auto count_with = [&](int digits, const Rational& restitution) {
    write("lossy.toml", fmt::format("digits = {}\n[blocks]\nrestitution = '{}'\n[wall]\n"
                                    "restitution = '{}'\n",
                                    digits, restitution.get_str(), restitution.get_str()));
    return lines(output_of({"count", "lossy.toml"})).front();
  };
  const auto one = lines(output_of({"need", "--digits", "1"}));
  ASSERT_GE(one.size(), 3U);
  EXPECT_EQ(one[0], "Elastic blocks collide 3 times.");
  EXPECT_EQ(one[1], "Only restitution 1 gives this count: any loss adds a collision.");
  EXPECT_EQ(one[2], "Exact counts prove it: 4 collisions with 1 - 2^-64, 3 with 1.");
  EXPECT_EQ(count_with(1, 1), "3");
  EXPECT_EQ(count_with(1, parse_rational("999999999999999999/1000000000000000000")), "4");
  const std::vector<std::string> counts = {"31", "314", "3141"};
  for (int digits = 2; digits <= 4; ++digits) {
    const std::string& count = counts.at(static_cast<std::size_t>(digits - 2));
    const auto said = lines(output_of({"need", "--digits", std::to_string(digits)}));
    ASSERT_GE(said.size(), 4U);
    EXPECT_EQ(said[0], "Elastic blocks collide " + count + " times.");
    const std::string begin = "The count stays the same with restitution ";
    ASSERT_TRUE(said[1].starts_with(begin)) << said[1];
    const std::string number = said[1].substr(begin.size(), said[1].find("...") - begin.size());
    const Rational step = 1 / power(10, static_cast<unsigned long>(number.size()) - 2);
    const Rational cut = parse_rational(number);
    EXPECT_EQ(count_with(digits, cut + step), count) << number;
    EXPECT_EQ(count_with(digits, cut - step), std::to_string(std::stoi(count) + 1)) << number;
    ASSERT_TRUE(said[2].starts_with("which is 1 - ")) << said[2];
    ASSERT_TRUE(said[2].ends_with("."));
    const Rational loss = parse_rational(said[2].substr(13, said[2].size() - 14));
    EXPECT_LE(abs(Rational(1 - cut - loss)), step) << said[2];
    EXPECT_NE(said[3].find(
                  fmt::format("{} collisions below, {} from it on.", std::stoi(count) + 1, count)),
              std::string::npos)
        << said[3];
  }
}

/// From 217 digits on the loss is smaller than any double.
TEST_F(NeedCli, TellsLossesThatNoDoubleHolds) {
  const auto count_of = [&](int digits) {
    return lines(output_of({"count", "--digits", std::to_string(digits)})).front();
  };
  for (const int digits : {215, 216, 217, 300, 1000}) {
    SCOPED_TRACE(digits);
    const auto said = lines(output_of({"need", "--digits", std::to_string(digits)}));
    ASSERT_GE(said.size(), 4U);
    const std::string count = count_of(digits);
    EXPECT_EQ(said[0], "Elastic blocks collide " + count + " times.");
    // 1 - 2 sqrt(2 (1 - f)/pi) M^(-3/2), with f the part of pi M after the point: the digits of pi
    // that follow those of the count begin the count of 40 digits more.
    const std::string more = count_of(digits + 40);
    const double after = std::stod("0." + more.substr(static_cast<std::size_t>(digits)));
    const int root = digits % 2 == 0 ? 1 : 0;  // 10^(-3/2 (digits - 1)) is not a power of ten
    const int exponent = (3 * (digits - 1) + root) / 2;
    const double mantissa = 2 * std::sqrt(2 * (1 - after) / M_PI) * (root != 0 ? std::sqrt(10) : 1);
    ASSERT_TRUE(said[2].starts_with("which is 1 - ")) << said[2];
    const std::string loss = said[2].substr(13, said[2].size() - 14);
    const Rational scaled = parse_rational(loss) * power(10, static_cast<unsigned long>(exponent));
    EXPECT_NEAR(to_double(scaled), mantissa, 1e-11 * mantissa) << loss;
    const std::size_t point = said[1].find("0.") + 2;
    const std::string places = said[1].substr(point, said[1].find("...") - point);
    const Rational cut = Rational(Integer(places, 10)) / power(10, places.size());
    EXPECT_NEAR(to_double((1 - cut) * power(10, static_cast<unsigned long>(exponent))), mantissa,
                1e-10 * mantissa);
  }
}

}  // namespace
}  // namespace piblocks
