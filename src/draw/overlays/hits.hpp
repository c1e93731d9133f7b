// Marks of hits: an arc for each, or a glow where they are too many to be told apart.
// In: a FrameState, and where bodies touch. Out: items above the lower body's edge.
#pragma once

#include <memory>
#include <vector>

#include "draw/layout.hpp"

namespace piblocks {

/// Of blocks that stand on one floor.
struct BlockDimensions {
  double floor_px = 0;
  double blue_height_px = 0;
  double red_height_px = 0;
  double blue_width_px = 0;
};

/// Where blue touches the wall, and where it touches red at present.
struct ContactPositions {
  double wall_x_px = 0;
  double blocks_x_px = 0;
};

/// Marks open into the free corner above the lower of the bodies that touch, where they cover no
/// label of a block.
class HitMarks {
 public:
  /// @param most_reach_px  how far marks may reach
  HitMarks(const DrawingContext& context, const BlockDimensions& dimensions, double most_reach_px);

  /// An arc that grows and fades. @param x_px  of the surface where they met
  void add_arc(ItemId id, const Hit& hit, double x_px, std::vector<DrawItem>& items) const;
  /// A steady light at both contacts. Nothing if hits are few.
  void add_glow(double hits_per_s, const ContactPositions& contacts,
                std::vector<DrawItem>& items) const;

  /// @param x_of  the x_px of a hit
  template <typename XOf>
  void add(const FrameState& shown, const ContactPositions& contacts, const XOf& x_of,
           std::vector<DrawItem>& items) const {
    for (std::size_t n = 0; n < shown.hits.size(); ++n) {
      add_arc(nth(ItemId::hits, n), shown.hits[n], x_of(shown.hits[n]), items);
    }
    add_glow(shown.hits_per_s, contacts, items);
  }

 private:
  /// Where a mark is drawn: the free corner between two bodies, as directions from their contact.
  struct MarkSector {
    double y_px = 0;
    std::vector<Point> directions;  ///< of length 1, counter-clockwise
    Color color;
    /// By strength, from the weakest, around a contact at x = 0.
    std::vector<std::shared_ptr<const Plate>> glows;
  };

  const MarkSector& sector_of(const Hit& hit) const { return hit.second == 2 ? wall_ : blocks_; }
  void set_glows(MarkSector& sector) const;

  double reach_px_;  ///< of arcs
  double glow_px_;   ///< and of glows, which do not meet above a narrow block
  double line_px_;
  MarkSector wall_;
  MarkSector blocks_;
};

/// The marks of the stage.
Drawable hit_marks(const DrawingContext& context);

}  // namespace piblocks
