#include <fmt/format.h>
#include <piblocks/run.hpp>

#include <algorithm>

#include "draw/number_text.hpp"
#include "draw/panels/panels.hpp"

namespace piblocks {
namespace {

constexpr double kBetweenTicks_em = 1.8;
constexpr double kRateTick_em = 0.4;
constexpr double kBesideTick_em = 0.2;
constexpr int kMostBins = 120;
/// A picture does not show so small a part of a bin.
constexpr long kNegligiblePart = 1'000'000'000'000;

/// The rate of collisions in each of equal bins of time. A bin's length is a round step, and it
/// begins at a multiple of it, so that rates do not depend on the picture's size.
struct Rates {
  Rates(const CollisionLog& log, const Span& span)
      : bin(round_step((span.to - span.from) / kMostBins)), first(floor(span.from / bin)) {
    const Integer end = ceil(span.to / bin);
    // Collisions at the very beginning belong to the first bin.
    Integer before = log.state_at(Rational(first * bin - bin / kNegligiblePart)).count;
    for (Integer k = first + 1; k <= end; k += 1) {
      const Integer count = log.state_at(k * bin).count;
      of_bins.push_back(magnitude_of(Rational(count - before) / bin));
      before = count;
    }
    // Rates of one run span many powers of ten, so heights are logarithms. They begin at the rate
    // of one collision in the whole span.
    low = magnitude_of(1 / (span.to - span.from)).exponent;
    high = low + 1;
    for (const Magnitude& rate : of_bins) {
      if (rate.mantissa > 0) high = std::max(high, rate.exponent + 1);
    }
  }

  Rational bin;   ///< its length
  Integer first;  ///< the first bin begins at so many lengths
  std::vector<Magnitude> of_bins;
  // Powers of ten.
  long low = 0;
  long high = 1;
};

/// The room for powers of ten and their ticks, left of the axis.
double indent_em(const Rates& rates, const Font& font) {
  return kRateTick_em + kBesideTick_em +
         std::max(font.width_em(power_text(rates.low)), font.width_em(power_text(rates.high)));
}

double y_of(double logarithm, const Rates& rates, const TimeAxis& axis) {
  const double share = (logarithm - double(rates.low)) / double(rates.high - rates.low);
  return axis.bottom() - std::clamp(share, 0.0, 1.0) * axis.plot().height;
}

void add_bars(const Rates& rates, const TimeAxis& axis, Diagram& diagram) {
  const double left = axis.plot().x;
  const double right = left + axis.plot().width;
  const auto x_of = [&](const Integer& bins) {
    return std::clamp(axis.x_of(to_double(bins * rates.bin)), left, right);
  };
  std::vector<Point> points{{left, axis.bottom()}};
  Integer k = rates.first;
  for (const Magnitude& rate : rates.of_bins) {
    const double y = rate.mantissa > 0
                         ? y_of(std::log10(rate.mantissa) + double(rate.exponent), rates, axis)
                         : axis.bottom();
    points.push_back({x_of(k), y});
    points.push_back({x_of(++k), y});
  }
  points.push_back({right, axis.bottom()});
  diagram.shape(std::move(points), diagram.palette().shade, diagram.palette().muted);
}

void add_powers(const Rates& rates, const TimeAxis& axis, Diagram& diagram) {
  const double em = diagram.text_px();
  const Color color = diagram.palette().muted;
  const double fit = std::max(1.0, axis.plot().height / (kBetweenTicks_em * em));
  const long step = std::lround(std::ceil(double(rates.high - rates.low) / fit));
  for (long power = rates.low + step; power <= rates.high; power += step) {
    const double y = y_of(double(power), rates, axis);
    const double tick = axis.plot().x - kRateTick_em * em;
    diagram.line({{tick, y}, {axis.plot().x, y}}, color);
    diagram.text(power_text(power), {tick - kBesideTick_em * em, y + kHalfFigure_em * em}, 1,
                 color);
  }
}

}  // namespace

Drawable rate_panel(const DrawingContext& context, const PanelPlace& place) {
  const Rates rates(context.log, span_of(context.scene, context.log));
  Diagram diagram(context, place,
                  {context.setter().text(fmt::format("Collisions per unit of time, in bins of {}",
                                                     short_text(rates.bin))),
                   context.setter().text("Collision rate")});
  const TimeAxis axis(context, diagram, indent_em(rates, context.font));
  add_bars(rates, axis, diagram);
  axis.add_base(diagram);
  add_powers(rates, axis, diagram);
  diagram.finish();
  return [=](const FrameState& shown, std::vector<DrawItem>& items) {
    items.emplace_back(diagram.item());
    const double time = to_double(shown.time);
    if (axis.shows(time)) items.emplace_back(axis.cursor(diagram, time));
  };
}

}  // namespace piblocks
