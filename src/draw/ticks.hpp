// Round values along an axis.
// In: the ends of the axis and how close marks may be. Out: values and their texts.
#pragma once

#include <piblocks/exact.hpp>

#include <string>
#include <vector>

#include "draw/font.hpp"

namespace piblocks {

struct Ticks {
  double step = 1;  ///< 1, 2 or 5 times a power of ten
  std::vector<double> values;
};

/// Multiples of the smallest step >= least, from low to high, both included; at most a thousand.
Ticks ticks_of(double low, double high, double least);

/// An axis with figures at its ticks.
struct FigureAxis {
  double low;
  double high;
  double em;      ///< size of type, in units of the axis
  double gap_em;  ///< least gap between figures
};

/// The same ticks, or those of a larger step if their figures would touch.
Ticks with_room_for_figures(Ticks ticks, const FigureAxis& axis, const Font& font);

/// With as many decimals as the step has, or with the step's power of ten if there are many:
/// "−0.25", "5×10⁹".
std::string tick_text(double value, double step);

/// The smallest step >= least, exactly. @param least  > 0
Rational round_step(const Rational& least);

/// Half of the height of figures. A figure that is centred on a mark has its baseline so far below.
inline constexpr double kHalfFigure_em = 0.365;

}  // namespace piblocks
