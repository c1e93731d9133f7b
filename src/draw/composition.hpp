// What to draw: everything a scene shows, at one instant.
// In: a scene and its collision log, once; a state, for every frame. Out: a draw list.
#pragma once

#include <piblocks/scene.hpp>
#include <piblocks/two_blocks.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
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

/// How long a hit is seen, in seconds of video.
inline constexpr double kHitLife_s = 0.15;
/// Most collisions per second of video that are listed as hits.
inline constexpr int kMaxHitsPerSecond = 8;

/// Places of two bodies in System; or of a body, and the number of bodies plus the place of a
/// wall.
using MetPair = std::array<std::uint32_t, 2>;

/// A collision that the picture has just passed.
struct Hit {
  Integer index;
  MetPair pair = {};
  std::array<double, 2> contact = {};  ///< where their surfaces met, in the scene
  double age_s = 0;  ///< of video since the picture passed it, 0 <= age_s < kHitLife_s
  /// At the hit, for two blocks beside a wall. If the blocks met, the contact is at y1 = y2.
  Gaps gaps = {};
};

/// What a frame is drawn from. It depends on nothing but the frame.
struct FrameState {
  State state;
  Rational time = 0;      ///< simulation time of the state
  Rational slowdown = 1;  ///< as in Stretch
  double pace = 0;        ///< simulation time per second of video, unless that stands still
  /// Where the bodies are while the frame is exposed; if empty, at the instant.
  std::vector<WeightedExposure> exposure = {};
  Gaps gaps = {};  ///< of two blocks beside a wall; filled in if FrameNeeds asks for them
  /// Where each body has been, in the order of time; filled in as far as FrameNeeds asks for it.
  std::vector<std::vector<PathPoint>> trails = {};

  /// What another moment of the video is drawn from, so many seconds from this one; the first or
  /// the last if the video ends before. It has the time and the state; with FrameNeeds::gaps, only
  /// the bound of y2 in place of the state. Empty for a still outside of its video, or unless
  /// FrameNeeds asks for it. Valid as long as log and video are.
  std::function<FrameState(double from_now_s)> moment = {};

  // Not filled in for a still outside of its video, or if no drawable reads them.
  double video_s = 0;          ///< of the frame, since its scene began
  std::vector<Hit> hits = {};  ///< oldest first; none if hits_per_s was above kMaxHitsPerSecond
  double hits_per_s = 0;       ///< of video, lately; 0 while the picture stands still
  std::vector<MetPair> met_pairs = {};  ///< lately, if hits_per_s is above kMaxHitsPerSecond
};

/// The costly parts of a FrameState. They are computed only for drawables that read them.
struct FrameNeeds {
  bool gaps = false;
  bool moments = false;
  bool hits = false;     ///< and hits_per_s
  int trail_s = 0;       ///< of video at its usual speed that trails go back; 0 for none
  bool video_s = false;  ///< in stills too, which have to look it up
  std::vector<std::size_t> paths = {};  ///< bodies whose trails go back to time 0

  FrameNeeds& operator|=(const FrameNeeds& more) {
    gaps |= more.gaps;
    moments |= more.moments;
    hits |= more.hits;
    trail_s = std::max(trail_s, more.trail_s);
    video_s |= more.video_s;
    paths.insert(paths.end(), more.paths.begin(), more.paths.end());
    return *this;
  }
};

/// One thing that is shown, such as an overlay.
struct Drawable {
  /// Appends its items in the order of their ids. Thread-safe.
  std::function<void(const FrameState& shown, std::vector<DrawItem>& items)> add;
  FrameNeeds needs = {};  ///< what it reads of a FrameState beside what is always there
};

struct Layout;

/// The layout and all that does not move, as far as the scene asks for it. The log is read only
/// while it is made. Const members are thread-safe.
class Composition {
 public:
  /// @param logo  the picture that scene.show.logo names, if it does.
  /// @throws UsageError if something the scene asks for cannot be shown, such as an unknown glyph,
  ///         a line too long, a panel too small to be read; DrawError if the font cannot be loaded.
  Composition(const Scene& scene, const Log& log, std::shared_ptr<const Image> logo = nullptr);

  DrawList frame(const FrameState& shown) const;
  /// What frame() reads of a FrameState beside what is always there.
  const FrameNeeds& needs() const noexcept { return needs_; }
  /// Where the bodies are in the frame.
  const Layout& layout() const noexcept { return *layout_; }

 private:
  DrawList empty_;
  std::shared_ptr<const Layout> layout_;
  std::vector<Drawable> drawables_;  ///< in the order of their ids
  FrameNeeds needs_;                 ///< of all of them
};

}  // namespace piblocks
