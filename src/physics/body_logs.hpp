// The log of bodies that are stepped, and what all logs use.
// In: a BodySystem without problems. Out: a log.
#pragma once

#include <piblocks/log.hpp>

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

namespace piblocks {

/// Collisions that are computed one after the other when they are asked for, and stored.
/// @param horizon, stop, engine  as make_log()
std::unique_ptr<Log> make_stored_body_log(const BodySystem& system,
                                          const std::optional<Rational>& horizon,
                                          const std::stop_token& stop, Engine engine);

/// As make_log(). @param system  has no problems
std::unique_ptr<Log> make_log_of_valid(const BodySystem& system,
                                       const std::optional<Rational>& horizon,
                                       const std::stop_token& stop, Engine engine);

/// All bodies at time 0.
std::vector<BodyMotion> motions_at_start(const BodySystem& system);
/// A body at time 0, or a wall. @param id  as in BodyCollision
BodyMotion motion_at_start(const BodySystem& system, std::size_t id);

/// `count` >= 2 shares of an interval of time, 0 … 1, in order: both ends, and one in each of equal
/// parts between. They follow no rhythm, so that they do not fall in step with a body that bounces.
std::vector<double> sample_times(std::size_t count);

/// @throws UsageError if the time is negative.
void require_not_negative(const Rational& time);

}  // namespace piblocks
