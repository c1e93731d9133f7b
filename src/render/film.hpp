// What every frame of a film shows.
// In: a scene or a storyboard, once, and the number of a frame. Out: its draw list.
#pragma once

#include <piblocks/instant.hpp>
#include <piblocks/script.hpp>

#include <cstdint>
#include <span>
#include <vector>

#include "draw/canvas.hpp"
#include "draw/draw_list.hpp"
#include "render/film_part.hpp"

namespace piblocks {

/// A part and its place in the film.
struct PlacedPart {
  FilmPart part;
  std::int64_t first_frame = 0;
  std::int64_t fade_frames = 0;  ///< first frames, during which the part before fades out
};

/// Const members are thread-safe.
class Film {
 public:
  /// @throws SceneError if problems_of() what it is made from is not empty; UsageError if a fade is
  ///         not shorter than its parts, or as FilmPart; SimulationError, DrawError
  explicit Film(const Script& script, FilmUse use = FilmUse::pictures);

  const View& view() const noexcept { return view_; }
  std::int64_t frame_count() const noexcept { return frame_count_; }
  /// @param number  from 0 to frame_count() - 1.
  DrawList frame(std::int64_t number) const;
  /// In the order of the film; at least one. Frame k is shown from k / frame_rate seconds on.
  std::span<const PlacedPart> parts() const noexcept { return parts_; }

 private:
  void add_parts(const Storyboard& story, FilmUse use);
  void place_parts(const Storyboard& story);

  View view_;
  std::vector<PlacedPart> parts_;
  std::int64_t frame_count_ = 0;
};

/// The frame of a storyboard's film that an instant names: a time in seconds of video, or "last"
/// for the last frame, and seconds before it.
/// @throws UsageError if the film has no such frame.
std::int64_t frame_at(const Film& film, const Instant& instant);

}  // namespace piblocks
