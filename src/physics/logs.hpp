// The logs there are, and what they share.
// In: a System without problems. Out: a log; collisions that have no instant after them.
#pragma once

#include <piblocks/error.hpp>
#include <piblocks/two_blocks.hpp>

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace piblocks {

/// Collisions that are computed one after the other when they are asked for, and stored.
/// @param horizon, stop, engine  as make_log()
std::unique_ptr<Log> make_stepped_log(const System& system, const std::optional<Rational>& horizon,
                                      const std::stop_token& stop, Engine engine);

/// As make_log(). @param system  has no problems
std::unique_ptr<Log> make_log_of_valid(const System& system, const std::optional<Rational>& horizon,
                                       const std::stop_token& stop, Engine engine);

/// All bodies at time 0.
std::vector<Motion> motions_at_start(const System& system);
/// A body at time 0, or a wall. @param id  as in Collision
Motion motion_at_start(const System& system, std::size_t id);
/// As in "blue", "body 3" or "the left wall". @param id  as in Collision
std::string noun_of(const System& system, std::size_t id);

/// As in "infinitely many collisions of body 1, body 2 and the left wall until t = 5.17". Of two
/// blocks beside something immovable it says that they come to rest.
std::string text_of(const System& system, const Collapse& collapse);
/// Collisions of these have no number. @throws UsageError with text_of() both.
[[noreturn]] void refuse_count(const System& system, const Collapse& collapse);

/// `count` >= 2 shares of an interval of time, 0 … 1, in order: both ends, and one in each of equal
/// parts between. They follow no rhythm, so that they do not fall in step with a body that bounces.
std::vector<double> sample_times(std::size_t count);

/// @throws UsageError if the time is negative.
void require_not_negative(const Rational& time);

inline BlockMotion motion_of(const Block& block) {
  return {to_double(block.position), to_double(block.velocity)};
}

/// The motion at a time until which the block meets nothing, rounded once.
inline BlockMotion motion_at(const Block& block, const Rational& time) {
  return {to_double(block.position + block.velocity * time), to_double(block.velocity)};
}

inline BlockMotion reversed(const BlockMotion& motion) {
  return {motion.position, -motion.velocity};
}

/// The same blocks with opposite velocities: what they do is the past of `system`, backwards.
inline TwoBlocks reversed(TwoBlocks system) {
  system.blue.velocity = -system.blue.velocity;
  system.red.velocity = -system.red.velocity;
  return system;
}

/// @param engine  named in the message.
/// @throws SimulationError if a number is not finite.
void require_finite(const Time& time, const BlockMotion& blue, const BlockMotion& red,
                    const char* engine);

/// The collision is not the last one at its time.
class TiedCollision : public UsageError {
 public:
  TiedCollision(const Integer& index, Integer last);
  const Integer& last() const noexcept { return last_; }

 private:
  Integer last_;
};

/// Collisions that happen at the same time have no instant between them.
/// @throws TiedCollision unless the collision is the last one at its time.
void require_last(const Integer& index, const Integer& last_at_its_time);

/// As make_pair_log() of a system without problems, which has two_blocks_of().
std::unique_ptr<PairLog> make_valid_pair_log(const System& system,
                                             Engine engine = Engine::unfolded);

/// The event loop in exact rational arithmetic, for the few collisions of a light red block. Every
/// answer is rounded once.
/// @param system  with m_red <= m_blue, or at rest.
std::unique_ptr<PairLog> make_exact_log(const System& system);

/// The closed form of elastic blocks, of which red is the heavier one.
/// @throws UsageError if the mass ratio is beyond 2^2000.
/// @throws SimulationError if the blocks pass the corner closer than a double can tell.
std::unique_ptr<PairLog> make_unfolded_log(const System& system);

/// The closed form of blocks that lose energy where they collide.
/// @throws SimulationError as RoundPowers.
std::unique_ptr<PairLog> make_inelastic_log(const System& system);

/// Engine::events, which advances positions to the next collision of any pair, in double precision.
/// @throws UsageError if the collisions are more than kMaxStoredCollisions.
/// @throws SimulationError if a number leaves its range, or the rounding of double precision more
///         than doubles the number of collisions.
std::unique_ptr<PairLog> make_event_log(const System& system);

}  // namespace piblocks
