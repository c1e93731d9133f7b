#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/two_blocks.hpp>

#include "core/real.hpp"
#include "physics/exact_motion.hpp"

namespace piblocks {
namespace {

constexpr int kMaxRelativeBits = 4096;

Integer count_with(const Rational& restitution, TwoBlocks system) {
  system.blocks_restitution = restitution;
  system.wall_restitution = restitution;
  return count_collisions(system);
}

/// 1 - e of the least restitution e: README.md, "How much loss pi can take".
/// @param ratio  m_blue / m_red
/// @param count  of the elastic run
Real greatest_loss(const Rational& ratio, const Integer& count, mpfr_prec_t bits) {
  const Real theta = atan(sqrt(Real(bits, ratio)));
  const Real last = Real::pi(bits) / Real(bits, Rational(count + 1));
  const Real share = sqrt(sin(theta - last) * sin(theta + last)) / cos(last);
  return scaled(share, 1) / (Real(bits, 1) + share);
}

}  // namespace

LeastRestitution least_restitution(int digits, int base, int relative_bits) {
  const TwoBlocks system = article_blocks(digits, base);
  if (relative_bits < 1 || relative_bits > kMaxRelativeBits) {
    throw UsageError(
        fmt::format("restitution: {} bits of its difference from 1; must be from 1 to {}",
                    relative_bits, kMaxRelativeBits));
  }
  const Integer count = count_collisions(system);
  const Rational hair = 1 / power(2, static_cast<unsigned long>(relative_bits));
  // pi/theta is a whole number: with any loss blue comes back once more.
  if (system.red.mass == system.blue.mass) {
    return {1 - hair, 1, count_with(1 - hair, system), count};
  }
  const Rational ratio = system.blue.mass / system.red.mass;
  const auto size = mpfr_prec_t(mpz_sizeinbase(count.get_mpz_t(), 2));
  for (mpfr_prec_t bits = 4 * size + relative_bits + 64; bits <= kMaxDecisionBits; bits *= 2) {
    const Real loss = greatest_loss(ratio, count, bits);
    if (loss.sign() <= 0) continue;
    const Rational unit = hair * scaled(Real(64, 1), loss.exponent() - 1).to_rational();
    const Rational least_loss = Rational(floor(loss.to_rational() / unit)) * unit;
    const Rational above = 1 - least_loss;
    const Rational below = above - unit;
    const Integer count_above = count_with(above, system);
    const Integer count_below = count_with(below, system);
    if (count_above == count && count_below > count) return {below, above, count_below, count};
  }
  throw SimulationError(
      fmt::format("restitution: {} bits do not tell which is enough", kMaxDecisionBits));
}

}  // namespace piblocks
