// One run on its way to a film: a scene, its collisions, and how its frames look.
// In: a scene, and what a frame shows of time. Out: the draw list of the frame.
#pragma once

#include <piblocks/image.hpp>
#include <piblocks/run.hpp>
#include <piblocks/scene.hpp>
#include <piblocks/script.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "draw/composition.hpp"
#include "scene/schedule.hpp"

namespace piblocks {

/// What a film is made for. For its sound alone nothing is laid out, and frame() must not be
/// called.
enum class FilmUse : std::uint8_t { pictures, audio_only };

/// A scene, its collisions, and what its frames are composed by. Const members are thread-safe.
class FilmRun {
 public:
  /// @param log  of the scene's system.
  /// @throws UsageError, DrawError, MediaError as Composition and read_logo().
  FilmRun(Scene scene, std::unique_ptr<CollisionLog> log, FilmUse use);

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

/// Nothing if the scene shows none.
/// @throws UsageError, MediaError if the file cannot be read, or is no PNG.
std::shared_ptr<const Image> read_logo(const Scene& scene);

/// The files of all logos of a scene or storyboard.
std::vector<std::string> logos_of(const Script& script);

/// Empty without a shutter.
std::vector<WeightedExposure> exposures_of(const CollisionLog& log,
                                           std::span<const TimeSlice> slices);

}  // namespace piblocks
