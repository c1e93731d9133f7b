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
constexpr double kTick = 0.25;
constexpr double kBaseline = 1.4;
constexpr double kBetweenTicks = 4;
constexpr double kLeastGap = 0.6;  // between figures
constexpr double kSlack_px = 0.5;

}  // namespace

TimeAxis::TimeAxis(const Setting& setting, const PanelSheet& sheet, double indent_em)
    : TimeAxis(span_of(setting.scene, setting.log), setting.font, sheet, indent_em) {}

TimeAxis::TimeAxis(const Span& span, const Font& font, const PanelSheet& sheet, double indent_em)
    : from_(span.from), to_(span.to), low_(to_double(from_)), span_(to_double(to_ - from_)) {
  if (to_ <= from_) throw UsageError("show.panels: the scene ends before it begins");
  if (!(span_ > 0) || !std::isfinite(span_)) {
    throw UsageError(
        "show.panels: the time that the scene shows is beyond the range of a double; leave out "
        "diagrams over time, or change time.from and time.to");
  }
  const double em = sheet.text_px();
  const Rectangle& inside = sheet.inside();
  plot_ = inside;
  plot_.height -= kBelow * em;
  plot_.x += indent_em * em;
  plot_.width -= indent_em * em;
  // Figures are centred on their marks, and those at the ends need room beside the axis: each
  // narrowing moves the marks, but by less and less.
  constexpr int kPasses = 4;
  for (int pass = 0; pass < kPasses; ++pass) {
    set_scale();
    figures_ = figures_of(font, em);
    if (figures_.empty()) return;
    const Figure& first = figures_.front();
    const Figure& last = figures_.back();
    const double left = std::max(0.0, inside.x - (first.x - first.width_px / 2));
    const double right = std::max(0.0, last.x + last.width_px / 2 - (inside.x + inside.width));
    plot_.x += left;
    plot_.width -= left + right;
  }
  set_scale();
  figures_ = figures_of(font, em);
  for (Figure& figure : figures_) {
    const bool fits = figure.x - figure.width_px / 2 >= inside.x - kSlack_px &&
                      figure.x + figure.width_px / 2 <= inside.x + inside.width + kSlack_px;
    if (!fits) figure.text.clear();
  }
}

std::vector<TimeAxis::Figure> TimeAxis::figures_of(const Font& font, double em) const {
  Ticks ticks = ticks_of(low_, low_ + span_, kBetweenTicks * em / scale_);
  // One figure alone gives no scale.
  if (ticks.values.size() < 2) ticks = ticks_of(low_, low_ + span_, em / scale_);
  const auto is_crowded = [&] {
    const double widest = std::max(font.width_em(tick_text(low_, ticks.step)),
                                   font.width_em(tick_text(low_ + span_, ticks.step)));
    return ticks.step * scale_ < (widest + kLeastGap) * em;
  };
  while (ticks.values.size() > 1 && is_crowded()) {
    ticks = ticks_of(low_, low_ + span_, 1.5 * ticks.step);
  }
  std::vector<Figure> figures;
  for (const double value : ticks.values) {
    std::string text = tick_text(value, ticks.step);
    const double width_px = font.width_em(text) * em;
    figures.push_back({x_of(value), std::move(text), width_px});
  }
  return figures;
}

int TimeAxis::columns(double width_px) const {
  return std::max(1, static_cast<int>(std::ceil(plot_.width / width_px)));
}

void TimeAxis::add_base(PanelSheet& sheet) const {
  const double em = sheet.text_px();
  const Color& color = sheet.palette().muted;
  sheet.line({{plot_.x, bottom()}, {plot_.x + plot_.width, bottom()}}, color);
  for (const Figure& figure : figures_) {
    sheet.line({{figure.x, bottom()}, {figure.x, bottom() + kTick * em}}, color);
    if (figure.text.empty()) continue;
    sheet.text(figure.text, {figure.x, bottom() + kBaseline * em}, 0.5, color);
  }
}

PathItem TimeAxis::cursor(const PanelSheet& sheet, double x) const {
  const double at = std::round(x) + 0.5;
  return {sheet.moving(0), std::vector<Point>{{at, plot_.y}, {at, bottom()}}, false, std::nullopt,
          Stroke{sheet.palette().accent, sheet.line_px()}};
}

}  // namespace piblocks
