#include <piblocks/run.hpp>

#include <algorithm>
#include <utility>

#include "physics/body_logs.hpp"
#include "physics/exact_line.hpp"
#include "physics/exact_motion.hpp"

namespace piblocks {
namespace {

Block block_of(const LineElement& element, int side) {
  return {*element.mass, side * element.position, side * element.velocity, 2 * element.half_width};
}

TwoBlocks two_blocks_from(const BodySystem& system, const LineElement& wall,
                          const LineElement& blue, const LineElement& red, int side) {
  return {.wall_face = side * wall.position + wall.half_width,
          .blue = block_of(blue, side),
          .red = block_of(red, side),
          .blocks_restitution = system.restitution,
          .wall_restitution = system.wall_restitution,
          .blue_id = blue.id,
          .red_id = red.id,
          .wall_id = wall.id,
          .side = side};
}

}  // namespace

std::optional<TwoBlocks> two_blocks_of(const BodySystem& system) {
  if (system.dimensions != 1 || system.bodies.size() > 3) return std::nullopt;
  const std::vector<LineElement> elements = elements_of(system);
  if (elements.size() != 3 || !elements[1].mass) return std::nullopt;
  const LineElement& left = elements[0];
  const LineElement& middle = elements[1];
  const LineElement& right = elements[2];
  if (!left.mass && right.mass) return two_blocks_from(system, left, middle, right, 1);
  if (!right.mass && left.mass) return two_blocks_from(system, right, middle, left, -1);
  return std::nullopt;
}

BodySystem system_of(const TwoBlocks& blocks) {
  const auto body_of = [](const Block& block, const char* name) {
    return Body{block.mass, {block.position}, {block.velocity}, block.width, name};
  };
  return {1,
          {body_of(blocks.blue, "blue"), body_of(blocks.red, "red")},
          {{"wall", {blocks.wall_face}, {1}}},
          blocks.blocks_restitution,
          blocks.wall_restitution};
}

bool has_short_names(const BodySystem& system) {
  const auto& [dimensions, bodies, walls, restitution, wall_restitution] = system;
  return bodies.size() == 2 && walls.size() == 1 && bodies[0].name == "blue" &&
         bodies[1].name == "red" && walls[0].name == "wall";
}

BodyCollision CollisionLog::collision(const Integer& index) const {
  const Collision found = blocks_collision(index);
  const bool is_at_wall = found.kind == CollisionKind::wall;
  const std::uint32_t blue = blocks_.blue_id;
  const std::uint32_t other = is_at_wall ? blocks_.wall_id : blocks_.red_id;
  BodyCollision collision{
      index,
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

BodiesState CollisionLog::state_at(const Rational& time) const {
  const BlockState now = blocks_at(time);
  BodiesState state{now.count, motions_at_start(system())};
  state.bodies[blocks_.blue_id] = body_motion_of(now.blue);
  state.bodies[blocks_.red_id] = body_motion_of(now.red);
  return state;
}

Integer CollisionLog::first_since(const Rational& time) const {
  const Integer last = count_at(time);
  if (last < first_index()) return first_index();
  // Collisions happen together only in the corner, and there all of them do.
  const ExactMotion motion(blocks());
  if (motion.through_corner() && motion.closest_approach == time) return first_index();
  return collision_time(last) == to_time(time) ? last : Integer(last + 1);
}

std::vector<std::vector<PathPoint>> CollisionLog::paths(const Rational& from, const Rational& to,
                                                        std::size_t most) const {
  const std::size_t blue = blocks_.blue_id;
  const std::size_t red = blocks_.red_id;
  std::vector<std::vector<PathPoint>> paths(system().bodies.size());
  const auto add = [&](double after, const Rational& time) {
    const BodiesState state = state_at(time);
    for (const std::size_t body : {blue, red}) {
      paths[body].push_back({after, state.bodies[body].position});
    }
  };
  const auto add_collision = [&](const Integer& index) {
    const BodyCollision found = collision(index);
    const double after = to_double(to_rational(found.time) - from);
    for (const std::size_t body : {blue, red}) {
      if (found.first == body) paths[body].push_back({after, found.first_after.position});
      if (found.second == body) paths[body].push_back({after, found.second_after.position});
    }
  };
  const Integer first = count_at(from) + 1;
  const Integer last = count_at(to);
  if (last - first >= Integer(most)) {
    for (const double share : sample_times(most)) {
      const Rational after = (to - from) * Rational(share);
      add(to_double(after), from + after);
    }
  } else {
    add(0, from);
    for (Integer index = first; index <= last; ++index) add_collision(index);
    add(to_double(to - from), to);
  }
  for (std::size_t body = 0; body < paths.size(); ++body) {
    if (body == blue || body == red) continue;
    const auto position = motion_at_start(system(), body).position;
    paths[body] = {{0, position}, {to_double(to - from), position}};
  }
  return paths;
}

std::optional<Integer> CollisionLog::first_tie(const Integer& last) const {
  return last >= 1 && corner_of(blocks()) ? std::optional(Integer(1)) : std::nullopt;
}

std::optional<PositionBounds> CollisionLog::bounds_at(const Rational& /*time*/) const {
  return std::nullopt;
}

namespace {

/// Rounding may have carried a stepping engine past a contact.
Gaps gaps_between(const TwoBlocks& system, const Motion& blue, const Motion& red) {
  const Rational blue_width = system.blue.width;
  const double y1 = blue.position - to_double(system.wall_face + blue_width / 2);
  const double y2 = red.position - to_double(system.wall_face + blue_width + system.red.width / 2);
  return {std::max(0.0, y1), std::max({0.0, y1, y2})};
}

/// Asks the log for one collision after the other.
class IndexedStream final : public CollisionStream {
 public:
  IndexedStream(const CollisionLog& log, Integer first, Integer last)
      : log_(log), next_(std::move(first)), last_(std::move(last)) {}

  bool read(CollisionBatch& batch) override {
    batch.first = next_;
    for (batch.size = 0; batch.size < CollisionBatch::kCapacity && next_ <= last_; ++batch.size) {
      const Collision c = log_.blocks_collision(next_);
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
  const CollisionLog& log_;
  Integer next_;
  Integer last_;
};

}  // namespace

Gaps CollisionLog::gaps_at(const Rational& time) const {
  const BlockState now = blocks_at(time);
  return gaps_between(blocks(), now.blue, now.red);
}

Gaps CollisionLog::gaps_at_collision(const Integer& index) const {
  const Collision now = blocks_collision(index);
  const Gaps gaps = gaps_between(blocks(), now.blue, now.red);
  return now.kind == CollisionKind::wall ? Gaps{0, gaps.y2} : Gaps{gaps.y2, gaps.y2};
}

std::unique_ptr<CollisionStream> CollisionLog::stream(const Integer& first,
                                                      const Integer& last) const {
  return std::make_unique<IndexedStream>(*this, first, last);
}

}  // namespace piblocks
