// `piblocks min-restitution`: how elastic blocks must be to count the digits of pi.
#include <fmt/format.h>
#include <piblocks/exact.hpp>

#include <cmath>

#include "cli/cli_fixture.hpp"

namespace piblocks {
namespace {

class MinRestitutionCli : public CliFixture {};

/// The word behind `before` in a line, without a comma, a full stop or the like behind it.
std::string word_behind(const std::string& line, const std::string& before) {
  const std::size_t at = line.find(before);
  if (at == std::string::npos) return "no '" + before + "' in '" + line + "'";
  std::string word = line.substr(at + before.size());
  word.resize(std::min(word.find(' '), word.size()));
  if (word.ends_with('.') || word.ends_with(',')) word.pop_back();
  return word;
}

/// What is printed can be given to `count`: the one restitution is enough, the other is not.
TEST_F(MinRestitutionCli, PrintsDecimalsThatCountTakes) {
  for (const auto& [digits, base, count, more] : {std::tuple{"1", "10", "3", "4"},
                                                  {"2", "10", "31", "32"},
                                                  {"3", "10", "314", "315"},
                                                  {"4", "10", "3141", "3142"},
                                                  {"3", "2", "1100", "1101"},
                                                  {"2", "7", "31", "32"}}) {
    SCOPED_TRACE(std::string(digits) + " digits in base " + base);
    const Arguments scene{"--digits", digits, "--base", base};
    const auto said = lines(output_of(Arguments{"min-restitution"} + scene));
    ASSERT_GE(said.size(), 4U);
    EXPECT_EQ(word_behind(said[0], "Elastic blocks collide "), count);
    const std::string proof = said[said.size() - 2];
    const std::string too_little = word_behind(proof, std::string(more) + " collisions with ");
    const std::string enough = word_behind(proof, " " + std::string(count) + " with ");
    const auto count_with = [&](const std::string& restitution) {
      return output_of(Arguments{"count"} + scene + Arguments{"--restitution", restitution});
    };
    EXPECT_EQ(count_with(enough), std::string(count) + "\n");
    EXPECT_EQ(count_with(too_little), std::string(more) + "\n");
    // They differ by a unit of the last place.
    const Rational unit = 1 / power(10, static_cast<unsigned long>(too_little.size()) - 2);
    EXPECT_EQ(parse_rational(enough) - parse_rational(too_little), unit);
    if (enough == "1") continue;
    EXPECT_EQ(word_behind(said[1], "with restitution "), enough);
    EXPECT_EQ(parse_rational(word_behind(said[2], "which is 1 - ")), 1 - parse_rational(enough));
    EXPECT_EQ(said[0].ends_with("(counts in base " + std::string(base) + ")."),
              base != std::string("10"));
  }
  EXPECT_EQ(lines(output_of({"min-restitution", "--digits", "1"}))[1],
            "Only restitution 1 gives this count: any loss adds a collision.");
}

/// From 217 digits on the loss is smaller than any double.
TEST_F(MinRestitutionCli, TellsLossesThatNoDoubleHolds) {
  const auto count_of = [&](int digits) {
    return lines(output_of({"count", "--digits", std::to_string(digits)})).front();
  };
  for (const int digits : {215, 216, 217, 300, 1000}) {
    SCOPED_TRACE(digits);
    const auto said = lines(output_of({"min-restitution", "--digits", std::to_string(digits)}));
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
    const std::string places = word_behind(said[1], "with restitution 0.");
    const Rational cut = Rational(Integer(places, 10)) / power(10, places.size());
    EXPECT_NEAR(to_double((1 - cut) * power(10, static_cast<unsigned long>(exponent))), mantissa,
                1e-10 * mantissa);
  }
}

}  // namespace
}  // namespace piblocks
