#include "draw/panels/velocity_points.hpp"

#include <algorithm>
#include <cmath>

#include "core/rounded.hpp"
#include "draw/layout.hpp"
#include "draw/panels/trajectory.hpp"

namespace piblocks {

VelocityPoints::VelocityPoints(const Scene& scene, const PairLog& log)
    : wedge_angle_(GapWedge(log.blocks()).theta), last_(log.last()) {
  const TwoBlocks& system = log.blocks();
  const Rational energy = twice_energy(log.system());
  if (energy == 0) return;
  moves_ = true;
  red_factor_ = root_of(system.red.mass / energy);
  blue_factor_ = root_of(system.blue.mass / energy);
  Point start = point_of(to_double(system.blue.velocity), to_double(system.red.velocity));
  if (log.first_index() < 1 && has_span(scene, log)) {
    const Rational from = span_of(scene, log).from;
    if (from < 0) {
      const PairState state = log.blocks_at(from);
      before_ = std::min<Integer>(state.count, 0);
      start = point_of(state.blue.velocity, state.red.velocity);
    }
  }
  start_angle_ = rounded::atan2(start.y, start.x);
  if (before_ < last_) first_ = log.blocks_collision(before_ + 1).kind;
}

std::vector<double> VelocityPoints::all_angles() const {
  std::vector<double> angles{start_angle_};
  for (Integer i = before_ + 1; i <= last_; ++i) {
    angles.push_back(reflected(angles.back(), kind_of(i)));
  }
  return angles;
}

}  // namespace piblocks
