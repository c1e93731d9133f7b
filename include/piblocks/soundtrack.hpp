// What a film sounds like: a clack at every collision.
// In: a scene, its collision log, the stretches of the film. Out: its samples, in order.
#pragma once

#include <piblocks/collision_log.hpp>
#include <piblocks/scene.hpp>
#include <piblocks/schedule.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

namespace piblocks {

/// 48 kHz in stereo. A collision is heard at the very moment when the film shows it; where the film
/// stands still there is none, where it goes backwards they come in the reverse order. Slow motion
/// moves clacks apart and leaves each as it is. Takes the same memory for a film of any length, and
/// the same bits come out each time. Used by one thread at a time.
class Soundtrack {
 public:
  static constexpr int kRate_hz = 48000;
  static constexpr int kChannels = 2;  ///< left, right

  /// @param log         must outlive the soundtrack.
  /// @param stretches   as Schedule has them; copied.
  /// @param duration_s  of the film, > 0.
  Soundtrack(const Scene& scene, const CollisionLog& log, std::span<const Stretch> stretches,
             const Rational& duration_s);
  ~Soundtrack();
  Soundtrack(const Soundtrack&) = delete;
  Soundtrack& operator=(const Soundtrack&) = delete;

  /// Pairs of samples in the whole: the film's duration, to the nearest.
  std::int64_t size() const noexcept;
  /// Writes the next samples, left and right in turn, from -1 to 1.
  /// @return how many pairs; less than there is room for only at the end.
  /// @throws SimulationError as CollisionLog::flight_at().
  std::size_t read(std::span<float> samples);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace piblocks
