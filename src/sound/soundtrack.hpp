// What a film sounds like: a clack at every collision of each run it shows.
// In: runs, and when and where in the film each is heard. Out: its samples, in order.
#pragma once

#include <piblocks/run.hpp>
#include <piblocks/scene.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "scene/schedule.hpp"

namespace piblocks {

/// An even change of weight between two instants of the film, in seconds.
struct Ramp {
  Rational begin_s;
  Rational end_s;  ///< > begin_s
};

/// A run as a film has it.
struct Voice {
  const Scene& scene;              ///< must outlive the soundtrack
  const CollisionLog& log;         ///< must outlive the soundtrack
  std::vector<Stretch> stretches;  ///< as Schedule has them, from begin_s on
  Rational begin_s = 0;            ///< when it begins in the film, >= 0
  Rational end_s = 0;              ///< > begin_s; nothing of it is heard from then on
  std::optional<Ramp> rise = {};   ///< its weight goes from 0 to 1
  std::optional<Ramp> fall = {};   ///< and from 1 to 0; without it, it ends with a cut
  /// Where its picture is in the frame, from 0, the left edge, to 1, the right one.
  double left = 0;
  double right = 1;
};

/// 48 kHz in stereo. A collision is heard at the very moment when the film shows it; where the film
/// stands still there is none, where it goes backwards they come in the reverse order. Slow motion
/// moves clacks apart and leaves each as it is. Takes the same memory for a film of any length, and
/// the same bits come out each time. Used by one thread at a time.
class Soundtrack {
 public:
  static constexpr int kRate_hz = 48000;
  static constexpr int kChannels = 2;  ///< left, right

  /// @param voices      in the order in which they begin; none is silence.
  /// @param duration_s  of the film, > 0.
  /// @throws UsageError if stretches do not begin at 0 s, or are not in the film's order.
  Soundtrack(std::vector<Voice> voices, const Rational& duration_s);
  /// Of a film of one run.
  /// @param log         must outlive the soundtrack, as the scene.
  /// @param stretches   as Schedule has them; copied.
  Soundtrack(const Scene& scene, const CollisionLog& log, std::span<const Stretch> stretches,
             const Rational& duration_s);
  ~Soundtrack();
  Soundtrack(const Soundtrack&) = delete;
  Soundtrack& operator=(const Soundtrack&) = delete;

  /// Pairs of samples in the whole: the film's duration, to the nearest.
  std::int64_t size() const noexcept;
  /// Writes the next samples, left and right in turn, from -1 to 1.
  /// @return how many pairs; less than there is room for only at the end.
  /// @throws SimulationError as CollisionLog::state_at().
  std::size_t read(std::span<float> samples);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace piblocks
