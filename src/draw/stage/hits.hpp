// Marks of hits: an arc for each, or a glow where they are too many to be told apart.
// In: a FrameState, and where bodies touch. Out: items above the lower body's edge.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "draw/layout.hpp"

namespace piblocks {

/// Where two bodies of a line touch, and the free corner above the lower of them: marks open into
/// it, where they cover no label of a block. In a plane nothing is free, and marks are rings.
struct Contact {
  Point at;  ///< of the lower one's upper edge
  bool is_left_free = false;
  bool is_right_free = false;
  Color color;
};

/// @param left_px, right_px  heights of what touches; infinite for a wall
Contact contact_of(double x_px, double floor_px, double left_px, double right_px,
                   const Color& color);

/// The line colour of the second body; of the first if the second is immovable or a wall.
Color color_of_hit(const MetPair& pair, const System& system,
                   const std::vector<BlockColors>& colors);

class HitMarks {
 public:
  /// @param most_reach_px   how far marks may reach
  /// @param most_glow_px    and glows, which must not meet above a narrow block
  HitMarks(const DrawingContext& context, double most_reach_px, double most_glow_px);

  /// An arc that grows and fades. At first it flashes. @param n  of the hits that are seen
  void add_arc(std::size_t n, double age_s, const Contact& contact,
               std::vector<DrawItem>& items) const;
  /// The edges of two blocks that have met, while their arc flashes. @param left, right  nothing
  /// for a wall, whose face has the color of the flash
  void add_edges(std::size_t n, double age_s, const std::optional<Rect>& left,
                 const std::optional<Rect>& right, std::vector<DrawItem>& items) const;
  /// A steady light at contacts. Nothing if hits are few.
  void add_glow(double hits_per_s, std::span<const Contact> contacts,
                std::vector<DrawItem>& items) const;

 private:
  bool is_flash(double age_s) const;

  double reach_px_;  ///< of arcs
  double glow_px_;   ///< and of glows
  double line_px_;
  double corner_px_;
  double frames_per_s_;
  Color flash_;
};

/// The marks of the stage.
Drawable hit_marks(const DrawingContext& context);

}  // namespace piblocks
