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

std::optional<Rational> turn_of(const BlockSystem& system) {
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

BlockSystem article_system(int digits, int base) {
  BlockSystem system;
  system.red.mass = mass_ratio_of(digits, base);
  return system;
}

namespace {

/// From left to right: wall, blue, red.
void check_places(const BlockSystem& system, SceneProblems& problems) {
  const auto& [wall_face, blue, red, blocks_restitution, wall_restitution] = system;
  const Rational least_blue = wall_face + blue.width / 2;
  if (blue.position + blue.width / 2 <= wall_face) {
    problems.add("blue.position",
                 "= {}: blue is left of the wall's face at {}; must be at least {}", blue.position,
                 wall_face, least_blue);
  } else if (blue.position < least_blue) {
    problems.add("blue.position",
                 "= {}: blue reaches {} into the wall, whose face is at {}; must be at least {}",
                 blue.position, Rational(-system.blue_gap()), wall_face, least_blue);
  }
  const Rational reach = (blue.width + red.width) / 2;
  const Rational least_red = blue.position + reach;
  if (red.position <= blue.position - reach) {
    problems.add("red.position", "= {}: red is left of blue; must be at least {}", red.position,
                 least_red);
  } else if (red.position < least_red) {
    problems.add("red.position", "= {}: red overlaps blue by {}; must be at least {}", red.position,
                 Rational(-system.blocks_gap()), least_red);
  }
}

}  // namespace

std::vector<Problem> problems_of(const BlockSystem& system) {
  const auto& [wall_face, blue, red, blocks_restitution, wall_restitution] = system;
  SceneProblems problems;
  problems.require_positive("blue.mass", blue.mass);
  problems.require_positive("red.mass", red.mass);
  problems.require_positive("blue.width", blue.width);
  problems.require_positive("red.width", red.width);
  problems.require_finite("wall.face", wall_face);
  problems.require_finite("blue.position", blue.position);
  problems.require_finite("red.position", red.position);
  problems.require_finite("blue.velocity", blue.velocity);
  problems.require_finite("red.velocity", red.velocity);
  problems.require_finite("blue.width", blue.width);
  problems.require_finite("red.width", red.width);
  for (const auto& [key, value] : {std::pair("blocks.restitution", blocks_restitution),
                                   std::pair("wall.restitution", wall_restitution)}) {
    problems.require(value >= 0 && value <= 1, key,
                     "= {}: must be from 0 (no rebound) to 1 (elastic)", value);
  }
  if (!problems.empty()) return problems.take();  // the gaps would only repeat them

  check_places(system, problems);
  return problems.take();
}

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

std::unique_ptr<CollisionLog> make_collision_log(const TwoBlocks& blocks, Engine engine) {
  const BlockSystem& system = blocks.blocks;
  require_valid(problems_of(system));
  if (engine == Engine::events) return make_stored_log(blocks);
  if (!is_elastic(system)) return std::make_unique<InelasticLog>(blocks);
  // At theta >= pi/4 the closed form has nothing to skip, and would lose a very light red block
  // in the rounding of its phase.
  const bool is_at_rest = system.blue.velocity == 0 && system.red.velocity == 0;
  if (system.red.mass <= system.blue.mass || is_at_rest) return make_exact_log(blocks);
  return std::make_unique<UnfoldedLog>(blocks);
}

std::unique_ptr<CollisionLog> make_collision_log(const BlockSystem& system, Engine engine) {
  return make_collision_log(two_blocks_of(system), engine);
}

Integer count_collisions(const BlockSystem& system) {
  require_valid(problems_of(system));
  if (is_elastic(system)) return ExactMotion(system).total();
  const InelasticMotion motion(system);
  if (motion.total) return *motion.total;
  throw UsageError(endless_message(motion));
}

std::optional<Collapse> collapse_of(const BlockSystem& system) {
  require_valid(problems_of(system));
  if (is_elastic(system)) return std::nullopt;
  const InelasticMotion motion(system);
  if (motion.total) return std::nullopt;
  const auto end = motion.collapse_time(kCollapseBits);
  return Collapse{end ? std::optional(end->to_double_double()) : std::nullopt, motion.listed};
}

std::optional<Corner> corner_of(const BlockSystem& system) {
  require_valid(problems_of(system));
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
