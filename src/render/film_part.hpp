// What a film shows between two cuts: a run, several at a time, or a title card.
// In: scenes or lines of text, once, and the number of a frame. Out: its draw list.
#pragma once

#include <piblocks/run.hpp>
#include <piblocks/script.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "draw/composition.hpp"
#include "draw/story_pictures.hpp"
#include "scene/schedule.hpp"

namespace piblocks {

/// What a film is made for. For its sound alone nothing is laid out, and frame() must not be
/// called.
enum class FilmUse : std::uint8_t { pictures, audio_only };

/// A scene, its collisions, and what its frames are composed by. Const members are thread-safe.
class Run {
 public:
  /// @param log  of the scene's system.
  /// @throws UsageError, DrawError, MediaError as Composition and read_logo().
  Run(Scene scene, std::unique_ptr<CollisionLog> log, FilmUse use);

  const Scene& scene() const noexcept { return scene_; }
  const CollisionLog& log() const noexcept { return *log_; }
  /// A frame by a clock, which may be another run's. @param number  >= 0
  DrawList frame(const Schedule& clock, std::int64_t number) const {
    return picture(clock.frame(number, open_s(scene_.view)));
  }
  /// The picture of what a frame, or a still, shows of time.
  DrawList picture(const FrameTime& shown) const;

 private:
  Scene scene_;
  std::unique_ptr<CollisionLog> log_;
  std::optional<Composition> composition_;  ///< unless FilmUse::audio_only
};

/// Const members are thread-safe.
class FilmPart {
 public:
  /// Scenes and cards must have no problems. @throws UsageError, SimulationError, DrawError
  FilmPart(const Scene& scene, FilmUse use);
  FilmPart(const Runs& runs, const View& film, FilmUse use);
  FilmPart(const Card& card, const View& film, FilmUse use);
  FilmPart(FilmPart&&) = default;
  FilmPart& operator=(FilmPart&&) = default;
  FilmPart(const FilmPart&) = delete;
  FilmPart& operator=(const FilmPart&) = delete;
  ~FilmPart() = default;

  std::int64_t frame_count() const noexcept { return frame_count_; }
  /// @param number  within the part, from 0 to frame_count() - 1.
  DrawList frame(std::int64_t number) const;

  /// What is shown at the same time; none of a card.
  std::span<const Run> runs() const noexcept { return runs_; }
  /// Where a run's picture is in the frame. @param run  its place in runs().
  PixelRect cell(std::size_t run) const;
  /// The one clock of all runs, in seconds since the part began; none of a card.
  const Schedule* schedule() const noexcept { return schedule_ ? &*schedule_ : nullptr; }

 private:
  void show_one(Scene scene, FilmUse use);
  void compare(const Runs& runs, const View& film, FilmUse use);

  std::int64_t frame_count_ = 0;
  std::vector<Run> runs_;
  std::optional<Schedule> schedule_;
  std::optional<SplitScreen> split_;  ///< if there are several runs
  DrawList card_;                     ///< if there are none
};

}  // namespace piblocks
