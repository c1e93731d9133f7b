#include <piblocks/error.hpp>
#include <piblocks/run.hpp>

#include <algorithm>
#include <cmath>

#include "physics/blocks.hpp"
#include "physics/exact_motion.hpp"
#include "physics/inelastic_log.hpp"
#include "physics/unfolded_log.hpp"

namespace piblocks {
namespace {

/// Precision of a time before it is rounded to two doubles.
constexpr mpfr_prec_t kCollapseBits = 160;

std::string endless_message(const InelasticMotion& motion) {
  const auto end = motion.collapse_time(kCollapseBits);
  return end ? fmt::format(
                   "count: there are infinitely many collisions until the blocks come to "
                   "rest at t = {}; count those until an earlier time, as --to {:.4g}",
                   end->to_double(), end->to_double() * 0.999)
             : std::string(
                   "count: there are infinitely many collisions, which never end; count those "
                   "until a time, as --to 10");
}

}  // namespace

std::optional<Rational> turn_of(const TwoBlocks& system) {
  if (!is_elastic(system)) return InelasticMotion(system).turn();
  const ExactMotion motion(system);
  return motion.at_rest() ? std::nullopt : std::optional(motion.closest_approach);
}

std::optional<Rational> turn_of(const Log& log) {
  return log.pair() ? turn_of(log.pair()->blocks()) : std::nullopt;
}

Rational mass_ratio_of(int digits, int base) {
  if (digits < 1 || digits > kMaxDigits) {
    throw UsageError(fmt::format("digits = {}: must be from 1 to {}", digits, kMaxDigits));
  }
  if (base < kMinBase || base > kMaxBase) {
    throw UsageError(fmt::format("base = {}: must be from {} to {}", base, kMinBase, kMaxBase));
  }
  return power(base * base, static_cast<unsigned long>(digits - 1));
}

TwoBlocks article_blocks(int digits, int base) {
  TwoBlocks system;
  system.red.mass = mass_ratio_of(digits, base);
  return system;
}

BodySystem article_system(int digits, int base) { return system_of(article_blocks(digits, base)); }

void require_valid(const std::vector<Problem>& problems) {
  if (problems.empty()) return;
  std::vector<std::string> lines;
  lines.reserve(problems.size());
  for (const auto& [key, reason] : problems) lines.push_back(fmt::format("{} {}", key, reason));
  throw SceneError(std::move(lines));
}

void require_finite(const Time& time, const Motion& blue, const Motion& red, const char* engine) {
  for (const double number : {time.hi, blue.position, blue.velocity, red.position, red.velocity}) {
    if (std::isfinite(number)) continue;
    throw SimulationError(
        fmt::format("{}: a time, position or velocity is beyond the range of a double (about "
                    "1.8e308)",
                    engine));
  }
}

TiedCollision::TiedCollision(const Integer& index, Integer last)
    : UsageError(fmt::format(
          "collision #{}: happens at the same time as all up to #{}; name the last of them",
          index.get_str(), last.get_str())),
      last_(std::move(last)) {}

void require_last(const Integer& index, const Integer& last_at_its_time) {
  if (index != last_at_its_time) throw TiedCollision(index, last_at_its_time);
}

std::unique_ptr<CollisionLog> make_valid_collision_log(const BodySystem& system, Engine engine) {
  if (engine == Engine::events) return make_stored_log(system);
  if (!is_elastic(system)) return std::make_unique<InelasticLog>(system);
  // At theta >= pi/4 the closed form has nothing to skip, and would lose a very light red block
  // in the rounding of its phase.
  const TwoBlocks blocks = two_blocks_of(system).value();
  const bool is_at_rest = blocks.blue.velocity == 0 && blocks.red.velocity == 0;
  if (blocks.red.mass <= blocks.blue.mass || is_at_rest) return make_exact_log(system);
  return std::make_unique<UnfoldedLog>(system);
}

std::unique_ptr<CollisionLog> make_collision_log(const BodySystem& system, Engine engine) {
  require_valid(problems_of(system));
  if (two_blocks_of(system)) return make_valid_collision_log(system, engine);
  throw UsageError("log: needs two blocks beside one wall or fixed block, and no more");
}

std::unique_ptr<CollisionLog> make_collision_log(const TwoBlocks& system, Engine engine) {
  return make_collision_log(system_of(system), engine);
}

Integer count_collisions(const BodySystem& system, const std::optional<Rational>& horizon) {
  const std::optional<TwoBlocks> blocks = two_blocks_of(system);
  return blocks ? count_collisions(*blocks) : make_log(system, horizon)->last();
}

Integer count_collisions(const TwoBlocks& system) {
  require_valid(problems_of(system_of(system)));
  if (is_elastic(system)) return ExactMotion(system).total();
  const InelasticMotion motion(system);
  if (motion.total) return *motion.total;
  throw UsageError(endless_message(motion));
}

std::optional<Collapse> collapse_of(const TwoBlocks& system) {
  require_valid(problems_of(system_of(system)));
  if (is_elastic(system)) return std::nullopt;
  const InelasticMotion motion(system);
  if (motion.total) return std::nullopt;
  const auto end = motion.collapse_time(kCollapseBits);
  return Collapse{end ? std::optional(end->to_double_double()) : std::nullopt, motion.listed};
}

std::optional<Corner> corner_of(const TwoBlocks& system) {
  require_valid(problems_of(system_of(system)));
  if (!is_elastic(system)) return InelasticMotion(system).corner();
  ExactMotion motion(system);
  // The line comes into the corner between the rays of wall and blocks; otherwise, starting in it,
  // only one of the two can be first.
  const bool comes_in = motion.u2 < 0 && motion.u1 <= 0 && motion.u2 <= motion.u1;
  if (motion.at_rest() || !motion.through_corner() || !comes_in || motion.closest_approach < 0) {
    return std::nullopt;
  }
  Corner corner{motion.closest_approach, motion.blocks_first, motion.total(), 0};
  motion.blocks_first = !motion.blocks_first;
  corner.other_count = motion.total();
  return corner;
}

}  // namespace piblocks
