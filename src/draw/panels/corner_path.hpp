// The path through the plane of both gaps, for pictures of it at any magnification.
// In: a log and a span of time. Out: the path's corners as far as a picture can tell them apart,
// and lines and filled areas of a part of the plane.
#pragma once

#include <piblocks/run.hpp>

#include <optional>
#include <vector>

#include "scene/schedule.hpp"

namespace piblocks {

/// How much of the plane is seen: 0 <= y2 <= to.
struct GapWindow {
  double to = 1;
  double least_apart = 0;  ///< red's gaps that are nearer to each other cannot be told apart
};

/// What of the path is in a window.
struct ShownPath {
  std::vector<std::vector<Gaps>> lines;
  // Between these of red's gaps the path covers the whole wedge; none if low == high.
  double filled_low = 0;
  double filled_high = 0;
};

class CornerPath {
 public:
  /// @param most_corners  of those on the way in, and on the way out; a picture so many pixels wide
  ///                      shows no more, whatever its magnification
  /// @throws SimulationError as gaps_at().
  CornerPath(const CollisionLog& log, const Span& span, int most_corners);

  /// Red's greatest and least gap.
  double most() const noexcept { return most_; }
  double least() const noexcept { return least_; }

  ShownPath shown(const GapWindow& window) const;

 private:
  struct Side {
    std::vector<Gaps> line;
    double dense_from;  ///< nearer to the corner than this the path is filled; 0 if it is not
  };
  Side side_of(const std::vector<Gaps>& corners, const GapWindow& window) const;

  // From far away to the corner.
  std::vector<Gaps> in_;
  std::vector<Gaps> out_;
  bool is_complete_ = true;  ///< no corner was left out
  double most_ = 0;
  double least_ = 0;
};

/// The magnification of the plane while red's gap is this part of the greatest one: 1, 10, 100 …,
/// and between them smooth. It grows as the gap shrinks, and the gap stays in the picture.
/// @param share  0 < share
/// @returns the power of ten, >= 0
double zoom_exponent(double share);

}  // namespace piblocks
