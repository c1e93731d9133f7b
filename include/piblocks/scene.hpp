// What is asked for: the system, the picture's frame, the span of time.
// In: plain values, filled in by hand or by script_builder.hpp. Out: everything that is wrong with
// them, and their exact text.
#pragma once

#include <piblocks/blocks.hpp>
#include <piblocks/exact.hpp>
#include <piblocks/pacing.hpp>
#include <piblocks/show.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace piblocks {

/// Closed interval in scene units, low < high.
struct Range {
  Rational low;
  Rational high;
};

/// What part of the plane a frame shows, and how many frames and pixels that takes.
struct View {
  Range x = {-1, 12};
  Range y = {-1, 1};
  int width_px = 1920;       ///< 1 … kMaxSide_px
  int height_px = 1080;      ///< 1 … kMaxSide_px
  Rational frame_rate = 60;  ///< frames per second of video, 0 < rate <= kMaxFrameRate
  /// The share of the time between two frames for which each is exposed, from its instant on,
  /// 0 … 1; 0 shows the instant alone.
  Rational shutter = 0;
  Theme theme = Theme::article;
  Background background = Background::opaque;
};

inline constexpr int kMaxFrameRate = 1000;

/// Which part of the run is shown, in simulation time.
struct TimeSpan {
  Instant from = {};
  /// An end that is a time is not shown itself: so many seconds make so many frames. An end that is
  /// named by what happens then is shown, by the first frame at it or past it.
  Instant to = Instant::last(Rational(3, 2));
  Rational speed = 1;  ///< simulation time per second of video, > 0
};

struct FrameSize {
  int width_px = 0;   ///< 1 … kMaxSide_px
  int height_px = 0;  ///< 1 … kMaxSide_px
};

/// What is kept of a scene to compare later renderings with.
struct Golden {
  /// Instants as parse_instant() takes them, each kept as a picture; hashes are kept of all frames.
  std::vector<std::string> frames = {"0", "last"};
  /// Size of all of them; without it the view's, reduced to a longer side of 480 pixels.
  std::optional<FrameSize> size = {};
};

/// What is heard of a scene.
struct Sound {
  bool on = false;  ///< whether a video has a soundtrack
};

struct Scene {
  BlockSystem system;
  View view;
  TimeSpan time;
  Pacing pacing = {};
  Sound sound = {};
  Show show = {};
  Golden golden = {};
};

/// Red's width where widths tell masses: blue's, and an eighth more for every factor of a hundred
/// in mass, from half of blue's to half as wide again, so that any ratio can be drawn.
Rational width_by_mass(const BlockSystem& system);

/// Everything that is wrong with a scene; empty if nothing is.
std::vector<Problem> problems_of(const Scene& scene);

/// Every key of the scene file with its value as exact text, in a fixed order; empty for what is
/// not set. Two scenes with equal descriptions are the same, but for what is in the files they
/// name: show.logo is a path.
std::vector<std::pair<std::string, std::string>> describe(const Scene& scene);

}  // namespace piblocks
