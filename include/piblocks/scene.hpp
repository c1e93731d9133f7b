// A scene: the blocks, what part of space and time is shown, how, and what is heard.
// In: plain values, filled in by hand or by ScriptBuilder (script.hpp). Out: everything that is
// wrong with them, and their exact text.
#pragma once

#include <piblocks/exact.hpp>
#include <piblocks/instant.hpp>
#include <piblocks/system.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace piblocks {

enum class Theme {
  article,        ///< on white, the article's own picture
  lecture,        ///< for a lecture hall: on near-black, in the colours of the diagrams
  lecture_light,  ///< the same on near-white
  chalkboard,     ///< chalk on dark green
  dark,           ///< on neutral dark grey
  print,          ///< black and greys; the blocks differ in pattern
  colorblind      ///< blue and orange that all can tell apart, and that differ in pattern
};

constexpr bool is_lecture(Theme theme) {
  return theme == Theme::lecture || theme == Theme::lecture_light;
}

/// What is behind everything: the scene's colour or else the theme's, or nothing.
enum class Background { opaque, transparent };

/// Red, green and blue of sRGB.
using RgbColor = std::array<std::uint8_t, 3>;

/// Colours of the scene's own. Those that are not set follow from background and ink if one of them
/// is set, and are the theme's otherwise.
struct Colors {
  std::optional<RgbColor> background = {};  ///< only where View::background is opaque
  std::optional<RgbColor> ink = {};         ///< text, walls and floor
  std::optional<RgbColor> accent = {};      ///< what is lit or marks the present
  std::optional<RgbColor> muted = {};       ///< labels
  std::optional<RgbColor> done = {};        ///< what says that no more collisions come
  std::optional<RgbColor> grid = {};        ///< axes and rays
};

/// Reads "#1f77b4". @throws UsageError
RgbColor parse_color(std::string_view text);
std::string exact_text(const RgbColor& color);

/// What is drawn over and around the blocks.
enum class Overlay {
  digits,      ///< the counter's digits light up when they are those of pi
  masses,      ///< each block's mass, on it
  velocities,  ///< an arrow above each block, and its velocity
  energy,      ///< kinetic energy of each block, and their sum
  momentum,    ///< momentum of each block, and their sum
  time,        ///< simulation time
  ruler,       ///< a scale of positions below the blocks
  trails,      ///< where discs have been lately
  angles       ///< the angle between two walls of discs, where they meet
};

/// Diagrams below the blocks, in step with them.
enum class Panel {
  velocity,      ///< circle of (sqrt(m_red) v_red, sqrt(m_blue) v_blue) with each collision's chord
  position,      ///< path in the plane of both gaps, in the wedge between wall and contact
  unfolded,      ///< the wedge reflected again and again, and the straight line through it
  time,          ///< both gaps, or the positions of all blocks, against time
  count,         ///< collisions so far against time
  ellipse,       ///< ellipse of (v_red, v_blue), which becomes the circle of `velocity`
  mirrors,       ///< as unfolded, with wedges that unfold one by one
  conservation,  ///< bars of energy and momentum, the wall's share included
  certainty,     ///< how near the count comes to a wrong digit of pi
  speeds,        ///< of many bodies, beside Maxwell's distribution
  separation     ///< squared distance of two discs against time
};

/// A window of simulation time in which the loupe enlarges by a given factor.
struct LoupeWindow {
  Instant from;
  Instant to;
  Rational zoom;  ///< > 1
};

/// An inset that enlarges a gap of blocks on a line: of two blocks beside something immovable the
/// gap between that and red; of others the one that closes first in its window.
struct Loupe {
  bool is_on = true;
  /// As wide as most of the frame, above blocks that are a low strip: for what is about the turn.
  bool is_stage = false;
  /// Without a window it is seen wherever the gap is small, and enlarges by powers of ten. Other
  /// blocks than two beside something immovable need one.
  std::optional<LoupeWindow> window = {};
};

/// Reads "auto", "stage", "off", or "FROM:TO:ZOOM", as "turn-0.01:turn+0.01:100". @throws
/// UsageError
Loupe parse_loupe(std::string_view text);
/// Exact text, which reads back as the same.
std::string exact_text(const Loupe& loupe);

struct Show {
  /// Nothing: those of the theme; see overlays_of().
  std::optional<std::vector<Overlay>> overlays = {};
  std::vector<Panel> panels = {};  ///< in this order
  std::string title = {};          ///< one line of UTF-8 above all
  std::string caption = {};        ///< one line of UTF-8 below all
  std::string logo = {};           ///< a PNG file for the corner that is kept free for it
  int base = kUsualBase;           ///< of the counts in the picture, kMinBase … kMaxBase
  bool hits = true;                ///< marks where bodies hit; none in Theme::article
  /// Nothing: on in the lecture themes, off in the others.
  std::optional<Loupe> loupe = {};

  /// Whether the scene lists it.
  bool has(Overlay overlay) const noexcept;
};

/// Longest title or caption.
inline constexpr std::size_t kMaxLine_bytes = 1000;

/// @throws UsageError that lists the names there are.
Theme parse_theme(std::string_view name);
Contacts parse_contacts(std::string_view name);
Overlay parse_overlay(std::string_view name);
Panel parse_panel(std::string_view name);
std::string exact_text(Theme theme);
std::string exact_text(Contacts contacts);
std::string exact_text(Overlay overlay);
std::string exact_text(Panel panel);
/// All names, with commas, for messages and help.
std::string theme_names();
std::string overlay_names();
std::string panel_names();

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
  /// Type, lines and margins are fractions of this length. 0 stands for the shorter side of the
  /// frame. In a row of a split screen it is the shorter side of the whole film.
  int short_side_px = 0;
  Theme theme = Theme::lecture_light;
  Background background = Background::opaque;
  Colors colors = {};
};

inline constexpr int kMaxFrameRate = 1000;

/// Which part of the run is shown, in simulation time.
struct TimeSpan {
  Instant from = {};
  /// An end that is a time is not shown itself unless it is held, so that two seconds have 120
  /// frames at 60 per second. An end at a turn or a collision is shown by the last frame. No frame
  /// shows a later time.
  Instant to = Instant::last(Rational(3, 2));
  Rational speed = 1;  ///< simulation time per second of video, > 0
  /// Whether bodies are also shown where double precision cannot tell any more which of them
  /// collide next. The picture says so then.
  bool allow_uncertain = false;
};

/// A window of simulation time that takes `factor` times as long as it would.
struct SlowMotion {
  Instant from;
  Instant to;
  Rational factor = 1;  ///< > 0
};

/// The picture stands still at an instant.
struct Freeze {
  Instant at;
  Rational length_s;  ///< of video, > 0
};

/// The slowest that automatic slow motion becomes: slower still, nothing would move by a pixel.
inline constexpr int kMaxAutomaticFactor = 1000;

/// Lengths are seconds of video, and are rounded up to whole frames; that of a loop to an even
/// number of them.
struct Pacing {
  /// Length of the whole video with holds and freezes. It sets the speed; TimeSpan::speed is
  /// ignored.
  std::optional<Rational> duration_s = {};
  /// Windows around the turn (of bodies, and with restitution below 1, around the densest
  /// collisions), each ten times slower than the one around it, until single collisions can be told
  /// apart or kMaxAutomaticFactor is reached. With a duration they are those of speed 1, and scale
  /// with the rest of the video.
  bool automatic_slow_motion = false;
  std::vector<SlowMotion> slow_motion = {};
  /// How long slow motion takes to set in and to end, 0 … kMaxEase_s; 0 is abrupt. The time is
  /// taken from the faster side, so that a window keeps its factor from beginning to end; where
  /// there is too little of it, the ease is shorter. It is not rounded. A duration scales it.
  Rational ease_s = Rational(1, 2);
  std::vector<Freeze> freezes = {};
  Rational hold_start_s = 0;  ///< how long the first picture stands still, >= 0
  Rational hold_end_s = 0;    ///< the same of the last
  /// Plays forwards and then backwards, so that the first frame follows the last without a jump.
  bool loop = false;
};

inline constexpr int kMaxEase_s = 5;

/// Most windows of slow motion, and most freezes, of one scene.
inline constexpr std::size_t kMaxWindows = 1000;

/// Reads "FROM:TO:FACTOR", as "turn-0.3:turn+0.3:10". @throws UsageError
SlowMotion parse_slow_motion(std::string_view text);
/// Reads "AT:SECONDS", as "turn:2". @throws UsageError
Freeze parse_freeze(std::string_view text);
/// Exact text, which reads back as the same.
std::string exact_text(const SlowMotion& window);
std::string exact_text(const Freeze& freeze);

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

struct Sound {
  bool on = false;  ///< whether a video has a soundtrack
};

/// How a body is drawn.
struct BodyStyle {
  std::optional<RgbColor> color = {};  ///< else the theme's
  std::string label = {};              ///< one line of UTF-8, on it or above it
  bool path = false;                   ///< of a disc: shows its path since time 0
};

struct Scene {
  System system = article_system(3);
  std::vector<BodyStyle> styles = {{}, {}};  ///< one for each body
  View view;
  TimeSpan time;
  Pacing pacing = {};
  Sound sound = {};
  Show show = {};
  Golden golden = {};
};

/// The overlays that a scene lists. Without a list, the lecture themes show the masses of up to
/// twelve blocks on a line, where all of them have room. All themes but the article's then also
/// show the digits of pi, of a scene that counts them.
std::vector<Overlay> overlays_of(const Scene& scene);

/// Red's width where widths tell masses: blue's, and an eighth more for every factor of a hundred
/// in mass, from half of blue's to half as wide again, so that any ratio can be drawn.
Rational width_by_mass(const Body& blue, const Body& red);

/// Everything that is wrong with a scene; empty if nothing is.
std::vector<Problem> problems_of(const Scene& scene);

/// Every key of the scene file with its value as exact text, in a fixed order; empty for what is
/// not set. Two scenes with equal descriptions are the same, except for the contents of the file
/// show.logo.
std::vector<std::pair<std::string, std::string>> describe(const Scene& scene);

}  // namespace piblocks
