#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/two_blocks.hpp>

#include <algorithm>
#include <utility>
#include <vector>

#include "core/real.hpp"
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

Collision PairLog::collision(const Integer& index) const {
  const PairCollision found = blocks_collision(index);
  const bool is_at_wall = found.kind == CollisionKind::wall;
  const std::uint32_t blue = blocks_.blue_id;
  const std::uint32_t other = is_at_wall ? blocks_.wall_id : blocks_.red_id;
  Collision collision{index,
                      found.time,
                      blue,
                      other,
                      body_motion_of(found.blue),
                      is_at_wall ? motion_at_start(system(), other) : body_motion_of(found.red)};
  if (other < blue) {
    std::swap(collision.first, collision.second);
    std::swap(collision.first_after, collision.second_after);
  }
  return collision;
}

State PairLog::state_at(const Rational& time) const {
  const PairState now = blocks_at(time);
  State state{now.count, motions_at_start(system())};
  state.bodies[blocks_.blue_id] = body_motion_of(now.blue);
  state.bodies[blocks_.red_id] = body_motion_of(now.red);
  return state;
}

std::optional<std::vector<double>> PairLog::position_bounds(const Rational& time) const {
  const std::optional<PositionBounds> known = bounds_at(time);
  if (!known) return std::nullopt;
  std::vector<double> bounds(system().bodies.size(), 0);
  bounds[blocks_.blue_id] = known->blue;
  bounds[blocks_.red_id] = known->red;
  return bounds;
}

Integer PairLog::first_since(const Rational& time) const {
  const Integer last = count_at(time);
  if (last < first_index()) return first_index();
  // Collisions happen together only in the corner, and there all of them do.
  const ExactMotion motion(blocks());
  if (motion.through_corner() && motion.closest_approach == time) return first_index();
  return collision_time(last) == to_time(time) ? last : Integer(last + 1);
}

std::vector<std::vector<PathPoint>> PairLog::paths(const Rational& from, const Rational& to,
                                                   std::size_t most) const {
  const std::size_t blue = blocks_.blue_id;
  const std::size_t red = blocks_.red_id;
  std::vector<std::vector<PathPoint>> paths(system().bodies.size());
  const auto add = [&](std::size_t body, double after, const BlockMotion& motion) {
    paths[body].push_back({after, body_motion_of(motion).position});
  };
  const auto add_both = [&](double after, const Rational& time) {
    const PairState state = blocks_at(time);
    add(blue, after, state.blue);
    add(red, after, state.red);
  };
  const Integer first = count_at(from) + 1;
  const Integer last = count_at(to);
  if (last - first >= Integer(most)) {
    for (const double share : sample_times(most)) {
      const Rational after = (to - from) * Rational(share);
      add_both(to_double(after), from + after);
    }
  } else {
    add_both(0, from);
    for (Integer index = first; index <= last; ++index) {
      const PairCollision found = blocks_collision(index);
      const double after = to_double(to_rational(found.time) - from);
      add(blue, after, found.blue);
      if (found.kind == CollisionKind::blocks) add(red, after, found.red);
    }
    add_both(to_double(to - from), to);
  }
  for (std::size_t body = 0; body < paths.size(); ++body) {
    if (body == blue || body == red) continue;
    const auto position = motion_at_start(system(), body).position;
    paths[body] = {{0, position}, {to_double(to - from), position}};
  }
  return paths;
}

std::optional<Integer> PairLog::first_tie(const Integer& last) const {
  return last >= 1 && corner_of(blocks()) ? std::optional(Integer(1)) : std::nullopt;
}

std::optional<PositionBounds> PairLog::bounds_at(const Rational& /*time*/) const {
  return std::nullopt;
}

namespace {

/// Rounding may have carried a stepping engine past a contact.
Gaps gaps_between(const TwoBlocks& system, const BlockMotion& blue, const BlockMotion& red) {
  const Rational blue_width = system.blue.width;
  const double y1 = blue.position - to_double(system.wall_face + blue_width / 2);
  const double y2 = red.position - to_double(system.wall_face + blue_width + system.red.width / 2);
  return {std::max(0.0, y1), std::max({0.0, y1, y2})};
}

/// Asks the log for one collision after the other.
class IndexedStream final : public PairStream {
 public:
  IndexedStream(const PairLog& log, Integer first, Integer last)
      : log_(log), next_(std::move(first)), last_(std::move(last)) {}

  bool read(PairBatch& batch) override {
    batch.first = next_;
    for (batch.size = 0; batch.size < PairBatch::kCapacity && next_ <= last_; ++batch.size) {
      const PairCollision c = log_.blocks_collision(next_);
      batch.kind[batch.size] = c.kind;
      batch.time_hi[batch.size] = c.time.hi;
      batch.time_lo[batch.size] = c.time.lo;
      batch.blue_position[batch.size] = c.blue.position;
      batch.blue_velocity[batch.size] = c.blue.velocity;
      batch.red_position[batch.size] = c.red.position;
      batch.red_velocity[batch.size] = c.red.velocity;
      ++next_;
    }
    return batch.size > 0;
  }

 private:
  const PairLog& log_;
  Integer next_;
  Integer last_;
};

}  // namespace

Gaps PairLog::gaps_at(const Rational& time) const {
  const PairState now = blocks_at(time);
  return gaps_between(blocks(), now.blue, now.red);
}

Gaps PairLog::gaps_at_collision(const Integer& index) const {
  const PairCollision now = blocks_collision(index);
  const Gaps gaps = gaps_between(blocks(), now.blue, now.red);
  return now.kind == CollisionKind::wall ? Gaps{0, gaps.y2} : Gaps{gaps.y2, gaps.y2};
}

std::unique_ptr<PairStream> PairLog::stream(const Integer& first, const Integer& last) const {
  return std::make_unique<IndexedStream>(*this, first, last);
}

std::unique_ptr<PairLog> make_valid_pair_log(const System& system, Engine engine) {
  if (engine == Engine::events) return make_event_log(system);
  if (!is_elastic(system)) return make_inelastic_log(system);
  // At theta >= pi/4 the closed form has nothing to skip, and would lose a very light red block
  // in the rounding of its phase.
  const TwoBlocks blocks = two_blocks_of(system).value();
  const bool is_at_rest = blocks.blue.velocity == 0 && blocks.red.velocity == 0;
  if (blocks.red.mass <= blocks.blue.mass || is_at_rest) return make_exact_log(system);
  return make_unfolded_log(system);
}

std::unique_ptr<PairLog> make_pair_log(const System& system, Engine engine) {
  require_valid(problems_of(system));
  if (two_blocks_of(system)) return make_valid_pair_log(system, engine);
  throw UsageError("log: needs two blocks beside one wall or fixed block, and no more");
}

std::unique_ptr<PairLog> make_pair_log(const TwoBlocks& system, Engine engine) {
  return make_pair_log(system_of(system), engine);
}

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
