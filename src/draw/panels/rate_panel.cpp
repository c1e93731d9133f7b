#include <piblocks/interpolator.hpp>

#include <algorithm>
#include <cmath>

#include "draw/number_text.hpp"
#include "draw/panels/panels.hpp"
#include "draw/panels/time_axis.hpp"

namespace piblocks {
namespace {

/// As wide as this a column is seen as a bar.
constexpr double kColumn_px = 3;
constexpr double kBetweenTicks_em = 1.8;
constexpr double kFigures_em = 2.6;  // of room for powers of ten, left of the bars

class RatePanel final : public PicturePart {
 public:
  RatePanel(const Setting& setting, const PanelPlace& place)
      : sheet_(setting, place, {"Collisions per unit of time", "Collision rate"}),
        axis_(setting, sheet_, kFigures_em) {
    const int columns = axis_.columns(kColumn_px);
    const Rational width = (axis_.to() - axis_.from()) / columns;
    std::vector<Rational> rates;
    Integer before = state_at(setting.log, axis_.from()).count;
    for (int column = 1; column <= columns; ++column) {
      const Integer count = state_at(setting.log, axis_.from() + width * column).count;
      rates.push_back(Rational(count - before) / width);
      before = count;
    }
    // Rates of one run span many powers of ten: heights are their logarithms, from one collision in
    // the whole span on.
    low_ = std::floor(std::log10(1 / to_double(axis_.to() - axis_.from())));
    const Magnitude most = magnitude_of(*std::ranges::max_element(rates));
    high_ = std::max(low_ + 1, static_cast<double>(most.exponent) + 1);
    add_bars(rates);
    axis_.add_base(sheet_);
    add_powers();
    sheet_.finish();
  }

  void add(const Shown& shown, std::vector<DrawItem>& items) const override {
    items.emplace_back(sheet_.item());
    const double x = axis_.x_of(to_double(shown.time));
    if (axis_.shows(x)) items.emplace_back(axis_.cursor(sheet_, x));
  }

 private:
  double y_of(double logarithm) const {
    const double share = std::clamp((logarithm - low_) / (high_ - low_), 0.0, 1.0);
    return axis_.bottom() - share * axis_.height();
  }

  void add_bars(const std::vector<Rational>& rates) {
    std::vector<Point> points;
    const double step = axis_.width() / static_cast<double>(rates.size());
    points.push_back({axis_.left(), axis_.bottom()});
    for (std::size_t i = 0; i < rates.size(); ++i) {
      const Magnitude rate = magnitude_of(rates[i]);
      const double logarithm =
          rate.mantissa > 0 ? std::log10(rate.mantissa) + static_cast<double>(rate.exponent) : low_;
      const double x = axis_.left() + step * static_cast<double>(i);
      points.push_back({x, y_of(logarithm)});
      points.push_back({x + step, y_of(logarithm)});
    }
    points.push_back({axis_.left() + axis_.width(), axis_.bottom()});
    sheet_.path(std::move(points), true, sheet_.palette().shade,
                Stroke{sheet_.palette().muted, sheet_.line_px()});
  }

  void add_powers() {
    const double em = sheet_.text_px();
    const double fit = axis_.height() / (kBetweenTicks_em * em);
    const double step = std::max(1.0, std::ceil((high_ - low_) / std::max(1.0, fit)));
    for (double power = low_ + step; power <= high_; power += step) {
      const double y = y_of(power);
      sheet_.line({{axis_.left() - 0.4 * em, y}, {axis_.left(), y}}, sheet_.palette().muted);
      sheet_.text("10" + superscript(std::lround(power)),
                  {axis_.left() - kFigures_em * em, y + 0.35 * em}, 0, sheet_.palette().muted);
    }
  }

  PanelSheet sheet_;
  TimeAxis axis_;
  double low_ = 0;
  double high_ = 1;
};

}  // namespace

std::unique_ptr<PicturePart> rate_panel(const Setting& setting, const PanelPlace& place) {
  return std::make_unique<RatePanel>(setting, place);
}

}  // namespace piblocks
