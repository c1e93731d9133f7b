#include <piblocks/restitution.hpp>
#include <piblocks/run.hpp>

#include <cmath>
#include <string>

#include "cli/command.hpp"
#include "cli/options.hpp"
#include "cli/text_output.hpp"
#include "cli/values.hpp"
#include "core/rounded.hpp"

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

void print_need(int digits, int base, TextOutput& out) {
  const LeastRestitution need = least_restitution(digits, base);
  const Rational loss = 1 - need.above;
  out.format_line("{} collisions", need.count_above.get_str(base));
  if (loss == 0) {
    out.line("need a restitution of 1: with any loss at all there are more");
  } else {
    const double loss_rounded = to_double(loss);
    const int zeros = static_cast<int>(-std::floor(rounded::log10(loss_rounded)));
    out.format_line("need a restitution of {}... or more, of blocks and wall alike",
                    decimals(need.above, zeros + kLossDigits - 1));
    out.format_line("which is 1 - {:.{}g}", loss_rounded, kLossDigits);
  }
  out.format_line(
      "Certain, by exact counting at both ends of an interval in which 1 - restitution differs by "
      "2^-64 of itself: {} collisions with less, {} with more.",
      need.count_below.get_str(base), need.count_above.get_str(base));
  out.line(
      "Why: loss makes the blocks meet more often, not less. Each collision leaves them closer, so "
      "that a last one comes that elastic blocks would just miss.");
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
