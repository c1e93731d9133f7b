// A run over a span of time as lines that can be drawn, however many collisions it has.
// In: a log and the span, cut into columns. Out: the corners of the motion where a column has few,
// and elsewhere the band that blue's gap covers. Both are exact.
#pragma once

#include <piblocks/run.hpp>

#include <vector>

#include "draw/panels/wedge.hpp"

namespace piblocks {

struct TimedGaps {
  double time = 0;
  GapPoint gaps;
};

/// From one instant to the next, blue's gap takes all values from 0 to `high`.
struct Band {
  TimedGaps from;
  TimedGaps to;
  double high = 0;
};

/// A stretch of time: either corners, the first and last at its ends, or bands without gaps.
struct TrajectoryPiece {
  std::vector<TimedGaps> corners;
  std::vector<Band> bands;
};

struct TrajectorySpan {
  Rational from;
  Rational to;
  int columns;  ///< >= 1; columns of one pixel show all that a picture can
};

/// Pieces from one end of the span to the other.
std::vector<TrajectoryPiece> trajectory_of(const CollisionLog& log, const Wedge& wedge,
                                           const TrajectorySpan& span);

/// The greatest of red's gaps at corners and at ends of bands; at least 0.
double greatest_y2(const std::vector<TrajectoryPiece>& pieces);

}  // namespace piblocks
