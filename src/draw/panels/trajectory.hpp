// A run over a span of time as lines that can be drawn, however many collisions it has.
// In: a log and the span, cut into columns. Out: corners of the motion where there are few in a
// column, and what blue's gap covers where there are more: exactly, in either case.
#pragma once

#include <piblocks/run.hpp>

#include <vector>

#include "draw/panels/gaps.hpp"

namespace piblocks {

struct TimedGaps {
  double time = 0;
  GapPoint gaps;
};

/// What blue's gap covers from one instant to the next: all from the wall to `high`.
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
  int columns;  ///< >= 1; of one pixel, they show every line that a picture can
};

/// Pieces from one end of the span to the other.
std::vector<TrajectoryPiece> trajectory_of(const CollisionLog& log, const PanelGaps& gaps,
                                           const TrajectorySpan& span);

/// The greatest of red's gaps at corners and at ends of bands; at least 0.
double greatest_y2(const std::vector<TrajectoryPiece>& pieces);

}  // namespace piblocks
