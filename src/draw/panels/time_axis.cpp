#include "draw/panels/time_axis.hpp"

#include <piblocks/error.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include "draw/ticks.hpp"
#include "scene/schedule.hpp"

namespace piblocks {
namespace {

// In ems.
constexpr double kBelow = 1.7;
constexpr double kTimeTick_em = 0.25;
constexpr double kTimeBaseline_em = 1.4;
constexpr double kBetweenTicks = 4;
constexpr double kLeastGap = 0.6;  // between figures
constexpr double kSlack_px = 0.5;

}  // namespace

TimeAxis::TimeAxis(const Setting& setting, const PanelSheet& sheet, double indent_em)
    : span_(span_of(setting.scene, setting.log)),
      from_(to_double(span_.from)),
      length_(to_double(span_.to - span_.from)),
      plot_(sheet.inside()) {
  if (span_.to <= span_.from) throw UsageError("show.panels: the scene ends before it begins");
  if (!(length_ > 0) || !std::isfinite(length_)) {
    throw UsageError(
        "show.panels: the time that the scene shows is beyond the range of a double; leave out "
        "diagrams over time, or change time.from and time.to");
  }
  const double em = sheet.text_px();
  const double inside_left = plot_.x;
  const double inside_right = plot_.x + plot_.width;
  plot_.height -= kBelow * em;
  plot_.x += indent_em * em;
  plot_.width -= indent_em * em;
  // Figures are centred on their marks, and those at the ends need room beside the axis. To make
  // room moves the marks, by less and less.
  constexpr int kPasses = 4;
  for (int pass = 0; pass < kPasses; ++pass) {
    place_figures(setting.font, em);
    if (figures_.empty()) return;
    const Figure& first = figures_.front();
    const Figure& last = figures_.back();
    const double left = std::max(0.0, inside_left - (first.x - first.width_px / 2));
    const double right = std::max(0.0, last.x + last.width_px / 2 - inside_right);
    plot_.x += left;
    plot_.width -= left + right;
  }
  place_figures(setting.font, em);
  for (Figure& figure : figures_) {
    const bool fits = figure.x - figure.width_px / 2 >= inside_left - kSlack_px &&
                      figure.x + figure.width_px / 2 <= inside_right + kSlack_px;
    if (!fits) figure.text.clear();
  }
}

void TimeAxis::place_figures(const Font& font, double em) {
  scale_ = plot_.width / length_;
  const FigureAxis axis{from_, from_ + length_, em / scale_, kLeastGap};
  Ticks ticks = ticks_of(axis.low, axis.high, kBetweenTicks * axis.em);
  // One figure alone gives no scale.
  if (ticks.values.size() < 2) ticks = ticks_of(axis.low, axis.high, axis.em);
  ticks = with_room_for_figures(std::move(ticks), axis, font);
  figures_.clear();
  for (const double value : ticks.values) {
    std::string text = tick_text(value, ticks.step);
    const double width_px = font.width_em(text) * em;
    figures_.push_back({x_of(value), std::move(text), width_px});
  }
}

void TimeAxis::add_base(PanelSheet& sheet) const {
  const double em = sheet.text_px();
  const Color& color = sheet.palette().muted;
  sheet.line({{plot_.x, bottom()}, {plot_.x + plot_.width, bottom()}}, color);
  for (const Figure& figure : figures_) {
    sheet.line({{figure.x, bottom()}, {figure.x, bottom() + kTimeTick_em * em}}, color);
    if (figure.text.empty()) continue;
    sheet.text(figure.text, {figure.x, bottom() + kTimeBaseline_em * em}, 0.5, color);
  }
}

PathItem TimeAxis::cursor(const PanelSheet& sheet, double x) const {
  const double at = std::round(x) + 0.5;
  return sheet.moving_line(0, {{at, plot_.y}, {at, bottom()}}, sheet.palette().accent);
}

}  // namespace piblocks
