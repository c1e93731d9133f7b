#include "draw/panels/trajectory.hpp"

#include <algorithm>
#include <utility>

namespace piblocks {
namespace {

/// More collisions than this between two columns are drawn as a band.
constexpr int kMostCorners = 2;

class TrajectoryBuilder {
 public:
  TrajectoryBuilder(const CollisionLog& log, const PanelGaps& gaps) : log_(log), gaps_(gaps) {}

  void begin(const Rational& time) {
    state_ = log_.state_at(time);
    time_ = to_double(time);
  }

  void run_to(const Rational& time) {
    const BlockState next = log_.state_at(time);
    const double next_time = to_double(time);
    if (next.count - state_.count > kMostCorners) {
      add_band({next_time, gaps_.of(next)}, next.count);
    } else {
      add_corners({next_time, gaps_.of(next)}, next.count);
    }
    state_ = next;
    time_ = next_time;
  }

  std::vector<TrajectoryPiece> take_pieces() { return std::move(pieces_); }

 private:
  void add_corners(const TimedGaps& end, const Integer& count) {
    if (pieces_.empty() || pieces_.back().corners.empty()) {
      pieces_.push_back({{{time_, gaps_.of(state_)}}, {}});
    }
    std::vector<TimedGaps>& corners = pieces_.back().corners;
    for (Integer k = state_.count + 1; k <= count; k += 1) {
      const Collision collision = log_.collision(k);
      corners.push_back({collision.time.hi, gaps_.of(collision.blue, collision.red)});
    }
    corners.push_back(end);
  }

  void add_band(const TimedGaps& end, const Integer& count) {
    if (pieces_.empty() || pieces_.back().bands.empty()) pieces_.push_back({});
    Band band{{time_, gaps_.of(state_)}, end, 0};
    // Between the wall and red, whose distance falls to the turn and rises again: it is largest at
    // the first contact or at the last one.
    for (const Integer& k :
         {Integer(state_.count + 1), Integer(state_.count + 2), Integer(count - 1), count}) {
      const Collision collision = log_.collision(k);
      band.high = std::max(band.high, gaps_.of(collision.blue, collision.red).y1);
    }
    pieces_.back().bands.push_back(band);
  }

  const CollisionLog& log_;
  const PanelGaps& gaps_;
  BlockState state_;
  double time_ = 0;
  std::vector<TrajectoryPiece> pieces_;
};

}  // namespace

std::vector<TrajectoryPiece> trajectory_of(const CollisionLog& log, const PanelGaps& gaps,
                                           const Rational& from, const Rational& to, int columns) {
  TrajectoryBuilder builder(log, gaps);
  builder.begin(from);
  for (int column = 1; column <= columns; ++column) {
    builder.run_to(from + (to - from) * column / columns);
  }
  return builder.take_pieces();
}

}  // namespace piblocks
