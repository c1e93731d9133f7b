#include "physics/exact_log.hpp"

#include <piblocks/error.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include "physics/impact_sum.hpp"
#include "physics/indexed_stream.hpp"
#include "physics/listed_exposure.hpp"
#include "physics/require_finite.hpp"

namespace piblocks {
namespace {

/// With theta >= pi/4 there are at most a handful.
constexpr int kMaxEvents = 16;

constexpr double kUnitRoundoff = 0x1p-53;

/// Time until a gap that changes at `rate` is closed, if ever.
std::optional<Rational> closing_time(const Rational& gap, const Rational& rate) {
  if (rate >= 0) return std::nullopt;
  return Rational(-gap / rate);
}

void advance(BlockSystem& system, const Rational& duration) {
  system.blue.position += system.blue.velocity * duration;
  system.red.position += system.red.velocity * duration;
}

void reverse(BlockSystem& system) {
  system.blue.velocity = -system.blue.velocity;
  system.red.velocity = -system.red.velocity;
}

/// The relative velocity is reversed, the centre of mass keeps its own.
void collide_blocks(BlockSystem& system) {
  Block& blue = system.blue;
  Block& red = system.red;
  const Rational centre =
      (blue.mass * blue.velocity + red.mass * red.velocity) / (blue.mass + red.mass);
  blue.velocity = 2 * centre - blue.velocity;
  red.velocity = 2 * centre - red.velocity;
}

/// Performs the next collision.
std::optional<ExactCollision> next_after(const Rational& time, BlockSystem now) {
  const auto to_wall = closing_time(now.blue_gap(), now.blue.velocity);
  const auto to_blocks = closing_time(now.blocks_gap(), now.red.velocity - now.blue.velocity);
  if (!to_wall && !to_blocks) return std::nullopt;
  const bool blocks = to_blocks && (!to_wall || *to_blocks <= *to_wall);
  const Rational& wait = blocks ? *to_blocks : *to_wall;
  advance(now, wait);
  if (blocks) {
    collide_blocks(now);
  } else {
    now.blue.velocity = -now.blue.velocity;
  }
  return ExactCollision{time + wait, blocks ? CollisionKind::blocks : CollisionKind::wall,
                        std::move(now)};
}

std::vector<ExactCollision> run(const BlockSystem& system) {
  std::vector<ExactCollision> events;
  for (auto event = next_after(0, system); event;
       event = next_after(events.back().time, events.back().after)) {
    if (events.size() == kMaxEvents) {
      throw SimulationError("exact events: more collisions than a light red block can have");
    }
    events.push_back(*event);
  }
  return events;
}

BlockSystem reversed(BlockSystem system) {
  reverse(system);
  return system;
}

Motion motion_of(const Block& block) {
  return {to_double(block.position), to_double(block.velocity)};
}

/// In the unit of Impact. It is rounded once its square, which has no root in it, is known.
double impulse_of(const ExactCollision& collision) {
  const Block& blue = collision.after.blue;
  const Block& red = collision.after.red;
  const Rational r = blue.mass / red.mass;
  const Rational change = collision.kind == CollisionKind::wall
                              ? Rational((1 + r) * blue.velocity)
                              : Rational(red.velocity - blue.velocity);
  const Rational speed_squared = r * blue.velocity * blue.velocity + red.velocity * red.velocity;
  return std::sqrt(to_double(change * change / speed_squared));
}

/// The blocks as the nearest doubles.
struct Rounded {
  Time time;
  Motion blue;
  Motion red;
};

Rounded rounded(const Rational& time, const BlockSystem& system) {
  const Rounded result{to_time(time), motion_of(system.blue), motion_of(system.red)};
  require_finite(result.time, result.blue, result.red, "exact events");
  return result;
}

}  // namespace

ExactLog::ExactLog(const BlockSystem& system)
    : initial_(system),
      forward_(run(system)),
      backward_(run(reversed(system))),
      size_(forward_.size()) {}

Collision ExactLog::at(const Integer& index) const {
  const ExactCollision& event = forward_[index.get_ui() - 1];
  const Rounded after = rounded(event.time, event.after);
  return {index, after.time, event.kind, after.blue, after.red};
}

std::unique_ptr<CollisionStream> ExactLog::stream(const Integer& first, const Integer& last) const {
  return std::make_unique<IndexedStream>(*this, first, last);
}

FreeFlight ExactLog::flight_at(const Rational& time) const {
  Integer count = 0;
  Rational since = time;
  BlockSystem now = initial_;
  for (const ExactCollision& event : forward_) {
    if (event.time > time) break;
    ++count;
    since = time - event.time;
    now = event.after;
  }
  // Seen forwards, what the reversed run does after a collision ends with that collision; one
  // exactly at `time` has happened.
  for (const ExactCollision& event : backward_) {
    if (-event.time <= time) break;
    --count;
    since = time + event.time;
    now = reversed(event.after);
  }
  advance(now, since);
  const Rounded at = rounded(time, now);
  return {count, 0, at.blue, at.red};
}

const ExactCollision& ExactLog::event(long index) const {
  return index > 0 ? forward_[static_cast<std::size_t>(index - 1)]
                   : backward_[static_cast<std::size_t>(-index)];
}

Rational ExactLog::time_of(long index) const {
  const Rational& time = event(index).time;
  return index > 0 ? time : Rational(-time);
}

std::optional<Impact> ExactLog::impact(CollisionKind kind, const Integer& first,
                                       const Integer& last) const {
  ImpactSum sum(kind);
  for (long index = first.get_si(); index <= last.get_si(); ++index) {
    const ExactCollision& collision = event(index);
    if (collision.kind != kind) continue;
    sum.add(to_time(time_of(index)), impulse_of(collision),
            to_double(collision.after.blue.position));
  }
  return sum.result();
}

Integer ExactLog::count_near(const Time& time) const { return flight_at(to_rational(time)).count; }

std::unique_ptr<Exposure> ExactLog::expose(const Rational& begin, const Rational& end) const {
  const Rational& first = std::min(begin, end);
  const Rational& last = std::max(begin, end);
  const FreeFlight start = flight_at(first);
  PieceList pieces(start.blue.position, start.red.position);
  Rational now = first;
  const auto go_to = [&](const Rational& time, double blue, double red) {
    pieces.add(to_double(time - now), blue, red);
    now = time;
  };
  const auto meet = [&](const Rational& time, const BlockSystem& blocks) {
    if (time <= first || time >= last) return;
    go_to(time, to_double(blocks.blue.position), to_double(blocks.red.position));
  };
  for (auto event = backward_.rbegin(); event != backward_.rend(); ++event) {
    meet(-event->time, event->after);
  }
  for (const ExactCollision& event : forward_) meet(event.time, event.after);
  const FreeFlight stop = flight_at(last);
  go_to(last, stop.blue.position, stop.red.position);
  return std::make_unique<ListedExposure>(pieces.take());
}

std::optional<PositionBounds> ExactLog::bounds_at(const Rational& time) const {
  const FreeFlight now = flight_at(time);
  return PositionBounds{kUnitRoundoff * std::fabs(now.blue.position),
                        kUnitRoundoff * std::fabs(now.red.position)};
}

}  // namespace piblocks
