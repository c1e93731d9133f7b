#include "draw/card.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <cmath>

#include "draw/font.hpp"
#include "draw/style.hpp"
#include "draw/theme.hpp"

namespace piblocks {
namespace {

/// A line may be set so much smaller than planned; beyond that it is too long.
constexpr double kLeastShrink = 0.4;
// In ems.
constexpr double kBelowHeading = 0.75;  // of the heading, to the next line's capitals
constexpr double kBetweenLines = 0.8;

double fitted_px(const std::string& text, double size_px, double width_px, const Font& font) {
  font.check(text, "card");
  const double fitted = font.fitted_px(text, size_px, width_px);
  if (fitted >= kLeastShrink * size_px) return fitted;
  throw UsageError(fmt::format(
      "card: '{}' is too long to be read in {:.0f} pixels; break it into lines, or make the frame "
      "wider",
      text, width_px));
}

}  // namespace

DrawList compose_card(const std::vector<std::string>& lines, const View& view) {
  const Font font;
  const Palette palette = palette_of(view.theme);
  const double measure = short_measure(view);
  const double inner_px = view.width_px - 2 * style::kCardMargin * measure;

  const double heading_px = fitted_px(lines.front(), style::kCardHeading * measure, inner_px, font);
  // Lines of one size, so that none seems to matter more.
  double line_px = style::kCardLine * measure;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    line_px = std::min(line_px, fitted_px(lines[i], style::kCardLine * measure, inner_px, font));
  }
  const double heading_height = Font::kCapHeight_em * heading_px;
  const double line_height = Font::kCapHeight_em * line_px;
  const double first_step = kBelowHeading * heading_px + line_height;
  const double step = (Font::kCapHeight_em + kBetweenLines) * line_px;
  const double below = lines.size() > 1 ? first_step + double(lines.size() - 2) * step : 0;

  DrawList list{view.width_px, view.height_px, background_of(view), {}};
  double baseline = (view.height_px - heading_height - below) / 2 + heading_height;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const double size_px = i == 0 ? heading_px : line_px;
    if (i > 0) baseline += i == 1 ? first_step : step;
    const Point origin{(view.width_px - font.width_em(lines[i]) * size_px) / 2,
                       std::round(baseline)};
    list.items.emplace_back(TextItem{nth(ItemId::card, i), origin, lines[i], size_px,
                                     i == 0 ? palette.text : palette.muted});
  }
  return list;
}

}  // namespace piblocks
