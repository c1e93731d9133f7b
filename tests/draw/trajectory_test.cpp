// Lines and bands of a run against its collisions, one by one.
#include "draw/panels/trajectory.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace piblocks {
namespace {

struct Traced {
  explicit Traced(int digits, const Rational& from, const Rational& to, int columns)
      : system(article_blocks(digits)),
        wedge(system),
        log(make_pair_log(system)),
        pieces(trajectory_of(*log, wedge, {from, to}, columns)) {}

  TwoBlocks system;
  GapWedge wedge;
  std::unique_ptr<PairLog> log;
  std::vector<TrajectoryPiece> pieces;
};

TEST(Trajectory, BandsCoverWhatBlueDoesAndNoMore) {
  for (const int digits : {3, 4}) {
    const Traced traced(digits, 3, 4, 40);
    int bands = 0;
    for (const TrajectoryPiece& piece : traced.pieces) {
      for (const Band& band : piece.bands) {
        ++bands;
        double low = 1e9;
        double high = 0;
        for (Integer k = 1; k <= traced.log->last(); k += 1) {
          const PairCollision collision = traced.log->blocks_collision(k);
          if (collision.time.hi < band.from.time || collision.time.hi > band.to.time) continue;
          const Gaps at = traced.wedge.gaps_of(collision.blue, collision.red);
          low = std::min(low, at.y1);
          high = std::max(high, at.y1);
        }
        EXPECT_NEAR(low, 0, 1e-12);
        EXPECT_NEAR(high, band.high, 1e-12) << "of " << digits << " digits at " << band.from.time;
      }
    }
    EXPECT_GT(bands, 5);
  }
}

TEST(Trajectory, CornersAreTheCollisions) {
  const Traced traced(2, 0, 8, 1000);
  std::vector<TimedGaps> corners;
  for (const TrajectoryPiece& piece : traced.pieces) {
    corners.insert(corners.end(), piece.corners.begin(), piece.corners.end());
  }
  for (const Integer& k : {Integer(1), Integer(2), Integer(30), Integer(31)}) {
    const PairCollision collision = traced.log->blocks_collision(k);
    const Gaps at = traced.wedge.gaps_of(collision.blue, collision.red);
    EXPECT_TRUE(std::ranges::any_of(corners, [&](const TimedGaps& corner) {
      return corner.time == collision.time.hi && corner.gaps.y1 == at.y1 && corner.gaps.y2 == at.y2;
    })) << k;
  }
}

TEST(Trajectory, PiecesJoin) {
  const Traced traced(6, 0, 8, 300);
  double time = 0;
  for (const TrajectoryPiece& piece : traced.pieces) {
    if (!piece.corners.empty()) {
      EXPECT_EQ(piece.corners.front().time, time);
      time = piece.corners.back().time;
    }
    for (const Band& band : piece.bands) {
      EXPECT_EQ(band.from.time, time);
      time = band.to.time;
    }
  }
  EXPECT_EQ(time, 8);
}

TEST(Trajectory, CostsNoMoreForMoreCollisions) {
  const Traced traced(20, 0, 8, 1000);
  std::size_t bands = 0;
  for (const TrajectoryPiece& piece : traced.pieces) bands += piece.bands.size();
  EXPECT_LE(bands, 1000U);
  EXPECT_GT(bands, 10U);
}

}  // namespace
}  // namespace piblocks
