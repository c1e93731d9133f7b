// How a scene's time runs in its video: fitted, slowed, frozen, held, and played back and forth.
// In: text of a scene file or an option. Out: plain values; schedule.hpp makes stretches of them.
#pragma once

#include <piblocks/exact.hpp>
#include <piblocks/instant.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace piblocks {

/// A window of simulation time that takes `factor` times as long as it would.
struct SlowMotion {
  Instant from;
  Instant to;
  Rational factor = 1;  ///< > 0
};

/// The picture stands still at an instant.
struct Freeze {
  Instant at;
  Rational length_s;  ///< of video, > 0
};

/// Most times slower that automatic slow motion becomes. Slower still, nothing would move by a
/// pixel.
inline constexpr int kMaxAutomaticFactor = 1000;

/// Lengths are seconds of video, and are rounded up to whole frames; that of a loop to an even
/// number of them.
struct Pacing {
  /// Of the whole video, holds and freezes included. It sets the speed; TimeSpan::speed is ignored.
  std::optional<Rational> duration_s = {};
  /// Windows around the turn, each ten times slower than the one around it, until single collisions
  /// can be told apart or kMaxAutomaticFactor is reached. With a duration they are those of speed
  /// 1, and scale with the rest of the video.
  bool automatic_slow_motion = false;
  std::vector<SlowMotion> slow_motion = {};
  std::vector<Freeze> freezes = {};
  Rational hold_start_s = 0;  ///< how long the first picture stands still, >= 0
  Rational hold_end_s = 0;    ///< how long the last picture stands still, >= 0
  /// Plays forwards and then backwards, so that the first frame follows the last without a jump.
  bool loop = false;
};

/// Most windows of slow motion, and most freezes, of one scene.
inline constexpr std::size_t kMaxWindows = 1000;

/// Reads "FROM:TO:FACTOR", as "turn-0.3:turn+0.3:10". @throws UsageError
SlowMotion parse_slow_motion(std::string_view text);
/// Reads "AT:SECONDS", as "turn:2". @throws UsageError
Freeze parse_freeze(std::string_view text);

/// Exact text of a value, which reads back as the same.
std::string exact_text(const SlowMotion& window);
std::string exact_text(const Freeze& freeze);

}  // namespace piblocks
