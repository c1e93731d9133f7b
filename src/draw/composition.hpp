// What to draw: everything a scene shows, at one instant.
// In: a scene and its collision log, once; a state, for every frame. Out: a draw list.
#pragma once

#include <piblocks/bodies.hpp>
#include <piblocks/run.hpp>
#include <piblocks/scene.hpp>

#include <functional>
#include <memory>
#include <vector>

#include "draw/draw_list.hpp"
#include "physics/exposure.hpp"

namespace piblocks {

/// An interval of the time for which a frame is exposed, and its share of that time.
struct WeightedExposure {
  double share = 1;  ///< the shares of a frame add up to 1
  Exposure exposure;
};

/// The same of a scene with bodies.
struct WeightedBodyExposure {
  double share = 1;
  BodyExposure exposure;
};

/// How long a hit is seen, in seconds of video.
inline constexpr double kHitLife_s = 0.15;
/// Most collisions per second of video that are listed as hits.
inline constexpr int kMaxHitsPerSecond = 8;

/// A collision that the picture has just passed.
struct Hit {
  CollisionKind kind = CollisionKind::blocks;
  Integer index;
  double contact = 0;  ///< scene x of the surface where they met: the wall's face or blue's side
  double age_s = 0;    ///< of video since the picture passed it, 0 <= age_s < kHitLife_s
  Gaps gaps = {};      ///< then; if kind is blocks, y1 = y2 is where they met, seen from the wall
};

/// What a frame is drawn from. It depends on nothing but the frame.
struct FrameState {
  BlockState state;       ///< of bodies the count alone
  Rational time = 0;      ///< simulation time of the state
  Rational slowdown = 1;  ///< as in Stretch
  /// Where the blocks are while the frame is exposed; if empty, as all else, at the instant.
  std::vector<WeightedExposure> exposure = {};
  Gaps gaps = {};                       ///< of the state; filled in if FrameNeeds asks for them
  std::vector<BodyMotion> bodies = {};  ///< if the scene has any
  /// Where the bodies are while the frame is exposed; if empty, at the instant.
  std::vector<WeightedBodyExposure> body_exposure = {};
  /// Where each body has been lately, in the order of time; filled in if FrameNeeds asks for it.
  std::vector<std::vector<PathPoint>> trails = {};

  // Left alone in a still that is not in its video, or if no drawable reads them.
  double video_s = 0;          ///< of the frame, since its scene began
  std::vector<Hit> hits = {};  ///< oldest first; none if hits_per_s was above kMaxHitsPerSecond
  double hits_per_s = 0;       ///< of video, lately; 0 while the picture stands still
};

/// The costly parts of a FrameState. They are computed only for drawables that read them.
struct FrameNeeds {
  bool gaps = false;
  bool hits = false;  ///< and hits_per_s
  bool trails = false;
  bool video_s = false;  ///< in stills too, which have to look it up
};

/// Appends the items of one thing, such as an overlay, in the order of their ids. Thread-safe.
using Drawable = std::function<void(const FrameState& shown, std::vector<DrawItem>& items)>;

/// The layout and all that does not move, as far as the scene asks for it. The log is read only
/// while it is made. Const members are thread-safe.
class Composition {
 public:
  /// @param logo  the picture that scene.show.logo names, if it does.
  /// @throws UsageError if something the scene asks for cannot be shown, such as an unknown glyph,
  ///         a line too long, a panel too small to be read; DrawError if the font cannot be loaded.
  Composition(const Scene& scene, const CollisionLog& log,
              std::shared_ptr<const Image> logo = nullptr);
  /// The same of a scene with bodies.
  Composition(const Scene& scene, const Log& log, std::shared_ptr<const Image> logo = nullptr);

  DrawList frame(const FrameState& shown) const;
  /// What frame() reads of a FrameState beside what is always there.
  const FrameNeeds& needs() const noexcept { return needs_; }

 private:
  DrawList empty_;
  FrameNeeds needs_;                 ///< set by drawables while they are made
  std::vector<Drawable> drawables_;  ///< in the order of their ids
};

}  // namespace piblocks
