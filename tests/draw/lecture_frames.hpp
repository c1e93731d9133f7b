// Frames of a scene, and what is found in them.
// In: settings of a scene. Out: draw lists, and their items by what they show.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "draw/composed_pictures.hpp"
#include "render/frame_state.hpp"
#include "scene/schedule.hpp"

namespace piblocks {

class Frames {
 public:
  explicit Frames(const Settings& settings) : Frames(scene_with(settings)) {}
  explicit Frames(Scene scene)
      : scene_(std::move(scene)), log_(make_log(scene_.system)), composition_(scene_, *log_) {}

  const Scene& scene() const { return scene_; }
  const Log& log() const { return *log_; }
  Rational turn() const { return turn_of(*two_blocks_of(scene_.system)).value(); }

  FrameState state(const FrameTime& shown) const {
    return frame_state(*log_, shown, composition_.needs(), scene_.time.speed);
  }
  DrawList at(const Rational& time) const { return composition_.frame(state({time})); }
  DrawList of(const FrameState& state) const { return composition_.frame(state); }
  /// A frame of the film, with its hits.
  FrameState film_state(const Schedule& schedule, std::int64_t number) const {
    const Rational video_s = Rational(number) / scene_.view.frame_rate;
    return frame_state(*log_, schedule.at(video_s), composition_.needs(), scene_.time.speed,
                       VideoTime{schedule, video_s});
  }

 private:
  Scene scene_;
  std::unique_ptr<Log> log_;
  Composition composition_;
};

/// What the loupe shows, in pixels of its inset.
struct SeenLoupe {
  Rect bounds;  ///< in the frame
  double opacity = 0;
  double face = 0;   ///< of the wall
  Rect blue;         ///< the block in between, or a block that keeps its place
  Rect red;          ///< the outer block
  std::string zoom;  ///< the label of the zoom up to its power of ten; empty if there is none
  DrawList list;
};

inline std::optional<SeenLoupe> loupe_in(const DrawList& frame) {
  const auto groups = items_of<GroupItem>(frame.items, ItemId::loupe);
  if (groups.empty()) return std::nullopt;
  const GroupItem& group = groups.front();
  SeenLoupe seen{group.bounds, group.opacity, 0, {}, {}, {}, *group.list};
  const PlateItem scenery = items_of<PlateItem>(seen.list.items, ItemId::wall).front();
  for (const auto& line : items_of<RectangleItem>(scenery.plate->items, ItemId::wall)) {
    const Rect& bounds = line.bounds;
    // A wall on the right has its bodies on the left.
    const bool is_right = bounds.x > group.bounds.width / 2;
    if (bounds.height > bounds.width) seen.face = is_right ? bounds.x : bounds.right();
  }
  const auto blue = items_of<RectangleItem>(seen.list.items, ItemId::blue_block);
  const auto anchor = items_of<RectangleItem>(seen.list.items, ItemId::wall);
  if (!anchor.empty()) seen.blue = anchor.front().bounds;
  if (!blue.empty()) seen.blue = blue.front().bounds;
  seen.red = items_of<RectangleItem>(seen.list.items, ItemId::red_block).front().bounds;
  const auto zooms = items_of<TextItem>(frame.items, ItemId::loupe);
  if (!zooms.empty()) seen.zoom = zooms.front().text;
  return seen;
}

// Of the loupe's tests.
inline Settings lecture(int digits, const char* size = "1280x720") {
  return {{"digits", std::to_string(digits)}, {"view.theme", "lecture"}, {"view.size", size}};
}

inline double pixels_per_unit(const DrawList& frame, const Scene& scene) {
  const auto blue = items_of<RectangleItem>(frame.items, ItemId::blue_block).front();
  return blue.bounds.width / to_double(scene.system.bodies[0].size);
}

}  // namespace piblocks
