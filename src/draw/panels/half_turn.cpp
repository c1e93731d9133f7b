#include "draw/panels/half_turn.hpp"

#include <cmath>
#include <numbers>

#include "draw/number_text.hpp"
#include "draw/panels/trajectory.hpp"

namespace piblocks {
namespace {

/// Quotients from here on are not written with digits.
constexpr double kMostWritten = 1e6;
/// θ is 1/root to three digits from this root on.
constexpr long kLeastRoot = 10;

/// "31.4…": the first decimal is cut off.
std::string cut_text(double value) { return fixed_text(std::floor(10 * value) / 10, 1) + "…"; }

/// No rational number but these is the squared tangent of a rational part of pi (Niven, "Irrational
/// Numbers").
bool divides_pi(const Rational& ratio) {
  return ratio == 1 || ratio == 3 || ratio == Rational(1, 3);
}

}  // namespace

std::optional<Integer> whole_root(const TwoBlocks& system) {
  const Rational ratio = system.red.mass / system.blue.mass;
  const Integer root = sqrt(Integer(ratio.get_num()));
  if (Rational(root * root) != ratio) return std::nullopt;
  return root;
}

bool fits_half_turn(const TwoBlocks& system) {
  return system.blue.velocity == 0 && system.red.velocity < 0 && system.blue_gap() > 0 &&
         !divides_pi(system.red.mass / system.blue.mass);
}

Formula half_turn_ratio(const DrawingContext& context) {
  const FormulaSetter set = context.setter();
  const TwoBlocks& system = context.two_blocks().blocks();
  const Formula ratio = set.text("π / ") + set.italic("θ");
  if (context.scene.show.base != kUsualBase) return ratio;
  if (const auto root = whole_root(system); root && *root >= kLeastRoot) {
    const Formula approximate = ratio + set.text(" ≈ " + short_text(Rational(*root)) + " π");
    const double quotient = std::numbers::pi * root->get_d();
    if (quotient >= kMostWritten) return approximate;
    return approximate + set.text(" = " + cut_text(quotient));
  }
  const double quotient = std::numbers::pi / GapWedge(system).theta;
  if (!(quotient < kMostWritten)) return ratio;
  return ratio + set.text(" = " + cut_text(quotient));
}

}  // namespace piblocks
