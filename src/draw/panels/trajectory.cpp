#include "draw/panels/trajectory.hpp"

#include <algorithm>

namespace piblocks {
namespace {

/// More collisions than this in a column are drawn as a band.
constexpr int kMostCorners = 2;

struct Column {
  TimedGaps from;
  TimedGaps to;
  Integer first;  ///< of its collisions
  Integer last;
};

Gaps gaps_at(const PairCollision& collision, const GapWedge& wedge) {
  return wedge.gaps_of(collision.blue, collision.red);
}

void add_corners(const Column& column, const PairLog& log, const GapWedge& wedge,
                 std::vector<TrajectoryPiece>& pieces) {
  if (pieces.empty() || pieces.back().corners.empty()) pieces.push_back({{column.from}, {}});
  std::vector<TimedGaps>& corners = pieces.back().corners;
  for (Integer k = column.first; k <= column.last; k += 1) {
    const PairCollision collision = log.blocks_collision(k);
    corners.push_back({collision.time.hi, gaps_at(collision, wedge)});
  }
  corners.push_back(column.to);
}

void add_band(const Column& column, const PairLog& log, const GapWedge& wedge,
              std::vector<TrajectoryPiece>& pieces) {
  if (pieces.empty() || pieces.back().bands.empty()) pieces.push_back({});
  Band band{column.from, column.to, 0};
  // Blue is between the wall and red, whose distance falls to the turn and rises again: it is
  // farthest from the wall at the first contact or at the last one.
  for (const Integer& k :
       {column.first, Integer(column.first + 1), Integer(column.last - 1), column.last}) {
    band.high = std::max(band.high, gaps_at(log.blocks_collision(k), wedge).y1);
  }
  pieces.back().bands.push_back(band);
}

}  // namespace

std::vector<TrajectoryPiece> trajectory_of(const PairLog& log, const GapWedge& wedge,
                                           const Span& span, int columns) {
  std::vector<TrajectoryPiece> pieces;
  PairState state = log.blocks_at(span.from);
  TimedGaps from{to_double(span.from), wedge.gaps_of(state)};
  for (int i = 1; i <= columns; ++i) {
    const Rational time = span.from + (span.to - span.from) * i / columns;
    const PairState next = log.blocks_at(time);
    const TimedGaps to{to_double(time), wedge.gaps_of(next)};
    const bool is_dense = next.count - state.count > kMostCorners;
    const auto add = is_dense ? add_band : add_corners;
    add({from, to, state.count + 1, next.count}, log, wedge, pieces);
    state = next;
    from = to;
  }
  return pieces;
}

double greatest_y2(const std::vector<TrajectoryPiece>& pieces) {
  double greatest = 0;
  for (const TrajectoryPiece& piece : pieces) {
    for (const TimedGaps& corner : piece.corners) greatest = std::max(greatest, corner.gaps.y2);
    for (const Band& band : piece.bands) {
      greatest = std::max({greatest, band.from.gaps.y2, band.to.gaps.y2});
    }
  }
  return greatest;
}

}  // namespace piblocks
