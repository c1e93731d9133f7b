// A film that is changed and looked at again and again.
// In: a script, then frames and instants to be shown. Out: pixels of what differs from the picture
// before, states, files.
#pragma once

#include <piblocks/error.hpp>
#include <piblocks/instant.hpp>
#include <piblocks/script.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "draw/canvas.hpp"
#include "render/film.hpp"
#include "scene/run_tables.hpp"

namespace piblocks::web {

/// A part of the picture as a canvas of HTML takes it.
struct Patch {
  PixelRect rect;                       ///< of the picture
  std::vector<std::uint8_t> rgba = {};  ///< red, green, blue, alpha; row by row, nothing multiplied
};

/// The pixels of a page, which stay from film to film.
class Screen {
 public:
  /// Draws the list, which covers the whole picture, and converts what may have changed.
  /// @throws DrawError
  void update(DrawList list);
  /// What the last update may have changed.
  const Patch& patch() const noexcept { return patch_; }

 private:
  std::unique_ptr<Canvas> canvas_;
  Patch patch_;
};

/// A script that is open: pictures and states of any place in its film.
class LiveScript {
 public:
  /// A place in the film: a frame or, of a scene, also an instant that no frame may show.
  struct Place {
    std::optional<std::int64_t> frame = {};
    Instant instant = {};  ///< of a storyboard a second of its video
  };

  /// @param picture_size  else the script's own
  /// @throws what commands throw; then nothing has happened.
  explicit LiveScript(Script script, const std::optional<FrameSize>& picture_size = {});

  /// With its own size.
  const Script& script() const noexcept { return script_; }
  /// That of the pictures.
  const View& view() const noexcept { return view_; }
  /// Nothing of a storyboard.
  const FilmRun* run() const noexcept { return std::get_if<FilmRun>(&film_); }
  /// Nothing if the scene has no film: see film_problems().
  std::optional<std::int64_t> frame_count() const;
  /// Why the scene has stills alone, such as a span that ends before it begins; empty if it has a
  /// film.
  const std::vector<Problem>& film_problems() const noexcept { return film_problems_; }

  /// @param number  what is outside of the film stands for its nearest end.
  Place place_of_frame(std::int64_t number) const;
  /// @throws UsageError if the script has no such instant.
  Place place_of(const Instant& instant) const;
  /// The next collision (step 1) or the one before (step -1) that differs in time from this place.
  /// @returns the start of the film before the first collision; nothing after the last one, and
  ///          nothing for a storyboard. @throws UsageError, SimulationError as time_of().
  std::optional<Place> collision_beside(const Place& place, int step) const;
  /// The frame that shows the instant first, or is nearest to it; nothing if there is no film.
  std::optional<std::int64_t> frame_near(const Place& place) const;
  DrawList picture(const Place& place) const;
  /// The same in the script's own size.
  DrawList full_picture(const Place& place) const;
  /// Nothing of a storyboard. @throws SimulationError
  std::optional<StateRow> state(const Place& place) const;
  /// As `piblocks state` prints it.
  std::string state_text(const StateRow& state) const;

 private:
  void plan_film(const Scene& scene);

  Script script_;
  View view_;
  std::variant<FilmRun, Film> film_;
  std::optional<Schedule> schedule_;  ///< of a scene
  std::vector<Problem> film_problems_;
};

/// The sound of a film, in any order. Going back begins anew.
class LiveSound {
 public:
  /// @throws what commands throw.
  explicit LiveSound(const Script& script);
  ~LiveSound();
  LiveSound(const LiveSound&) = delete;
  LiveSound& operator=(const LiveSound&) = delete;

  /// Pairs of samples in the film.
  std::int64_t size() const;
  /// Reads the pairs from this one on, fewer at the end, into samples().
  void read(std::int64_t first, std::int64_t count);
  /// Left and right in turn.
  const std::vector<float>& samples() const noexcept { return samples_; }

 private:
  std::vector<float> read_up_to(std::int64_t end);

  Film film_;
  std::unique_ptr<FilmSound> sound_;
  std::int64_t next_ = 0;  ///< pair that comes next
  std::vector<float> samples_;
};

}  // namespace piblocks::web
