#include "draw/panels/unfolded_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "draw/number_text.hpp"
#include "draw/panels/trajectory.hpp"
#include "scene/counted_pi.hpp"

namespace piblocks {
namespace {

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

PhasedTitle::Sentences unfolded_sentences(const DrawingContext& context, bool unfolds) {
  const FormulaSetter set = context.setter();
  const Integer count = crossings_of(context);
  const std::string number = count == 0 ? "no" : count_text(count, context.scene.show.base);
  const std::string brief_number = count < 1000000 ? number : short_text(Rational(count));
  const char* const mirrors = count == 1 ? " mirror" : " mirrors";
  std::vector<Formula> path = {set.text("Each hit is a mirror: the path is straight"),
                               set.text("A straight path")};
  if (unfolds) {
    path.insert(path.begin(), set.text("Unfold a mirror at each hit: the path stays straight"));
  }
  std::vector<Formula> crossed;
  for (const std::string& some : {number, brief_number}) {
    crossed.push_back(set.text("A straight path crosses " + some + mirrors));
  }
  crossed.push_back(set.text("A straight path"));
  const std::optional<Formula> ratio = half_turn_ratio(context);
  if (!ratio) return {path, path, crossed};
  const Formula angles =
      set.text(number + " equal angles ") + set.italic("θ") + set.text(" fit into half a turn");
  return {path,
          path,
          {angles + set.text(", which is π: ") + *ratio, angles + set.text(": ") + *ratio, angles,
           *ratio, set.text("A straight path")}};
}

std::optional<Formula> half_turn_ratio(const DrawingContext& context) {
  std::string text = half_turn_text(context.two_blocks().blocks());
  if (text.empty()) return std::nullopt;
  if (context.scene.show.base != kUsualBase) text = "π/θ";
  const FormulaSetter set = context.setter();
  constexpr std::string_view kAngle = "θ";
  const std::size_t angle = text.find(kAngle);
  return set.text(text.substr(0, angle)) + set.italic(kAngle) +
         set.text(text.substr(angle + kAngle.size()));
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
