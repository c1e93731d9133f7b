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

/// `count` >= 2 shares of an interval of time, 0 … 1, in order: both ends, and one in each of equal
/// parts between. They follow no rhythm, so that they do not fall in step with a body that bounces.
std::vector<double> sample_times(std::size_t count);

/// Bodies that are two blocks and a wall by other names.
struct ClosedBlocks {
  const CollisionLog& log;
  std::size_t blue = 0;  ///< place of the body that stands for it
  std::size_t red = 0;
  int sign =
      1;  ///< -1 if the bodies are mirrored: their positions are those of the blocks times -1
};

/// Nothing if the log is no other's closed form. Valid while the log is.
std::optional<ClosedBlocks> closed_blocks(const BodyLog& log);

/// @throws UsageError if the time is negative.
void require_not_negative(const Rational& time);

}  // namespace piblocks
