#include <algorithm>
#include <utility>

#include "physics/blocks.hpp"
#include "physics/body_logs.hpp"
#include "physics/exact_line.hpp"

namespace piblocks {
namespace {

/// Which bodies the two blocks and the wall are.
struct Parts {
  LineElement wall;
  LineElement blue;  ///< next to the wall
  LineElement red;
  int sign = 1;  ///< -1 if the wall is on the right
};

std::optional<Parts> parts_of(const BodySystem& system) {
  if (system.dimensions != 1) return std::nullopt;
  const std::vector<LineElement> elements = elements_of(system);
  if (elements.size() != 3 || !elements[1].mass) return std::nullopt;
  const bool is_left = !elements[0].mass && elements[2].mass;
  const bool is_right = !elements[2].mass && elements[0].mass;
  if (is_left) return Parts{elements[0], elements[1], elements[2], 1};
  if (is_right) return Parts{elements[2], elements[1], elements[0], -1};
  return std::nullopt;
}

Block block_of(const LineElement& element, int sign) {
  return {*element.mass, sign * element.position, sign * element.velocity, 2 * element.half_width};
}

class ClosedBodyLog final : public BodyLog {
 public:
  ClosedBodyLog(const BodySystem& system, Parts parts)
      : BodyLog(system), parts_(std::move(parts)), start_(motions_at_start(system)) {
    BlockSystem blocks;
    blocks.wall_face = parts_.sign * parts_.wall.position + parts_.wall.half_width;
    blocks.blue = block_of(parts_.blue, parts_.sign);
    blocks.red = block_of(parts_.red, parts_.sign);
    blocks_ = make_collision_log(blocks);
    set_range(1, blocks_->size());
  }

  BodyCollision collision(const Integer& index) const override {
    const Collision found = blocks_->collision(index);
    const bool is_at_wall = found.kind == CollisionKind::wall;
    const LineElement& other = is_at_wall ? parts_.wall : parts_.red;
    const BodyMotion blue = motion_of(found.blue);
    const BodyMotion second =
        is_at_wall ? BodyMotion{{to_double(parts_.wall.position), 0}, {}} : motion_of(found.red);
    BodyCollision collision{.index = index, .time = found.time};
    const bool is_blue_first = parts_.blue.id < other.id;
    collision.first = is_blue_first ? parts_.blue.id : other.id;
    collision.second = is_blue_first ? other.id : parts_.blue.id;
    collision.first_after = is_blue_first ? blue : second;
    collision.second_after = is_blue_first ? second : blue;
    return collision;
  }

  BodiesState state_at(const Rational& time) const override {
    require_not_negative(time);
    const BlockState now = blocks_->state_at(time);
    BodiesState state{now.count, start_};
    state.bodies[parts_.blue.id] = motion_of(now.blue);
    state.bodies[parts_.red.id] = motion_of(now.red);
    return state;
  }

  std::vector<std::vector<PathPoint>> paths(const Rational& from, const Rational& to,
                                            std::size_t most) const override {
    require_not_negative(from);
    const Integer first = count_at(from) + 1;
    const Integer last = count_at(to);
    std::vector<std::vector<PathPoint>> paths(start_.size());
    const auto add = [&](double after, const BodiesState& state) {
      for (const std::size_t body : {parts_.blue.id, parts_.red.id}) {
        paths[body].push_back({after, state.bodies[body].position});
      }
    };
    const double length = to_double(to - from);
    if (last - first >= Integer(most)) {
      for (const double share : sample_times(most)) {
        const Rational after = (to - from) * Rational(share);
        add(to_double(after), state_at(from + after));
      }
    } else {
      add(0, state_at(from));
      for (Integer index = first; index <= last; ++index) add_collision(index, from, paths);
      add(length, state_at(to));
    }
    for (std::size_t body = 0; body < paths.size(); ++body) {
      if (body == parts_.blue.id || body == parts_.red.id) continue;
      paths[body] = {{0, start_[body].position}, {length, start_[body].position}};
    }
    return paths;
  }

  Integer count_at(const Rational& time) const override {
    return time < 0 ? Integer(0) : blocks_->count_at(time);
  }
  Rational time_after(const Integer& index) const override { return blocks_->time_after(index); }
  std::optional<Rational> turn() const override { return blocks_->turn(); }
  ClosedBlocks closed_blocks() const {
    return {*blocks_, parts_.blue.id, parts_.red.id, parts_.sign};
  }
  Integer exact_size() const override { return is_exact(*blocks_) ? size() : Integer(0); }
  std::optional<Integer> first_tie() const override {
    return corner_of(blocks_->system()) ? std::optional(Integer(1)) : std::nullopt;
  }
  std::optional<double> certain_until() const override { return std::nullopt; }

 private:
  /// Adds where the blocks are that meet.
  void add_collision(const Integer& index, const Rational& from,
                     std::vector<std::vector<PathPoint>>& paths) const {
    const BodyCollision found = collision(index);
    const double after = to_double(to_rational(found.time) - from);
    for (const std::size_t body : {parts_.blue.id, parts_.red.id}) {
      if (found.first == body) paths[body].push_back({after, found.first_after.position});
      if (found.second == body) paths[body].push_back({after, found.second_after.position});
    }
  }
  BodyMotion motion_of(const Motion& motion) const {
    return {{parts_.sign * motion.position, 0}, {parts_.sign * motion.velocity, 0}};
  }

  Parts parts_;
  std::vector<BodyMotion> start_;
  std::unique_ptr<CollisionLog> blocks_;
};

}  // namespace

std::unique_ptr<BodyLog> make_closed_body_log(const BodySystem& system) {
  std::optional<Parts> parts = parts_of(system);
  if (!parts) return nullptr;
  return std::make_unique<ClosedBodyLog>(system, std::move(*parts));
}

std::optional<ClosedBlocks> closed_blocks(const BodyLog& log) {
  const auto* const closed = dynamic_cast<const ClosedBodyLog*>(&log);
  if (closed == nullptr) return std::nullopt;
  return closed->closed_blocks();
}

}  // namespace piblocks
