// What a film sounds like, for the outputs that take sound.
// In: a film. Out: its samples; or from a shard file, its packets.
#pragma once

#include <functional>
#include <stop_token>
#include <string>

#include "media/output/output.hpp"
#include "media/output/shard_file.hpp"
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

/// The sound that the first shard of a rendering has for all of them.
class ShardSound final : public PacketSource {
 public:
  explicit ShardSound(const std::string& path) : reader_(path) {}

  std::optional<Packet> next() override {
    if (next_ == packets_.size()) {
      auto packets = reader_.next_sound();
      if (!packets || packets->empty()) return std::nullopt;
      packets_ = std::move(*packets);
      next_ = 0;
    }
    return std::move(packets_[next_++]);
  }

 private:
  ShardReader reader_;
  EncodedChunk packets_;
  std::size_t next_ = 0;
};

}  // namespace piblocks
