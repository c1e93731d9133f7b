// Blocks that lose energy, stepped from collision to collision in rational numbers.
// In: a TwoBlocks. Out: its first collisions exactly. Shares no formula with the library.
#pragma once

#include <piblocks/two_blocks.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

namespace piblocks::oracle {

struct InelasticEvent {
  CollisionKind kind = CollisionKind::blocks;
  Rational time;
  Rational impulse;
  Block blue;  ///< just after
  Block red;
};

struct InelasticRun {
  std::vector<InelasticEvent> events;
  bool ended = false;  ///< whether there are no more

  /// Events until then, those at it included.
  std::size_t count_at(const Rational& time) const {
    return std::size_t(std::ranges::count_if(
        events, [&](const InelasticEvent& event) { return event.time <= time; }));
  }
};

/// Approaching bodies that touch collide at once; of two such pairs the blocks are first.
inline InelasticRun inelastic_run(const TwoBlocks& system, std::size_t max_events) {
  const Rational at_wall = system.wall_face + system.blue.width / 2;
  const Rational contact = (system.blue.width + system.red.width) / 2;
  Block blue = system.blue;
  Block red = system.red;
  InelasticRun run;
  Rational now = 0;
  while (run.events.size() < max_events) {
    std::optional<Rational> wait;
    CollisionKind kind = CollisionKind::wall;
    if (blue.velocity < 0) wait = (blue.position - at_wall) / -blue.velocity;
    if (blue.velocity > red.velocity) {
      const Rational until =
          (red.position - blue.position - contact) / (blue.velocity - red.velocity);
      if (!wait || until <= *wait) {
        wait = until;
        kind = CollisionKind::blocks;
      }
    }
    if (!wait) {
      run.ended = true;
      return run;
    }
    now += *wait;
    blue.position += blue.velocity * *wait;
    red.position += red.velocity * *wait;
    Rational impulse;
    if (kind == CollisionKind::wall) {
      impulse = -blue.mass * blue.velocity * (1 + system.wall_restitution);
      blue.velocity *= -system.wall_restitution;
    } else {
      // Each velocity is that of the centre of mass and a part of the relative one.
      const Rational mass = blue.mass + red.mass;
      const Rational centre = (blue.mass * blue.velocity + red.mass * red.velocity) / mass;
      const Rational apart = system.blocks_restitution * (blue.velocity - red.velocity);
      const Rational before = red.velocity;
      blue.velocity = centre - apart * red.mass / mass;
      red.velocity = centre + apart * blue.mass / mass;
      impulse = red.mass * (red.velocity - before);
    }
    run.events.push_back({kind, now, impulse, blue, red});
  }
  return run;
}

}  // namespace piblocks::oracle
