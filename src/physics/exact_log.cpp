#include <piblocks/error.hpp>

#include <algorithm>
#include <cmath>

#include "physics/exact_line.hpp"
#include "physics/logs.hpp"

namespace piblocks {
namespace {

/// With theta >= pi/4 there are at most a handful.
constexpr int kMaxEvents = 16;

/// A collision and the blocks just after it.
struct ExactCollision {
  Rational time;
  CollisionKind kind;
  TwoBlocks blocks;
};

/// From time 0 on.
std::vector<ExactCollision> run(TwoBlocks blocks) {
  ExactLine line(system_of(blocks));
  const LineElement& blue = line.elements()[1];  // beside the wall
  const LineElement& red = line.elements()[2];
  std::vector<ExactCollision> events;
  while (const auto step = line.step()) {
    if (events.size() == kMaxEvents) {
      throw SimulationError("exact events: more collisions than a light red block can have");
    }
    blocks.blue.position = blue.position_at(line.time());
    blocks.blue.velocity = blue.velocity;
    blocks.red.position = red.position_at(line.time());
    blocks.red.velocity = red.velocity;
    const bool is_at_wall = step->second != red.id;
    events.push_back(
        {line.time(), is_at_wall ? CollisionKind::wall : CollisionKind::blocks, blocks});
  }
  return events;
}

/// Rounded once.
PairCollision rounded_collision(const Integer& index, const ExactCollision& exact) {
  PairCollision result{index, to_time(exact.time), exact.kind, motion_of(exact.blocks.blue),
                       motion_of(exact.blocks.red)};
  require_finite(result.time, result.blue, result.red, "exact events");
  return result;
}

Gaps gaps_of(const TwoBlocks& blocks) {
  const Rational y1 = blocks.blue_gap();
  return {to_double(y1), to_double(y1 + blocks.blocks_gap())};
}

class ExactLog final : public PairLog {
 public:
  explicit ExactLog(const System& system)
      : PairLog(system), start_{0, CollisionKind::wall, blocks()} {
    // Before time 0 the velocities just after a collision are the opposite of those just before it
    // in the reversed run.
    for (ExactCollision& event : run(reversed(blocks()))) {
      ExactCollision collision{-event.time, event.kind, event.blocks};
      collision.blocks.blue.velocity = start_.blocks.blue.velocity;
      collision.blocks.red.velocity = start_.blocks.red.velocity;
      start_ = {collision.time, collision.kind, reversed(event.blocks)};
      events_.insert(events_.begin(), std::move(collision));
    }
    const Integer past = events_.size();
    for (ExactCollision& event : run(blocks())) events_.push_back(std::move(event));
    set_range(1 - past, events_.size() - past);
  }

  PairCollision blocks_collision(const Integer& index) const override {
    return rounded_collision(index, event(index));
  }

  PairState blocks_at(const Rational& time) const override {
    const Integer count = first_index() - 1 + Integer(happened(time) - events_.begin());
    const PairCollision at = rounded_collision(count, {time, CollisionKind::wall, system_at(time)});
    return {at.index, at.blue, at.red};
  }

  Rational time_after(const Integer& index) const override {
    require_last(index, blocks_at(event(index).time).count);
    return event(index).time;
  }

  std::optional<PositionBounds> bounds_at(const Rational& time) const override {
    constexpr double kRounding = 0x1p-53;
    const PairState now = blocks_at(time);
    return PositionBounds{kRounding * std::fabs(now.blue.position),
                          kRounding * std::fabs(now.red.position)};
  }
  bool is_exact(const Integer& /*index*/) const override { return true; }
  Gaps gaps_at(const Rational& time) const override { return gaps_of(system_at(time)); }
  Gaps gaps_at_collision(const Integer& index) const override {
    return gaps_of(event(index).blocks);
  }

 private:
  using Events = std::vector<ExactCollision>;

  TwoBlocks system_at(const Rational& time) const {
    const auto next = happened(time);
    const ExactCollision& since = next == events_.begin() ? start_ : *std::prev(next);
    TwoBlocks blocks = since.blocks;
    blocks.blue.position += blocks.blue.velocity * (time - since.time);
    blocks.red.position += blocks.red.velocity * (time - since.time);
    return blocks;
  }
  /// The end of those that have happened.
  Events::const_iterator happened(const Rational& time) const {
    return std::ranges::upper_bound(events_, time, {}, &ExactCollision::time);
  }
  const ExactCollision& event(const Integer& index) const {
    return events_[Integer(index - first_index()).get_ui()];
  }

  Events events_;         // of all time, in order
  ExactCollision start_;  // before all of them; its kind has no meaning
};

}  // namespace

std::unique_ptr<PairLog> make_exact_log(const System& system) {
  return std::make_unique<ExactLog>(system);
}

}  // namespace piblocks
