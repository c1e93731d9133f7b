#include "draw/panels/time_axis.hpp"

#include <piblocks/error.hpp>
#include <piblocks/schedule.hpp>

#include <algorithm>
#include <cmath>

#include "draw/ticks.hpp"

namespace piblocks {
namespace {

// In ems.
constexpr double kBelow = 1.7;
constexpr double kTick = 0.25;
constexpr double kBaseline = 1.4;
constexpr double kBetweenTicks = 4;

}  // namespace

TimeAxis::TimeAxis(const Setting& setting, const PanelSheet& sheet, double indent_em) {
  const Span span = span_of(setting.scene, setting.log);
  from_ = span.from;
  to_ = span.to;
  if (to_ <= from_) throw UsageError("show.panels: the scene ends before it begins");
  plot_ = sheet.inside();
  plot_.height -= kBelow * sheet.text_px();
  plot_.x += indent_em * sheet.text_px();
  plot_.width -= indent_em * sheet.text_px();
  low_ = to_double(from_);
  scale_ = plot_.width / to_double(to_ - from_);
}

int TimeAxis::columns(double width_px) const {
  return std::max(1, static_cast<int>(std::ceil(plot_.width / width_px)));
}

void TimeAxis::add_base(PanelSheet& sheet) const {
  const double em = sheet.text_px();
  const Color& color = sheet.palette().muted;
  sheet.line({{plot_.x, bottom()}, {plot_.x + plot_.width, bottom()}}, color);
  const double high = low_ + plot_.width / scale_;
  const Ticks ticks = ticks_of(low_, high, kBetweenTicks * em / scale_);
  for (const double value : ticks.values) {
    const double x = x_of(value);
    sheet.line({{x, bottom()}, {x, bottom() + kTick * em}}, color);
    const double anchor = std::clamp((x - plot_.x) / plot_.width, 0.0, 1.0);
    // Figures at the ends stay within the diagram.
    sheet.text(tick_text(value, ticks.step), {x, bottom() + kBaseline * em},
               anchor < 0.05   ? 0
               : anchor > 0.95 ? 1
                               : 0.5,
               color);
  }
}

PathItem TimeAxis::cursor(const PanelSheet& sheet, double x) const {
  const double at = std::round(x) + 0.5;
  return {sheet.moving(0), std::vector<Point>{{at, plot_.y}, {at, bottom()}}, false, std::nullopt,
          Stroke{sheet.palette().accent, sheet.line_px()}};
}

}  // namespace piblocks
