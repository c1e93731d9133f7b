#include "render/film_sound.hpp"

#include <piblocks/error.hpp>

#include <utility>
#include <vector>

namespace piblocks {
namespace {

/// The weight rises from 0, one frame before the fade, to 1, where only the new segment is seen.
std::optional<Ramp> fade_into(const PlacedSegment& segment, const Rational& frame_rate) {
  if (segment.fade_frames == 0) return std::nullopt;
  return Ramp{Rational(segment.first_frame - 1) / frame_rate,
              Rational(segment.first_frame + segment.fade_frames) / frame_rate};
}

std::vector<Voice> voices_of(const Film& film) {
  const Rational& rate = film.view().frame_rate;
  std::vector<Voice> voices;
  for (std::size_t i = 0; i < film.segments().size(); ++i) {
    const PlacedSegment& placed = film.segments()[i];
    const FilmSegment& segment = placed.segment;
    for (std::size_t k = 0; k < segment.runs().size(); ++k) {
      const FilmRun& run = segment.runs()[k];
      const auto stretches = segment.schedule()->stretches();
      Voice& voice = voices.emplace_back(
          Voice{.scene = run.scene(),
                .log = run.log(),
                .stretches = {stretches.begin(), stretches.end()},
                .begin_s = Rational(placed.first_frame) / rate,
                .end_s = Rational(placed.first_frame + segment.frame_count()) / rate});
      voice.rise = fade_into(placed, rate);
      if (i + 1 < film.segments().size()) voice.fall = fade_into(film.segments()[i + 1], rate);
      const PixelRect cell = segment.cell(k);
      voice.left = double(cell.x_px) / film.view().width_px;
      voice.right = double(cell.x_px + cell.width_px) / film.view().width_px;
    }
  }
  return voices;
}

}  // namespace

FilmSound::FilmSound(const Film& film, std::stop_token stop,
                     std::function<void(std::int64_t)> on_samples)
    : soundtrack_(voices_of(film), Rational(film.frame_count()) / film.view().frame_rate),
      stop_(std::move(stop)),
      on_samples_(std::move(on_samples)) {}

std::size_t FilmSound::read(std::span<float> samples) {
  if (stop_.stop_requested()) throw Interrupted("render: interrupted");
  const std::size_t count = soundtrack_.read(samples);
  count_ += static_cast<std::int64_t>(count);
  on_samples_(count_);
  return count;
}

}  // namespace piblocks
