// The logs of bodies.
// In: a BodySystem without problems. Out: logs in closed form, or stepped and stored.
#pragma once

#include <piblocks/bodies.hpp>

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

namespace piblocks {

/// The closed form, if the bodies are two blocks and a wall beside them by other names, or their
/// mirror image; otherwise nothing.
std::unique_ptr<BodyLog> make_closed_body_log(const BodySystem& system);

/// Collisions that are computed one after the other and stored.
/// @param until  as make_body_log()
std::unique_ptr<BodyLog> make_stored_body_log(const BodySystem& system,
                                              const std::optional<Rational>& until);

/// The bodies at time 0.
std::vector<BodyMotion> motions_at_start(const BodySystem& system);

/// A body's places at so many times from the first to the second, evenly spaced.
std::vector<std::array<double, 2>> sampled_path(const BodyLog& log, std::size_t body,
                                                const std::array<Rational, 2>& times,
                                                std::size_t count);

/// @throws UsageError if the time is negative.
void require_not_negative(const Rational& time);

}  // namespace piblocks
