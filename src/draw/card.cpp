#include "draw/card.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <cmath>

#include "draw/font.hpp"
#include "draw/stage.hpp"
#include "draw/theme.hpp"

namespace piblocks {
namespace {

// In parts of the frame's short measure.
constexpr double kMargin = 0.09;
constexpr double kHeading = 0.12;
constexpr double kLine = 0.06;
/// A line may be set so much smaller than planned; beyond that it is too long.
constexpr double kLeastShrink = 0.4;
// In ems.
constexpr double kBelowHeading = 0.75;  // of the heading, to the next line's capitals
constexpr double kBetweenLines = 0.8;

double fitted_px(const std::string& text, double size_px, double width_px, const Font& font) {
  font.check(text, "card");
  const double fitted = std::min(size_px, width_px / font.width_em(text));
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
  const double width = view.width_px;
  const double height = view.height_px;
  const double measure = short_measure({0, 0, width, height});
  const double inner_px = width - 2 * kMargin * measure;

  const double heading_px = fitted_px(lines.front(), kHeading * measure, inner_px, font);
  // Lines of one size, so that none seems to matter more.
  double line_px = kLine * measure;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    line_px = std::min(line_px, fitted_px(lines[i], kLine * measure, inner_px, font));
  }
  const auto others = double(lines.size() - 1);
  const double between = (Font::kCapHeight_em + kBetweenLines) * line_px;
  double below = 0;
  if (lines.size() > 1) {
    below = kBelowHeading * heading_px + Font::kCapHeight_em * line_px + (others - 1) * between;
  }
  const double top = (height - Font::kCapHeight_em * heading_px - below) / 2;

  DrawList list{view.width_px, view.height_px, background_of(view), {}};
  double baseline = top + Font::kCapHeight_em * heading_px;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const double size_px = i == 0 ? heading_px : line_px;
    if (i == 1) baseline += kBelowHeading * heading_px + Font::kCapHeight_em * line_px;
    if (i > 1) baseline += between;
    const Point origin{(width - font.width_em(lines[i]) * size_px) / 2, std::round(baseline)};
    list.items.emplace_back(TextItem{nth(ItemId::card, i), origin, lines[i], size_px,
                                     i == 0 ? palette.text : palette.muted});
  }
  return list;
}

}  // namespace piblocks
