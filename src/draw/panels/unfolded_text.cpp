#include "draw/panels/unfolded_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "draw/number_text.hpp"
#include "draw/panels/trajectory.hpp"

namespace piblocks {
namespace {

/// Ratios m2/m1 other than these have an angle of which pi is no whole multiple, because no other
/// rational number is the squared tangent of a rational part of pi (Niven, "Irrational Numbers").
bool divides_pi(const Rational& ratio) {
  return ratio == 1 || ratio == 3 || ratio == Rational(1, 3);
}

/// Collisions from the beginning of the scene on.
Integer crossings_of(const DrawingContext& context) {
  const Integer before =
      context.two_blocks().blocks_at(span_of(context.scene, context.log).from).count;
  return context.log.last() - (before < 0 ? before : Integer(0));
}

/// The wedge angle in radians: as a unit fraction where that is good to three digits.
std::string angle_text(const TwoBlocks& system) {
  const GapWedge wedge(system);
  const Rational ratio = system.red.mass / system.blue.mass;
  const Integer root = sqrt(Integer(ratio.get_num()));
  const bool is_unit_fraction = ratio >= 100 && Rational(root * root) == ratio;
  if (is_unit_fraction) {
    const std::string digits = root.get_str();
    const auto zeros = static_cast<long>(digits.size()) - 1;
    const bool is_power = digits.front() == '1' && digits.find_first_not_of('0', 1) > digits.size();
    if (is_power && zeros > 2) return power_text(-zeros);
    if (zeros <= 4) return "1/" + short_text(Rational(root));
  }
  const Magnitude theta = written_with(2, wedge.theta_magnitude());
  if (theta.exponent >= -4) {
    return fixed_text(wedge.theta, static_cast<int>(std::max(2L, 2 - theta.exponent)));
  }
  return fmt::format("{}×{}", fixed_text(theta.mantissa, 2), power_text(theta.exponent));
}

}  // namespace

std::vector<Formula> unfolded_titles(const DrawingContext& context) {
  const FormulaSetter set = context.setter();
  const TwoBlocks& system = context.two_blocks().blocks();
  const Integer count = crossings_of(context);
  const std::string number = count == 0 ? "no" : count_text(count, context.scene.show.base);
  const std::string brief_number = count < 1000000 ? number : short_text(Rational(count));
  const char* const mirrors = count == 1 ? " mirror" : " mirrors";
  const bool is_whole_part = system.blue.velocity == 0 && system.red.velocity < 0 &&
                             system.blue_gap() > 0 &&
                             !divides_pi(system.red.mass / system.blue.mass);
  std::vector<Formula> titles;
  if (is_whole_part) {
    const Formula ratio = set.symbol("⌊") + set.text("π/") + set.italic("θ") + set.symbol("⌋");
    titles.push_back(set.text("Each hit is a mirror: the line crosses ") + ratio +
                     set.text(" = " + number + " of them"));
    titles.push_back(set.text("Each hit is a mirror: the line crosses ") + ratio +
                     set.text(" = " + number));
    titles.push_back(set.text("A straight line crosses ") + ratio +
                     set.text(" = " + number + mirrors));
  }
  titles.push_back(set.text("A straight line crosses " + number + mirrors));
  titles.push_back(set.text("A straight line crosses " + brief_number + mirrors));
  titles.push_back(set.text("The line crosses " + brief_number + mirrors));
  titles.push_back(set.text("A straight line"));
  return titles;
}

std::vector<Formula> mirrors_titles(const DrawingContext& context) {
  const FormulaSetter set = context.setter();
  return {set.text("Mirrors unfold one by one; the path stays straight"),
          set.text("Mirrors unfold one by one"), set.text("Mirrors unfold")};
}

Formula angle_note(const DrawingContext& context) {
  const FormulaSetter set = context.setter();
  const auto mass = [&](const char* index, const Color& color) {
    return set.lowered(set.italic("m"), set.text(index)).colored(color);
  };
  const Palette& palette = context.palette;
  return set.italic("θ") + set.text(" = arctan ") +
         set.root(mass("1", palette.blue.label) + set.text("/") + mass("2", palette.red.label)) +
         set.text(" ≈ " + angle_text(context.two_blocks().blocks()));
}

std::optional<Formula> thinning_note(const FormulaSetter& set, const std::vector<Mirror>& mirrors) {
  if (mirrors.empty()) return std::nullopt;
  const Integer all = mirrors.back().index - mirrors.front().index + 1;
  const Integer share = all / Integer(static_cast<unsigned long>(mirrors.size()));
  if (share <= 1) return std::nullopt;
  const auto exponent = static_cast<long>(share.get_str().size()) - 1;
  if (exponent == 0) return set.text("not all mirrors are drawn");
  constexpr long kMostZeros = 4;
  const std::string power =
      exponent > kMostZeros ? power_text(exponent) : short_text(power_of_ten(exponent));
  return set.text("1 in " + power + " mirrors drawn");
}

}  // namespace piblocks
