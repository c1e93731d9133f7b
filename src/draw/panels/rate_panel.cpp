#include <fmt/format.h>
#include <piblocks/run.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include "draw/number_text.hpp"
#include "draw/panels/panels.hpp"
#include "scene/schedule.hpp"

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

PanelTitle title_of(const Rates& rates) {
  return {fmt::format("Collisions per unit of time, in bins of {}", short_text(rates.bin)),
          "Collision rate"};
}

/// The room for powers of ten and their ticks, left of the axis.
double indent_em(const Rates& rates, const Font& font) {
  return kRateTick_em + kBesideTick_em +
         std::max(font.width_em(power_text(rates.low)), font.width_em(power_text(rates.high)));
}

class RatePanel {
 public:
  RatePanel(const DrawingContext& context, const PanelPlace& place)
      : rates_(context.log, span_of(context.scene, context.log)),
        diagram_(context, place, title_of(rates_)),
        axis_(context, diagram_, indent_em(rates_, context.font)) {
    add_bars();
    axis_.add_base(diagram_);
    add_powers();
    diagram_.finish();
  }

  void operator()(const FrameState& shown, std::vector<DrawItem>& items) const {
    items.emplace_back(diagram_.item());
    const double x = axis_.x_of(to_double(shown.time));
    if (axis_.shows(x)) items.emplace_back(axis_.cursor(diagram_, x));
  }

 private:
  double y_of(double logarithm) const {
    const double share = (logarithm - double(rates_.low)) / double(rates_.high - rates_.low);
    return axis_.bottom() - std::clamp(share, 0.0, 1.0) * axis_.plot().height;
  }

  void add_bars() {
    const auto x_of = [&](const Integer& bins) {
      return std::clamp(axis_.x_of(to_double(bins * rates_.bin)), axis_.plot().x,
                        axis_.plot().x + axis_.plot().width);
    };
    std::vector<Point> points;
    points.push_back({axis_.plot().x, axis_.bottom()});
    Integer k = rates_.first;
    for (const Magnitude& rate : rates_.of_bins) {
      const double y = rate.mantissa > 0
                           ? y_of(std::log10(rate.mantissa) + static_cast<double>(rate.exponent))
                           : axis_.bottom();
      points.push_back({x_of(k), y});
      points.push_back({x_of(++k), y});
    }
    points.push_back({axis_.plot().x + axis_.plot().width, axis_.bottom()});
    diagram_.shape(std::move(points), diagram_.palette().shade, diagram_.palette().muted);
  }

  void add_powers() {
    const double em = diagram_.text_px();
    const double fit = std::max(1.0, axis_.plot().height / (kBetweenTicks_em * em));
    const long step = std::lround(std::ceil(double(rates_.high - rates_.low) / fit));
    for (long power = rates_.low + step; power <= rates_.high; power += step) {
      const double y = y_of(double(power));
      const double tick = axis_.plot().x - kRateTick_em * em;
      diagram_.line({{tick, y}, {axis_.plot().x, y}}, diagram_.palette().muted);
      diagram_.text(power_text(power), {tick - kBesideTick_em * em, y + kHalfFigure_em * em}, 1,
                    diagram_.palette().muted);
    }
  }

  Rates rates_;
  Diagram diagram_;
  TimeAxis axis_;
};

}  // namespace

Drawable rate_panel(const DrawingContext& context, const PanelPlace& place) {
  return RatePanel(context, place);
}

}  // namespace piblocks
