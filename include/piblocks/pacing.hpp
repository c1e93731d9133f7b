// How simulation time runs in the video.
// In: plain values, or the texts of options. Out: the same as exact text.
#pragma once

#include <piblocks/exact.hpp>
#include <piblocks/instant.hpp>

#include <cstddef>
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

/// The slowest that automatic slow motion becomes: slower still, nothing would move by a pixel.
inline constexpr int kMaxAutomaticFactor = 1000;

/// Lengths are seconds of video, and are rounded up to whole frames; that of a loop to an even
/// number of them.
struct Pacing {
  /// Length of the whole video with holds and freezes. It sets the speed; TimeSpan::speed is
  /// ignored.
  std::optional<Rational> duration_s = {};
  /// Windows around the turn (of bodies, and with restitution below 1, around the densest
  /// collisions), each ten times slower than the one around it, until single collisions can be told
  /// apart or kMaxAutomaticFactor is reached. With a duration they are those of speed 1, and scale
  /// with the rest of the video.
  bool automatic_slow_motion = false;
  std::vector<SlowMotion> slow_motion = {};
  /// How long slow motion takes to set in and to end, 0 … kMaxEase_s; 0 is abrupt. The time is
  /// taken from the faster side, so that a window keeps its factor from beginning to end; where
  /// there is too little of it, the ease is shorter. It is not rounded. A duration scales it.
  Rational ease_s = Rational(1, 2);
  std::vector<Freeze> freezes = {};
  Rational hold_start_s = 0;  ///< how long the first picture stands still, >= 0
  Rational hold_end_s = 0;    ///< the same of the last
  /// Plays forwards and then backwards, so that the first frame follows the last without a jump.
  bool loop = false;
};

inline constexpr int kMaxEase_s = 5;

/// Most windows of slow motion, and most freezes, of one scene.
inline constexpr std::size_t kMaxWindows = 1000;

/// Reads "FROM:TO:FACTOR", as "turn-0.3:turn+0.3:10". @throws UsageError
SlowMotion parse_slow_motion(std::string_view text);
/// Reads "AT:SECONDS", as "turn:2". @throws UsageError
Freeze parse_freeze(std::string_view text);
/// Exact text, which reads back as the same.
std::string exact_text(const SlowMotion& window);
std::string exact_text(const Freeze& freeze);

}  // namespace piblocks
