// The wedge that a system moves in, and its path there over a span of time.
// In: a system and its log. Out: gaps of states, and lines to draw for any number of collisions.
#pragma once

#include <piblocks/two_blocks.hpp>

#include <vector>

#include "core/rounded.hpp"
#include "draw/number_text.hpp"
#include "scene/schedule.hpp"

namespace piblocks {

/// The wedge 0 <= y1 <= y2 in which the gaps stay, in scaled units.
struct GapWedge {
  explicit GapWedge(const TwoBlocks& system)
      : blue_offset(to_double(system.wall_face + system.blue.width / 2)),
        red_offset(to_double(system.wall_face + system.blue.width + system.red.width / 2)),
        sine(root_of(system.blue.mass / (system.blue.mass + system.red.mass)).get_d()),
        cosine(root_of(system.red.mass / (system.blue.mass + system.red.mass)).get_d()),
        theta(rounded::atan2(sine, cosine)),
        tangent(root_magnitude_of(system.blue.mass / system.red.mass)) {}

  /// The gaps of these positions, with the rounding of positions: not as exact as gaps_at().
  Gaps gaps_of(const BlockMotion& blue, const BlockMotion& red) const {
    return {blue.position - blue_offset, red.position - red_offset};
  }
  Gaps gaps_of(const PairState& state) const { return gaps_of(state.blue, state.red); }

  /// So many times the wedge angle, which alone may be below the range of a double.
  double angle(const Magnitude& times) const {
    if (theta > kNarrow) return theta * to_double(times);
    return to_double(
        Magnitude{tangent.mantissa * times.mantissa, tangent.exponent + times.exponent});
  }
  Magnitude theta_magnitude() const {
    return theta > kNarrow ? magnitude_of(Rational(theta)) : tangent;
  }

  double blue_offset;
  double red_offset;
  // Of the wedge angle theta = atan(sqrt(m_blue / m_red)). Sine and cosine are square roots of the
  // blocks' shares of the mass, which unlike their ratio are never too large for a double.
  double sine;
  double cosine;
  double theta;  ///< 0 where it is below the range of a double
  Magnitude tangent;

 private:
  /// Below this, atan(s) = s with a relative error of s^2/3.
  static constexpr double kNarrow = 1e-7;
};

struct TimedGaps {
  double time = 0;
  Gaps gaps;
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

/// Pieces from one end of the span to the other.
/// @param columns  >= 1; columns of one pixel show all that a picture can
std::vector<TrajectoryPiece> trajectory_of(const PairLog& log, const GapWedge& wedge,
                                           const Span& span, int columns);

/// The greatest of red's gaps at corners and at ends of bands; at least 0.
double greatest_y2(const std::vector<TrajectoryPiece>& pieces);

}  // namespace piblocks
