#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include "draw/extent.hpp"
#include "draw/panels/panels.hpp"
#include "draw/style.hpp"

namespace piblocks {
namespace {

// In ems.
constexpr double kTitleHeight = 1.9;
constexpr double kTitleBaseline = 1.0;
constexpr double kAround = 0.5;
/// If the full title had to be smaller than this part of the other text, the brief one is set.
constexpr double kLeastPanelShrink = 0.8;
// In line widths.
constexpr double kDotRadius = 3.2;

Rectangle whole_pixels(const Rectangle& area, double around) {
  const double left = std::floor(area.x - around);
  const double top = std::floor(area.y - around);
  return {left, top, std::ceil(area.x + area.width + around) - left,
          std::ceil(area.y + area.height + around) - top};
}

}  // namespace

Point Circle::at(double angle) const {
  return {centre.x + radius * std::cos(angle), centre.y - radius * std::sin(angle)};
}

std::vector<Point> Circle::arc(double from, double to) const {
  constexpr double kStep = 0.05;  // radians
  const int steps = std::max(1, static_cast<int>(std::ceil(std::abs(to - from) / kStep)));
  std::vector<Point> points;
  for (int i = 0; i <= steps; ++i) points.push_back(at(from + (to - from) * i / steps));
  return points;
}

PanelSheet::PanelSheet(const Setting& setting, const PanelPlace& place, const PanelTitle& title)
    : palette_(setting.palette),
      font_(&setting.font),
      first_id_(place.first_id),
      panel_(place.panel),
      text_px_(setting.text_px),
      line_px_(setting.line_px) {
  const Rectangle& whole = place.area;
  const double full_px = font_->fitted_px(title.full, text_px_, whole.width);
  const bool is_full = full_px >= std::max(style::kLeastText_px, kLeastPanelShrink * text_px_);
  items_.emplace_back(
      TextItem{next_id(),
               {whole.x, whole.y + kTitleBaseline * text_px_},
               is_full ? title.full : title.brief,
               is_full ? full_px : font_->fitted_px(title.brief, text_px_, whole.width),
               palette_.muted});
  const double top = kTitleHeight * text_px_;
  inside_ = {whole.x, whole.y + top, whole.width, whole.height - top};
  // Lines along its border are wider than the area.
  item_ = {nth(first_id_, 0), whole_pixels(whole, kAround * text_px_), nullptr};
}

void PanelSheet::finish() {
  if (!are_finite(items_)) {
    throw UsageError(fmt::format(
        "show.panels: the diagram '{}' needs numbers beyond the range of a double (about 1.8e308); "
        "leave it out, or use less extreme positions, velocities and times",
        exact_text(panel_)));
  }
  item_.plate = std::make_shared<const Plate>(Plate{std::move(items_)});
  font_ = nullptr;
}

void PanelSheet::line(std::vector<Point> points, const Color& color, double width, double dash) {
  items_.emplace_back(PathItem{next_id(), std::move(points), false, std::nullopt,
                               Stroke{color, width * line_px_, dash * line_px_}});
}

PathItem PanelSheet::shape_item(ItemId id, std::vector<Point> outline,
                                const std::optional<Color>& fill,
                                const std::optional<Color>& line) const {
  PathItem item{id, std::move(outline), true, fill, std::nullopt};
  if (line) item.stroke = Stroke{*line, line_px_};
  return item;
}

void PanelSheet::shape(std::vector<Point> outline, const std::optional<Color>& fill,
                       const std::optional<Color>& line) {
  items_.emplace_back(shape_item(next_id(), std::move(outline), fill, line));
}

PathItem PanelSheet::moving_line(std::size_t n, std::vector<Point> points, const Color& color,
                                 double width) const {
  return {moving(n), std::move(points), false, std::nullopt, Stroke{color, width * line_px_}};
}

PathItem PanelSheet::moving_shape(std::size_t n, std::vector<Point> outline, const Color& fill,
                                  const std::optional<Color>& line) const {
  return shape_item(moving(n), std::move(outline), fill, line);
}

void PanelSheet::text(const std::string& text, const Point& at, double anchor, const Color& color) {
  const double width = font_->width_em(text) * text_px_;
  items_.emplace_back(TextItem{next_id(), {at.x - anchor * width, at.y}, text, text_px_, color});
}

DiskItem PanelSheet::dot(std::size_t n, const Point& at, const Color& color) const {
  return {moving(n), at, kDotRadius * line_px_, color, Stroke{palette_.background, line_px_}};
}

}  // namespace piblocks
