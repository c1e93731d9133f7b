// A film: a scene, or a storyboard of runs side by side and title cards.
// In: a script, once. Out: the draw list of each frame, by its number; the samples of its sound.
#pragma once

#include <piblocks/image.hpp>
#include <piblocks/instant.hpp>
#include <piblocks/render.hpp>
#include <piblocks/scene.hpp>
#include <piblocks/script.hpp>
#include <piblocks/two_blocks.hpp>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

#include "draw/composition.hpp"
#include "draw/draw_list.hpp"
#include "draw/montage.hpp"
#include "media/output/output.hpp"
#include "render/frame_state.hpp"
#include "scene/run_log.hpp"
#include "scene/schedule.hpp"
#include "sound/soundtrack.hpp"

namespace piblocks {

/// What a film is made for. For its sound alone nothing is laid out, and frame() must not be
/// called.
enum class FilmUse : std::uint8_t { pictures, audio_only };

struct FilmMaking {
  FilmUse use = FilmUse::pictures;
  std::stop_token stop = {};  ///< ends the computing of collisions, as in make_log()
};

/// A scene, its collisions, and what its frames are composed by. Const members are thread-safe.
class FilmRun {
 public:
  /// @param log  of the scene.
  /// @throws UsageError, DrawError, MediaError as Composition and read_logo().
  FilmRun(Scene scene, std::unique_ptr<const Log> log, FilmUse use);

  const Scene& scene() const noexcept { return scene_; }
  const Log& log() const noexcept { return *log_; }
  /// Of its pictures, as of a Composition; not with FilmUse::audio_only.
  const Layout& layout() const noexcept { return composition_->layout(); }
  /// A frame by a schedule, which may be another run's. @param number  >= 0
  DrawList frame(const Schedule& schedule, std::int64_t number) const;
  /// A picture of each time: the first frame that shows the time. If no frame does, a frame that
  /// begins where the video first passes it. If the video never passes it, the picture of
  /// frame_time_alone(), without hits.
  /// @throws UsageError as make_schedule(), if slow motion, the shutter, hits or a diagram that
  ///         follows the video need a schedule.
  /// @param on_picture  called after each.
  std::vector<DrawList> stills(std::span<const Rational> times,
                               const std::function<void()>& on_picture) const;
  /// The picture of the scene at one instant.
  DrawList still(const Instant& instant) const;

 private:
  /// @param speed  simulation time per second of video
  DrawList picture(const FrameTime& shown, const Rational& speed,
                   const std::optional<VideoTime>& video_time) const;
  DrawList picture_at(const Schedule& schedule, const Rational& video_s) const;

  Scene scene_;
  std::unique_ptr<const Log> log_;
  std::optional<Composition> composition_;  ///< unless FilmUse::audio_only
};

/// The run of a scene without a film: a still may show what no film can.
/// @throws SceneError if problems_of() the scene is not empty; as FilmRun; SimulationError,
///         Interrupted
FilmRun run_of(const Scene& scene, const std::stop_token& stop = {});

/// Nothing if the scene shows none.
/// @throws UsageError, MediaError if the file cannot be read, or is no PNG.
std::shared_ptr<const Image> read_logo(const Scene& scene);

/// Const members are thread-safe.
class FilmSegment {
 public:
  /// @param segment  without problems. @throws UsageError, SimulationError, DrawError
  FilmSegment(const Segment& segment, const View& film, const FilmMaking& making);
  FilmSegment(FilmSegment&&) = default;
  FilmSegment& operator=(FilmSegment&&) = default;
  FilmSegment(const FilmSegment&) = delete;
  FilmSegment& operator=(const FilmSegment&) = delete;
  ~FilmSegment() = default;

  std::int64_t frame_count() const noexcept { return frame_count_; }
  /// @param number  within the segment, from 0 to frame_count() - 1.
  DrawList frame(std::int64_t number) const;
  /// The frame that comes furthest in time: the last one, or where a loop turns back.
  std::int64_t furthest_frame() const;
  /// As Film::require_certain().
  void require_certain(const FrameRange& frames, bool with_sound) const;

  /// The words of a segment without runs.
  const Card& card() const noexcept { return card_; }
  /// What is shown at the same time; none of a card.
  std::span<const FilmRun> runs() const noexcept { return runs_; }
  /// Where a run's picture is in the frame. @param run  its place in runs().
  PixelRect cell(std::size_t run) const;
  /// The one clock of all runs, in seconds since the segment began; none of a card.
  const Schedule* schedule() const noexcept { return schedule_ ? &*schedule_ : nullptr; }

 private:
  void show_card(const View& film, const FilmMaking& making);
  void show_one(Scene scene, const FilmMaking& making);
  void compare(const Scenes& scenes, Split split, const View& film, const FilmMaking& making);

  std::int64_t frame_count_ = 0;
  std::vector<FilmRun> runs_;
  std::optional<Schedule> schedule_;
  std::optional<SplitScreen> split_;  ///< if there are several runs
  Card card_;                         ///< if there are none
  std::function<DrawList(std::int64_t number)> card_frame_;
};

/// A segment and its place in the film.
struct PlacedSegment {
  FilmSegment segment;
  std::int64_t first_frame = 0;
  /// First frames, shared with the segment before: it fades out, then this one fades in.
  std::int64_t fade_frames = 0;

  /// The first frame of the film that shows it, and not the segment before.
  std::int64_t first_seen() const noexcept { return first_frame + (fade_frames + 1) / 2; }
};

/// Const members are thread-safe.
class Film {
 public:
  /// @throws SceneError if problems_of() the script is not empty; UsageError if a fade is
  ///         not shorter than its segments, or as FilmSegment; SimulationError, DrawError,
  ///         Interrupted
  explicit Film(const Script& script, const FilmMaking& making = {});

  const View& view() const noexcept { return view_; }
  std::int64_t frame_count() const noexcept { return frame_count_; }
  FrameRange frames() const noexcept { return {0, frame_count_ - 1}; }
  /// @param number  from 0 to frame_count() - 1.
  DrawList frame(std::int64_t number) const;
  /// Computes all runs up to the last of these frames, so that an error comes before the first one.
  /// @param with_sound  also checks earlier frames, on whose sound that of these depends
  /// @throws UsageError if a collision that these frames show is not certain
  void require_certain(const FrameRange& frames, bool with_sound) const;
  /// In the order of the film; at least one. Frame k is shown from k / frame_rate seconds on.
  std::span<const PlacedSegment> segments() const noexcept { return segments_; }
  /// The frames of a segment that a lecturer shows by itself: from the first one of its own fade to
  /// the last one before the next fade. Shots follow each other without a gap.
  FrameRange shot(std::size_t segment) const;
  /// That of a film of one scene, whose instants are those of its run; null of a storyboard.
  const FilmSegment* scene() const noexcept {
    return is_scene_ ? &segments_.front().segment : nullptr;
  }

 private:
  void add_segments(const Storyboard& story, const FilmMaking& making);
  void place_segments(const Storyboard& story);

  View view_;
  bool is_scene_ = false;
  std::vector<PlacedSegment> segments_;
  std::int64_t frame_count_ = 0;
};

/// The frame of a storyboard's film that an instant names: a time in seconds of video, or "last"
/// for the last frame, and seconds before it.
/// @throws UsageError if the film has no such frame.
std::int64_t frame_at(const Film& film, const Instant& instant);

/// The pairs of samples before a frame, to the nearest one.
inline std::int64_t samples_before(std::int64_t frame, const Rational& frame_rate) {
  const Rational samples = Rational(to_integer(frame)) / frame_rate * Soundtrack::kRate_hz;
  return floor(samples + Rational(1, 2)).get_si();
}

/// Of the soundtrack of these frames.
inline SoundFormat sound_format(const FrameRange& frames, const Rational& frame_rate) {
  return {.rate_hz = Soundtrack::kRate_hz,
          .size = samples_before(frames.last + 1, frame_rate) -
                  samples_before(frames.first, frame_rate)};
}

/// A film's soundtrack, until it is told to stop: each run of each segment at its time, and as loud
/// as its segment is seen. Cards are silent. Of a range of frames, the samples that the whole film
/// has there; if it ends before the film, they fade out, so that their end does not click.
class FilmSound final : public SampleSource {
 public:
  /// @param film        must outlive it.
  /// @param on_samples  is told how many pairs there are so far.
  FilmSound(const Film& film, const FrameRange& frames, std::stop_token stop,
            std::function<void(std::int64_t)> on_samples);

  std::size_t read(std::span<float> samples) override;
  /// From now on gives the samples of these frames, none of which is before those of the range
  /// before: what the film's samples are made of is made once.
  void begin(const FrameRange& frames);

 private:
  const Film& film_;
  Soundtrack soundtrack_;
  std::stop_token stop_;
  std::function<void(std::int64_t)> on_samples_;
  // Pairs of samples from the beginning of the film on.
  std::int64_t first_ = 0;
  std::int64_t end_ = 0;
  std::int64_t next_ = 0;
  bool is_cut_ = false;
};

}  // namespace piblocks
