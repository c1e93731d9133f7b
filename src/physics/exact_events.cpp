#include "physics/exact_events.hpp"

#include <piblocks/error.hpp>

#include <optional>
#include <utility>

namespace piblocks {
namespace {

constexpr int kMaxEvents = 16;

/// Time until a gap that changes at `rate` is closed, if ever.
std::optional<Rational> closing_time(const Rational& gap, const Rational& rate) {
  if (rate >= 0) return std::nullopt;
  return Rational(-gap / rate);
}

class ExactLoop {
 public:
  explicit ExactLoop(BlockSystem system) : now_(std::move(system)) {}

  std::optional<StoredCollision> step() {
    const auto to_wall = closing_time(now_.blue_gap(), now_.blue.velocity);
    const auto to_blocks = closing_time(now_.blocks_gap(), now_.red.velocity - now_.blue.velocity);
    if (!to_wall && !to_blocks) return std::nullopt;
    const bool blocks = to_blocks && (!to_wall || *to_blocks <= *to_wall);
    advance(blocks ? *to_blocks : *to_wall);
    if (blocks) {
      collide_blocks();
    } else {
      now_.blue.velocity = -now_.blue.velocity;
    }
    return StoredCollision{to_time(time_), blocks ? CollisionKind::blocks : CollisionKind::wall,
                           motion_of(now_.blue), motion_of(now_.red)};
  }

 private:
  static Motion motion_of(const Block& block) {
    return {to_double(block.position), to_double(block.velocity)};
  }

  void advance(const Rational& duration) {
    now_.blue.position += now_.blue.velocity * duration;
    now_.red.position += now_.red.velocity * duration;
    time_ += duration;
  }

  /// The relative velocity is reversed, the centre of mass keeps its own.
  void collide_blocks() {
    const Rational total = now_.blue.mass + now_.red.mass;
    const Rational centre =
        (now_.blue.mass * now_.blue.velocity + now_.red.mass * now_.red.velocity) / total;
    now_.blue.velocity = 2 * centre - now_.blue.velocity;
    now_.red.velocity = 2 * centre - now_.red.velocity;
  }

  BlockSystem now_;
  Rational time_ = 0;
};

}  // namespace

std::vector<StoredCollision> exact_events(const BlockSystem& system) {
  std::vector<StoredCollision> events;
  ExactLoop loop(system);
  while (const auto event = loop.step()) {
    if (events.size() == kMaxEvents) {
      throw SimulationError("exact events: more collisions than a light red block can have");
    }
    events.push_back(*event);
  }
  return events;
}

}  // namespace piblocks
