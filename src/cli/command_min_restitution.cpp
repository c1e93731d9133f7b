#include <fmt/format.h>
#include <piblocks/two_blocks.hpp>

#include <string>

#include "cli/command.hpp"
#include "cli/options.hpp"
#include "cli/text_output.hpp"
#include "cli/values.hpp"
#include "draw/number_text.hpp"

namespace piblocks::cli {
namespace {

/// Significant digits of what is lost.
constexpr int kLossDigits = 12;

/// As "{:g}" writes it, also if no double is so small.
std::string loss_text(const Rational& loss) {
  const auto [mantissa, exponent] = written_with(kLossDigits - 1, magnitude_of(loss));
  constexpr long kLeastPlainExponent = -4;
  if (exponent >= kLeastPlainExponent) return fmt::format("{:.{}g}", to_double(loss), kLossDigits);
  return fmt::format("{:.{}g}e-{:02}", mantissa, kLossDigits, -exponent);
}

Integer count_with(const Rational& restitution, int digits, int base) {
  System system = article_system(digits, base);
  system.restitution = system.wall_restitution = restitution;
  return count_collisions(system);
}

/// Decimal places that tell a restitution that is enough from one that is not.
int places_of(const LeastRestitution& need) {
  constexpr int kPlaces = 20;  // where any loss is too much
  const Rational loss = 1 - need.above;
  return loss == 0 ? kPlaces : static_cast<int>(kLossDigits - 1 - magnitude_of(loss).exponent);
}

void print_min_restitution(int digits, int base, TextOutput& out) {
  const LeastRestitution need = least_restitution(digits, base);
  const int places = places_of(need);
  const Rational unit = power_of_ten(-places);
  // Rounded up: the decimal itself is enough, and the one before it is not.
  const Rational enough = 1 - floor(Rational((1 - need.above) / unit)) * unit;
  const Rational too_little = enough - unit;
  const auto text = [&](const Rational& restitution) {
    return restitution == 1 ? "1" : fixed_text(restitution, places);
  };
  const auto count = [&](const Rational& restitution) {
    return count_with(restitution, digits, base).get_str(base);
  };
  const std::string in_base = base == kUsualBase ? "" : fmt::format(" (counts in base {})", base);
  out.format_line("Elastic blocks collide {} times{}.", need.count_above.get_str(base), in_base);
  if (enough == 1) {
    out.line("Only restitution 1 gives this count: any loss adds a collision.");
  } else {
    out.format_line("They collide as often with restitution {} or more, of blocks and wall,",
                    text(enough));
    out.format_line("which is 1 - {}.", loss_text(1 - enough));
  }
  out.format_line("Exact counts prove it: {} collisions with {}, {} with {}.", count(too_little),
                  text(too_little), count(enough), text(enough));
  out.line("Blocks that lose energy stay closer together, so they meet more often, not less.");
}

}  // namespace

void define_min_restitution(Command& command) {
  command.add_required_value("--digits", "D", "Of the article's scene with D digits, 1 to 1000");
  command.add_value("--base", "B", "In this base, 2 to 36 (default 10)");
  command.set_footer(
      "Examples:\n"
      "  piblocks min-restitution --digits 3\n"
      "  piblocks min-restitution --digits 15");
  command.on_run([command] {
    constexpr int kMostDigits = 1000;
    const auto parse_digits = [](const std::string& text) {
      return parse_int(text, 1, kMostDigits);
    };
    const auto parse_base = [](const std::string& text) {
      return parse_int(text, kMinBase, kMaxBase);
    };
    TextOutput out;
    print_min_restitution(*command.value("--digits", parse_digits),
                          command.value("--base", parse_base).value_or(kUsualBase), out);
    out.finish();
  });
}

}  // namespace piblocks::cli
