// What a film sounds like: a clack at every collision of each run it shows.
// In: runs, and when and where in the film each is heard. Out: its samples, in order.
#pragma once

#include <piblocks/run.hpp>
#include <piblocks/scene.hpp>

#include <cstddef>
#include <cstdint>
#include <list>
#include <span>
#include <vector>

#include "sound/limiter.hpp"
#include "sound/run_sound.hpp"

namespace piblocks {

/// 48 kHz in stereo. Each collision sounds exactly when the film shows it. A freeze has none, and a
/// film that goes backwards has them in reverse order. Slow motion moves clacks apart and does not
/// change them. Takes the same memory for a film of any length, and makes the same bits each time.
/// Used by one thread at a time.
class Soundtrack {
 public:
  static constexpr int kRate_hz = 48000;

  /// @param voices      in the order in which they begin; may be empty
  /// @param duration_s  of the film, > 0
  /// @throws UsageError if stretches do not begin at 0 s, or are not in the film's order.
  Soundtrack(std::vector<Voice> voices, const Rational& duration_s);

  /// Pairs of samples: the film's duration, to the nearest.
  std::int64_t size() const noexcept { return size_; }
  /// Writes the next samples, left and right in turn, from -1 to 1.
  /// @return how many pairs; less than there is room for only at the end.
  /// @throws SimulationError as CollisionLog::state_at().
  std::size_t read(std::span<float> samples);

 private:
  void find_next_voice();
  Limiter::Pair next_limited();

  Rational duration_s_;
  std::int64_t size_;
  std::vector<Voice> voices_;
  std::size_t begun_ = 0;        // of the voices
  std::int64_t next_begin_ = 0;  // pair with which the next one begins
  std::list<RunSound> playing_;
  Limiter limiter_;
  std::int64_t mixed_ = 0;  // pairs that went into the limiter
  std::int64_t given_ = 0;  // pairs of the whole
};

}  // namespace piblocks
