#include "draw/scene_log.hpp"

#include <utility>

namespace piblocks {
namespace {

BodyMotion body_motion(const Motion& block) { return {{block.position, 0}, {block.velocity, 0}}; }

Motion block_motion(const BodyMotion& body) { return {body.position[0], body.velocity[0]}; }

BodySystem body_system(const BlockSystem& blocks) {
  const auto body = [](const Block& block) {
    return Body{block.mass, {block.position}, {block.velocity}, block.width};
  };
  return {1, {body(blocks.blue), body(blocks.red)}, {{"wall", {blocks.wall_face}, {1, 0}}}};
}

}  // namespace

Bodies bodies_of(const Scene& scene) {
  if (scene.bodies) return *scene.bodies;
  return {body_system(scene.system), {{}, {}}};
}

BodiesState bodies_state(BlockState state) {
  return {std::move(state.count), {body_motion(state.blue), body_motion(state.red)}};
}

BlockState blocks_state(const BodiesState& state) {
  return {state.count, block_motion(state.bodies[0]), block_motion(state.bodies[1])};
}

SceneLog::SceneLog(const CollisionLog& log)
    : timeline_(&log),
      blocks_(&log),
      system_(std::make_shared<const BodySystem>(body_system(log.system()))) {}

// It shares what the log has, and owns nothing.
SceneLog::SceneLog(const BodyLog& log)
    : timeline_(&log), bodies_(&log), system_(std::shared_ptr<const BodySystem>(), &log.system()) {}

BodiesState SceneLog::state_at(const Rational& time) const {
  return bodies_ != nullptr ? bodies_->state_at(time) : bodies_state(blocks_->state_at(time));
}

BodyCollision SceneLog::collision(const Integer& index) const {
  if (bodies_ != nullptr) return bodies_->collision(index);
  Collision found = blocks_->collision(index);
  const bool is_wall = found.kind == CollisionKind::wall;
  const BodyMotion wall{{to_double(blocks_->system().wall_face), 0}, {}};
  return {.index = std::move(found.index),
          .time = found.time,
          .first = 0,
          .second = is_wall ? 2U : 1U,
          .first_after = body_motion(found.blue),
          .second_after = is_wall ? wall : body_motion(found.red)};
}

std::vector<std::vector<PathPoint>> SceneLog::paths(const Rational& from, const Rational& to,
                                                    std::size_t most) const {
  if (bodies_ == nullptr) return {};
  return bodies_->paths(from, to, most);
}

std::optional<double> SceneLog::certain_until() const {
  return bodies_ != nullptr ? bodies_->certain_until() : std::nullopt;
}

std::optional<Exposure> SceneLog::exposure_of_blocks(const Rational& from,
                                                     const Rational& to) const {
  if (blocks_ == nullptr) return std::nullopt;
  return expose(*blocks_, from, to);
}

std::optional<BodyExposure> SceneLog::exposure_of_bodies(const Rational& from,
                                                         const Rational& to) const {
  if (bodies_ == nullptr) return std::nullopt;
  return expose(*bodies_, from, to);
}

}  // namespace piblocks
