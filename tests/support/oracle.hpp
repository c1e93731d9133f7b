// The right answers that tests compare with, by two routes that share nothing with the library.
// In: a TwoBlocks. Out: every collision exactly; or the state at any time from plane geometry.
// Slow, and meant to be: clarity and certainty are all that counts here.
#pragma once

#include <piblocks/exact.hpp>
#include <piblocks/two_blocks.hpp>

#include <cstdint>
#include <vector>

namespace piblocks::oracle {

/// A block's centre and velocity.
struct ExactMotion {
  Rational position;
  Rational velocity;
};

/// One collision; velocities are those just after it.
struct ExactEvent {
  CollisionKind kind;
  Rational time;
  ExactMotion blue;
  ExactMotion red;
};

struct ExactState {
  Integer count;  ///< collisions since time 0, those at the time asked for included; or minus
                  ///< those between it and time 0
  ExactMotion blue;
  ExactMotion red;
};

/// The same blocks with opposite velocities: its future is the system's past.
TwoBlocks reversed(const TwoBlocks& system);

/// All collisions from time 0 on, in rational arithmetic without rounding. Numbers grow with
/// every collision: some thousand collisions are practical.
/// If both collisions are due at once, the blocks' is first when the blocks approach; the wall's
/// when they touch and move to the wall together.
/// @throws SimulationError if there are more than max_events.
std::vector<ExactEvent> exact_run(const TwoBlocks& system, std::int64_t max_events);

/// The state at time t, of either sign. `run` is exact_run() of the same system; before time 0 it
/// is run backwards, with as many events at most as `max_events`.
ExactState exact_state(const TwoBlocks& system, const std::vector<ExactEvent>& run,
                       const Rational& t, std::int64_t max_events = 100'000);

/// The state at time t, of either sign, with every error below 2^-200 for systems whose numbers
/// are of ordinary size. One evaluation in multiple precision, however many collisions there are:
/// in the plane (sqrt(m_blue) y_blue, sqrt(m_red) y_red) of the gaps to the corner the motion,
/// reflected at every collision, is one straight line; the rays it has crossed are counted by the
/// angle it has swept since time 0, and the line is folded back by as many reflections.
/// Phases within 2^-(precision/2) of a ray count as on it. Simultaneous collisions (a line through
/// the corner) are ordered as exact_run() does, in the limit.
/// @param extra_bits of precision beyond 512 + 4 |log2(m_red / m_blue)|.
ExactState high_precision_state(const TwoBlocks& system, const Rational& t,
                                std::int64_t extra_bits = 0);

/// One collision by the same geometry: where the line crosses its ray. For a line that misses the
/// corner and crosses it. @param index  as in PairLog
ExactEvent high_precision_collision(const TwoBlocks& system, const Integer& index,
                                    std::int64_t extra_bits = 0);

/// Number of collisions from time 0 on, by the same geometry.
Integer high_precision_total(const TwoBlocks& system, std::int64_t extra_bits = 0);

}  // namespace piblocks::oracle
