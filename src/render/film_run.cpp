#include "render/film_run.hpp"

#include <utility>

#include "media/png/png_reader.hpp"
#include "physics/exposure.hpp"

namespace piblocks {

FilmRun::FilmRun(Scene scene, std::unique_ptr<CollisionLog> log, FilmUse use)
    : scene_(std::move(scene)), log_(std::move(log)) {
  if (use == FilmUse::pictures) composition_.emplace(scene_, *log_, read_logo(scene_));
}

DrawList FilmRun::picture(const FrameTime& shown) const {
  return composition_->frame(
      {log_->state_at(shown.time), shown.time, shown.slower, exposures_of(*log_, shown.exposure)});
}

std::shared_ptr<const Image> read_logo(const Scene& scene) {
  if (scene.show.logo.empty()) return nullptr;
  return std::make_shared<const Image>(read_png(scene.show.logo));
}

std::vector<std::string> logos_of(const Script& script) {
  std::vector<std::string> logos;
  const auto add = [&](const Scene& scene) {
    if (!scene.show.logo.empty()) logos.push_back(scene.show.logo);
  };
  if (const auto* const scene = std::get_if<Scene>(&script)) {
    add(*scene);
    return logos;
  }
  for (const Segment& segment : std::get<Storyboard>(script).segments) {
    if (const auto* const runs = std::get_if<Runs>(&segment.content)) {
      for (const Scene& run : *runs) add(run);
    }
  }
  return logos;
}

std::vector<WeightedExposure> exposures_of(const CollisionLog& log,
                                           std::span<const TimeSlice> slices) {
  std::vector<WeightedExposure> parts;
  parts.reserve(slices.size());
  for (const TimeSlice& slice : slices) {
    parts.push_back({to_double(slice.share), expose(log, slice.from, slice.to)});
  }
  return parts;
}

}  // namespace piblocks
