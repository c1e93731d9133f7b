// What a picture shows beside the blocks, and in which colours.
// In: names of a scene file or an option. Out: plain values; drawing gives them their form.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace piblocks {

enum class Theme {
  article,     ///< on white, as in the article
  chalkboard,  ///< chalk on dark green
  dark,        ///< on near-black
  print,       ///< black and greys; the blocks differ in pattern
  colorblind   ///< blue and orange that all can tell apart, and that differ in pattern
};

/// What is behind everything: the theme's colour, or nothing, so that another picture can be put
/// there.
enum class Background { opaque, transparent };

/// What is drawn over and around the blocks.
enum class Overlay {
  digits,      ///< the counter's digits light up when they are those of pi
  masses,      ///< each block's mass, on it
  velocities,  ///< an arrow above each block, and its velocity
  energy,      ///< kinetic energy of each block, and their sum
  momentum,    ///< momentum of each block, and their sum
  time,        ///< simulation time
  ruler        ///< a scale of positions below the blocks
};

/// Diagrams beside the blocks, in step with them.
enum class Panel {
  velocity,  ///< circle of (sqrt(m_red) v_red, sqrt(m_blue) v_blue) with each collision's sector
  position,  ///< path in the plane of both gaps, in the wedge between wall and contact
  unfolded,  ///< the wedge reflected again and again, and the straight line through it
  time,      ///< positions against time
  rate       ///< collisions per second against time
};

struct Show {
  std::vector<Overlay> overlays = {};
  std::vector<Panel> panels = {};  ///< in this order
  std::string title = {};          ///< one line of UTF-8 above all
  std::string caption = {};        ///< one line of UTF-8 below all
  std::string logo = {};           ///< a PNG file for the corner that is kept free for it

  bool has(Overlay overlay) const noexcept;
};

/// Longest title or caption.
inline constexpr std::size_t kMaxLine_bytes = 1000;

/// @throws UsageError that lists the names there are.
Theme parse_theme(std::string_view name);
Overlay parse_overlay(std::string_view name);
Panel parse_panel(std::string_view name);

std::string exact_text(Theme theme);
std::string exact_text(Overlay overlay);
std::string exact_text(Panel panel);

/// All names, with commas, for messages and help.
std::string theme_names();
std::string overlay_names();
std::string panel_names();

}  // namespace piblocks
