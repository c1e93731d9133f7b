// What a film sounds like, for the outputs that take sound.
// In: a film. Out: its samples.
#pragma once

#include <functional>
#include <span>
#include <stop_token>

#include "media/output/output.hpp"
#include "render/film.hpp"
#include "sound/soundtrack.hpp"

namespace piblocks {

/// Of a film with so many frames: as long as these, to the nearest sample.
inline SoundFormat sound_format(std::int64_t frame_count, const Rational& frame_rate) {
  const Rational size = Rational(frame_count) / frame_rate * Soundtrack::kRate_hz;
  return {.rate_hz = Soundtrack::kRate_hz, .size = floor(size + Rational(1, 2)).get_si()};
}

/// A film's soundtrack, until it is told to stop: each run of each segment at its time, and as loud
/// as its segment is seen. Cards are silent.
class FilmSound final : public SampleSource {
 public:
  /// @param film        must outlive it.
  /// @param on_samples  is told how many pairs there are so far.
  FilmSound(const Film& film, std::stop_token stop, std::function<void(std::int64_t)> on_samples);

  std::size_t read(std::span<float> samples) override;

 private:
  Soundtrack soundtrack_;
  std::stop_token stop_;
  std::function<void(std::int64_t)> on_samples_;
  std::int64_t count_ = 0;
};

}  // namespace piblocks
