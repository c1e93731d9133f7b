#include <fmt/format.h>
#include <piblocks/restitution.hpp>
#include <piblocks/run.hpp>

#include <algorithm>
#include <string>

#include "cli/command.hpp"
#include "cli/options.hpp"
#include "cli/text_output.hpp"
#include "cli/values.hpp"

namespace piblocks::cli {
namespace {

/// Significant digits of what is lost.
constexpr int kLossDigits = 12;

/// A number of [0, 1] to so many places, cut off.
std::string decimals(const Rational& value, int places) {
  const Integer scaled = floor(value * power(10, static_cast<unsigned long>(places)));
  std::string digits = scaled.get_str();
  const auto length = static_cast<std::size_t>(places) + 1;
  if (digits.size() < length) digits.insert(0, length - digits.size(), '0');
  return digits.insert(1, ".");
}

/// How many places after the point the first digit of a number of ]0, 1] is that is not 0.
int place_of_first_digit(const Rational& value) {
  const auto length = [](const Integer& number) {
    return static_cast<int>(mpz_sizeinbase(number.get_mpz_t(), 10));  // perhaps one too many
  };
  int places = std::max(0, length(value.get_den()) - length(value.get_num()) - 1);
  while (value * power(10, static_cast<unsigned long>(places)) < 1) ++places;
  return places;
}

/// As "{:g}" writes it, also if no double is so small.
std::string loss_text(const Rational& loss) {
  const int places = place_of_first_digit(loss);
  constexpr int kMostDecimalPlaces = 4;
  if (places <= kMostDecimalPlaces) return fmt::format("{:.{}g}", to_double(loss), kLossDigits);
  const double mantissa = to_double(loss * power(10, static_cast<unsigned long>(places)));
  const std::string digits = fmt::format("{:.{}g}", mantissa, kLossDigits);
  if (digits == "10") return fmt::format("1e-{:02}", places - 1);
  return fmt::format("{}e-{:02}", digits, places);
}

void print_need(int digits, int base, TextOutput& out) {
  const LeastRestitution need = least_restitution(digits, base);
  const Rational loss = 1 - need.above;
  const std::string below = need.count_below.get_str(base);
  const std::string above = need.count_above.get_str(base);
  out.format_line("Elastic blocks collide {} times.", above);
  if (loss == 0) {
    out.line("Only restitution 1 gives this count: any loss adds a collision.");
    out.format_line("Exact counts prove it: {} collisions with 1 - 2^-64, {} with 1.", below,
                    above);
  } else {
    out.format_line("The count stays the same with restitution {}... or more, of blocks and wall,",
                    decimals(need.above, place_of_first_digit(loss) + kLossDigits - 1));
    out.format_line("which is 1 - {}.", loss_text(loss));
    out.format_line(
        "Exact counts on both sides of this value prove it: {} collisions below, {} from it on.",
        below, above);
    out.line("The two sides differ by 2^-64 of 1 - restitution.");
  }
  out.line("Blocks that lose energy stay closer together, so they meet more often, not less.");
}

}  // namespace

void add_need(Command& app) {
  Command command =
      app.add_command("need", "Print how elastic real blocks must be to count digits of pi");
  command.add_required_value("--digits", "D", "Of the article's scene with D digits, 1 to 1000");
  command.add_value("--base", "B", "In this base, 2 to 36 (default 10)");
  command.set_footer(
      "Examples:\n"
      "  piblocks need --digits 3\n"
      "  piblocks need --digits 15");
  command.on_run([command] {
    constexpr int kMostDigits = 1000;
    const auto parse_digits = [](const std::string& text) {
      return parse_int(text, 1, kMostDigits);
    };
    const auto parse_base = [](const std::string& text) {
      return parse_int(text, kMinBase, kMaxBase);
    };
    TextOutput out("-");
    print_need(*command.value("--digits", parse_digits),
               command.value("--base", parse_base).value_or(kUsualBase), out);
    out.finish();
  });
}

}  // namespace piblocks::cli
