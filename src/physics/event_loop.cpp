#include "physics/event_loop.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/event_simulator.hpp>

#include <utility>

#include "core/two_sum.hpp"
#include "physics/blocks.hpp"
#include "physics/exact_motion.hpp"
#include "physics/velocity_loop.hpp"

namespace piblocks {
namespace {

using Simulator = EventSimulator<double, 1>;

// In this order a corner hit begins with the blocks: see EventSimulator.
constexpr std::size_t kBlue = 0;
constexpr std::size_t kRed = 1;

Simulator::Body body_of(const Block& block) {
  Simulator::Body body;
  body.mass = to_double(block.mass);
  body.radius = to_double(block.width / 2);
  body.position[0] = to_double(block.position);
  body.velocity[0] = to_double(block.velocity);
  return body;
}

/// The article's wall: an immovable body of radius 1/2 whose far side is the face.
Simulator::Body wall_of(const BlockSystem& system) {
  Simulator::Body body;
  body.mass = kInfiniteMass<double>;
  body.radius = 0.5;
  body.position[0] = to_double(system.wall_face - Rational(1, 2));
  return body;
}

Motion motion_of(const Simulator::Body& body) { return {body.position[0], body.velocity[0]}; }

/// Whether the first collision happens exactly at time 0.
bool is_contact_at_start(const ExactMotion& motion) {
  return !motion.through_corner() &&
         (motion.blocks_first ? motion.y1 == motion.y2 : motion.y1 == 0);
}

/// Records collisions, and stops an engine that finds many more than there are.
class Recorder {
 public:
  Recorder(const char* engine, const ExactMotion& motion)
      : engine_(engine),
        starts_in_contact_(is_contact_at_start(motion)),
        collisions_(motion.total()),
        limit_(2 * collisions_.get_ui() + 100) {}

  void record(StoredCollision collision) {
    if (log_.size() == limit_) {
      throw SimulationError(fmt::format(
          "{}: more than {} collisions in double precision; the exact count is {}; use the "
          "closed form (--engine unfolded)",
          engine_, limit_, collisions_.get_str()));
    }
    require_finite(collision.time, collision.blue, collision.red, engine_);
    // Rounding must not carry a collision past time 0, nor away from it.
    if (collision.time.hi < 0 || (starts_in_contact_ && log_.empty())) collision.time = {};
    log_.push_back(collision);
  }
  std::vector<StoredCollision> take() { return std::move(log_); }

 private:
  const char* engine_;
  bool starts_in_contact_;
  Integer collisions_;
  std::size_t limit_;
  std::vector<StoredCollision> log_;
};

/// A power of two that makes the speed about 1: its square is then no danger.
Rational unit_of_time(const ExactMotion& motion) {
  const long exponent = sqrt(Real(64, motion.speed_squared)).exponent();
  return exponent > 0 ? Rational(1 / power(2, static_cast<unsigned long>(exponent)))
                      : power(2, static_cast<unsigned long>(-exponent));
}

}  // namespace

std::vector<StoredCollision> event_loop(const BlockSystem& system) {
  Simulator simulator({body_of(system.blue), body_of(system.red), wall_of(system)});
  Recorder recorder("event loop", ExactMotion(system));
  while (const auto event = simulator.step()) {
    const bool blocks = event->second == kRed;
    recorder.record({{event->time, 0},
                     blocks ? CollisionKind::blocks : CollisionKind::wall,
                     motion_of(simulator.particles()[kBlue]),
                     motion_of(simulator.particles()[kRed])});
  }
  return recorder.take();
}

std::vector<StoredCollision> velocity_loop(const BlockSystem& system) {
  if (ExactMotion(system).at_rest()) return {};
  const Rational unit = unit_of_time(ExactMotion(system));
  BlockSystem scaled = system;
  scaled.blue.velocity *= unit;
  scaled.red.velocity *= unit;
  const ExactMotion motion(scaled);
  VelocityLoop<double> loop(motion, to_double);
  const double unit_s = to_double(unit);
  const Time turn = to_time(motion.closest_approach);
  const double blue_offset = to_double(system.wall_face + system.blue.width / 2);
  const double red_offset = to_double(system.wall_face + system.blue.width + system.red.width / 2);
  Recorder recorder("velocity loop", motion);
  while (loop.step()) {
    Time time = two_sum(turn.hi, loop.tau());
    time = two_sum(time.hi, time.lo + turn.lo);
    recorder.record({{time.hi * unit_s, time.lo * unit_s},
                     loop.met_blocks() ? CollisionKind::blocks : CollisionKind::wall,
                     {blue_offset + loop.y1(), loop.u1() / unit_s},
                     {red_offset + loop.y2(), loop.u2() / unit_s}});
  }
  return recorder.take();
}

}  // namespace piblocks
