#include <piblocks/error.hpp>
#include <piblocks/two_blocks.hpp>

#include <algorithm>
#include <vector>

#include "physics/exact_line.hpp"
#include "physics/exact_motion.hpp"
#include "physics/inelastic_motion.hpp"
#include "physics/logs.hpp"
#include "physics/problems.hpp"

namespace piblocks {
namespace {

Block block_of(const LineElement& element, int side) {
  return {*element.mass, side * element.position, side * element.velocity, 2 * element.half_width};
}

TwoBlocks two_blocks_from(const System& system, const LineElement& wall, const LineElement& blue,
                          const LineElement& red, int side) {
  return {.wall_face = side * wall.position + wall.half_width,
          .blue = block_of(blue, side),
          .red = block_of(red, side),
          .blocks_restitution = restitution_of(system, blue.id, red.id),
          .wall_restitution = restitution_of(system, blue.id, wall.id),
          .blue_id = blue.id,
          .red_id = red.id,
          .wall_id = wall.id,
          .side = side};
}

/// Precision of a time before it is rounded to two doubles.
constexpr mpfr_prec_t kCollapseBits = 160;

}  // namespace

std::optional<TwoBlocks> two_blocks_of(const System& system) {
  if (system.dimensions != 1 || system.bodies.size() > 3) return std::nullopt;
  const std::vector<LineElement> elements = elements_of(system);
  if (elements.size() != 3 || !elements[1].mass) return std::nullopt;
  const LineElement& left = elements[0];
  const LineElement& middle = elements[1];
  const LineElement& right = elements[2];
  if (is_driven(system) || are_at_once(system)) return std::nullopt;
  if (!left.mass && right.mass) return two_blocks_from(system, left, middle, right, 1);
  if (!right.mass && left.mass) return two_blocks_from(system, right, middle, left, -1);
  return std::nullopt;
}

System system_of(const TwoBlocks& blocks) {
  const auto body_of = [](const Block& block, const char* name) {
    return Body{block.mass, {block.position}, {block.velocity}, block.width, name};
  };
  return {1,
          {body_of(blocks.blue, "blue"), body_of(blocks.red, "red")},
          {{"wall", {blocks.wall_face}, {1}}},
          blocks.blocks_restitution,
          blocks.wall_restitution};
}

TwoBlocks article_blocks(int digits, int base) {
  TwoBlocks system;
  system.red.mass = mass_ratio_of(digits, base);
  return system;
}

std::optional<Rational> turn_of(const TwoBlocks& system) {
  if (!is_elastic(system)) return InelasticMotion(system).turn();
  const ExactMotion motion(system);
  return motion.at_rest() ? std::nullopt : std::optional(motion.closest_approach);
}

Integer count_collisions(const TwoBlocks& system) {
  require_valid(problems_of(system_of(system)));
  if (is_elastic(system)) return ExactMotion(system).total();
  if (const auto collapse = collapse_of(system)) refuse_count(system_of(system), *collapse);
  return *InelasticMotion(system).total;
}

std::optional<Collapse> collapse_of(const TwoBlocks& system) {
  require_valid(problems_of(system_of(system)));
  if (is_elastic(system)) return std::nullopt;
  const InelasticMotion motion(system);
  if (motion.total) return std::nullopt;
  const auto end = motion.collapse_time(kCollapseBits);
  Collapse collapse{end ? std::optional(end->to_double_double()) : std::nullopt,
                    motion.listed,
                    {system.blue_id, system.red_id, system.wall_id}};
  std::ranges::sort(collapse.bodies);
  return collapse;
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
