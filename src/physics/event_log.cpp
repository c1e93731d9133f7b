#include <fmt/format.h>
#include <gmp.h>
#include <mpfr.h>
#include <piblocks/error.hpp>
#include <piblocks/event_simulator.hpp>

#include <algorithm>
#include <utility>

#include "physics/block_motion.hpp"
#include "physics/exact_motion.hpp"
#include "physics/logs.hpp"

namespace piblocks {
namespace {

/// One collision as a loop meets it; velocities are those just after.
struct StoredCollision {
  Time time;
  CollisionKind kind = CollisionKind::blocks;
  BlockMotion blue;
  BlockMotion red;
};
using StoredCollisions = std::vector<StoredCollision>;

using Simulator = EventSimulator<double, 1>;
using Vector = Simulator::Body::Vector;

// In this order a corner hit begins with the blocks: see EventSimulator.
constexpr std::size_t kBlue = 0;
constexpr std::size_t kRed = 1;

Simulator::Body body_of(const Block& block) {
  return {.mass = to_double(block.mass),
          .radius = to_double(block.width / 2),
          .position = Vector(to_double(block.position)),
          .velocity = Vector(to_double(block.velocity))};
}

/// The article's wall: an immovable body of radius 1/2 whose far side is the face.
Simulator::Body wall_of(const TwoBlocks& system) {
  return {.mass = kInfiniteMass<double>,
          .radius = 0.5,
          .position = Vector(to_double(system.wall_face - Rational(1, 2)))};
}

BlockMotion motion_of(const Simulator::Body& body) { return {body.position[0], body.velocity[0]}; }

/// Records collisions, and stops an engine that finds many more than there are.
class Recorder {
 public:
  explicit Recorder(const ExactMotion& motion)
      : starts_in_contact_(!motion.through_corner() &&
                           (motion.blocks_first ? motion.y1 == motion.y2 : motion.y1 == 0)),
        collisions_(motion.total()),
        limit_(2 * collisions_.get_ui() + 100) {}

  void record(StoredCollision collision) {
    if (log_.size() == limit_) {
      throw SimulationError(fmt::format(
          "event loop: more than {} collisions in double precision; the exact count is {}; use the "
          "closed form (--engine unfolded)",
          limit_, collisions_.get_str()));
    }
    require_finite(collision.time, collision.blue, collision.red, "event loop");
    // Rounding must not carry a collision past time 0, nor away from it.
    if (collision.time.hi < 0 || (starts_in_contact_ && log_.empty())) collision.time = {};
    log_.push_back(collision);
  }
  StoredCollisions take() { return std::move(log_); }

 private:
  bool starts_in_contact_;  // the first collision happens exactly at time 0
  Integer collisions_;
  std::size_t limit_;
  StoredCollisions log_;
};

/// The article's event loop.
StoredCollisions event_loop(const TwoBlocks& system) {
  Simulator simulator({body_of(system.blue), body_of(system.red), wall_of(system)});
  Recorder recorder{ExactMotion(system)};
  while (const auto event = simulator.step()) {
    const bool blocks = event->second == kRed;
    recorder.record({{event->time, 0},
                     blocks ? CollisionKind::blocks : CollisionKind::wall,
                     motion_of(simulator.particles()[kBlue]),
                     motion_of(simulator.particles()[kRed])});
  }
  return recorder.take();
}

Time negated(const Time& time) { return {-time.hi, -time.lo}; }

/// Collisions before `time`, by binary search; with `or_at` also those at it.
std::size_t count(const StoredCollisions& collisions, const Time& time, bool or_at) {
  const auto is_counted = [&](const Time& t) {
    if (t == time) return or_at;
    return t.hi < time.hi || (t.hi == time.hi && t.lo < time.lo);
  };
  const auto next = std::ranges::partition_point(collisions, is_counted, &StoredCollision::time);
  return static_cast<std::size_t>(next - collisions.begin());
}

/// What a loop recorded, forwards and backwards from time 0.
class EventLog final : public PairLog {
 public:
  /// @param forward   collisions at times >= 0, in order.
  /// @param backward  collisions of the run with all velocities reversed, in its order and with
  ///                  its times and velocities.
  EventLog(const System& system, StoredCollisions forward, StoredCollisions backward)
      : PairLog(system), forward_(std::move(forward)), backward_(std::move(backward)) {
    set_range(1 - Integer(backward_.size()), forward_.size());
  }

  PairCollision blocks_collision(const Integer& index) const override {
    if (index > 0) {
      const StoredCollision& c = forward_[index.get_ui() - 1];
      return {index, c.time, c.kind, c.blue, c.red};
    }
    // The velocities just after this collision are the opposite of those just before it in the
    // reversed run.
    const std::size_t place = Integer(-index).get_ui();
    const StoredCollision& c = backward_[place];
    const BlockMotion blue =
        place == 0 ? motion_of(blocks().blue) : reversed(backward_[place - 1].blue);
    const BlockMotion red =
        place == 0 ? motion_of(blocks().red) : reversed(backward_[place - 1].red);
    return {index,
            negated(c.time),
            c.kind,
            {c.blue.position, blue.velocity},
            {c.red.position, red.velocity}};
  }

  PairState blocks_at(const Rational& time) const override {
    const Time now = to_time(time);
    PairState state{0, motion_of(blocks().blue), motion_of(blocks().red)};
    Time since;
    if (const std::size_t happened = count(forward_, now, true); happened > 0) {
      const StoredCollision& c = forward_[happened - 1];
      since = c.time;
      state = {Integer(happened), c.blue, c.red};
    } else if (const std::size_t to_come = count(backward_, negated(now), false); to_come > 0) {
      const StoredCollision& c = backward_[to_come - 1];
      since = negated(c.time);
      state = {-Integer(to_come), reversed(c.blue), reversed(c.red)};
    }
    const double age = (now.hi - since.hi) + (now.lo - since.lo);
    for (BlockMotion* const block : {&state.blue, &state.red})
      block->position += block->velocity * age;
    require_finite(now, state.blue, state.red, "state");
    return state;
  }

  Rational time_after(const Integer& index) const override {
    Rational time = to_rational(blocks_collision(index).time);
    if (blocks_at(time).count == index) return time;
    throw SimulationError(fmt::format(
        "collision #{}: in double precision it cannot be told apart from its neighbours; use the "
        "closed form (--engine unfolded)",
        index.get_str()));
  }

 private:
  StoredCollisions forward_;
  StoredCollisions backward_;
};

}  // namespace

std::unique_ptr<PairLog> make_event_log(const System& system) {
  if (!is_elastic(system)) {
    throw UsageError(
        "event loop: its collisions are elastic; for blocks.restitution and wall.restitution use "
        "the closed form (--engine unfolded)");
  }
  const TwoBlocks blocks = two_blocks_of(system).value();
  const Integer count =
      std::max(ExactMotion(blocks).total(), ExactMotion(reversed(blocks)).total());
  if (count > to_integer(kMaxStoredCollisions)) {
    throw UsageError(fmt::format(
        "event loop: {} collisions are more than the limit of {}; use the closed form (--engine "
        "unfolded)",
        readable(count), readable(to_integer(kMaxStoredCollisions))));
  }
  return std::make_unique<EventLog>(system, event_loop(blocks), event_loop(reversed(blocks)));
}

}  // namespace piblocks
