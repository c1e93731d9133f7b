// What to draw: everything a scene shows, at one instant.
// In: a scene and its collision log, once; a state, for every frame. Out: a draw list.
#pragma once

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

struct FrameState {
  BlockState state;
  Rational time = 0;    ///< simulation time of the state
  Rational slower = 1;  ///< as in Stretch
  /// Where the blocks are while the frame is exposed; if empty, as all else, at the instant.
  std::vector<WeightedExposure> exposure = {};
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

  DrawList frame(const FrameState& shown) const;

 private:
  DrawList empty_;
  std::vector<Drawable> drawables_;  ///< in the order of their ids
};

}  // namespace piblocks
