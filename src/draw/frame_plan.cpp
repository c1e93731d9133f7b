#include "draw/frame_plan.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace piblocks {
namespace {

// In parts of the frame's short measure.
constexpr double kMargin = 0.045;
constexpr double kTitleSize = 0.06;
constexpr double kCaptionSize = 0.036;
constexpr double kSmallText = 0.026;
constexpr double kLineWidth = 0.0016;
constexpr double kLogoHeight = 0.09;
constexpr double kLogoWidth = 0.24;
constexpr double kPanelGap = 0.035;
// In ems.
constexpr double kCapHeight = 0.73;
constexpr double kDescent = 0.24;
constexpr double kBelowTitle = 0.25;
/// A line may be set so much smaller than planned; beyond that it is too long.
constexpr double kLeastShrink = 0.5;
/// Below this no font can be read.
constexpr double kLeastText_px = 8;
/// Least side of a diagram, in ems of its text.
constexpr double kLeastPanel_em = 8;
/// What diagrams look best in.
constexpr double kPanelAspect = 1.3;
/// Of what is left beside title and caption, where there are diagrams.
constexpr double kLeastStage = 0.22;
constexpr double kMostStage = 0.46;

Rectangle whole(const View& view) { return {0, 0, double(view.width_px), double(view.height_px)}; }

/// A centred line that is made smaller to fit. @param key  named in messages.
TextItem set_line(ItemId id, const char* key, const std::string& text, double size_px,
                  const Rectangle& area, const Color& color, const Font& font) {
  font.check(text, key);
  const double width_em = font.width_em(text);
  const double fitted_px = std::min(size_px, area.width / width_em);
  if (fitted_px < std::max(kLeastShrink * size_px, kLeastText_px)) {
    throw UsageError(
        fmt::format("{}: '{}' is too long to be read in {:.0f} pixels; shorten it, or "
                    "make the frame wider",
                    key, text, area.width));
  }
  return {id, {area.x + (area.width - width_em * fitted_px) / 2, 0}, text, fitted_px, color};
}

/// Rows and columns in which `count` diagrams come out largest, with no side below `least` if that
/// can be.
std::vector<Rectangle> grid(std::size_t count, const Rectangle& area, double gap, double least) {
  const auto cell = [&](std::size_t columns) {
    const std::size_t rows = (count + columns - 1) / columns;
    const auto side = [gap](double length, std::size_t n) {
      return (length - gap * double(n - 1)) / double(n);
    };
    return Rectangle{0, 0, side(area.width, columns), side(area.height, rows)};
  };
  const auto size = [least](const Rectangle& r) {
    return std::pair(std::min(r.width, r.height) >= least,
                     std::min(r.width / kPanelAspect, r.height));
  };
  std::size_t best = 1;
  for (std::size_t columns = 2; columns <= count; ++columns) {
    if (size(cell(columns)) > size(cell(best))) best = columns;
  }
  std::vector<Rectangle> cells;
  for (std::size_t i = 0; i < count; ++i) {
    Rectangle place = cell(best);
    const std::size_t row = i / best;
    const std::size_t in_row = std::min(best, count - row * best);
    // A last row that is not full is centred.
    const double shift = double(best - in_row) * (place.width + gap) / 2;
    place.x = area.x + shift + double(i % best) * (place.width + gap);
    place.y = area.y + double(row) * (place.height + gap);
    cells.push_back(place);
  }
  return cells;
}

void check_panels(const FramePlan& plan, const View& view) {
  for (const Rectangle& panel : plan.panels) {
    const double least = kLeastPanel_em * plan.text_px;
    if (std::min(panel.width, panel.height) >= least && plan.text_px >= kLeastText_px) continue;
    throw UsageError(
        fmt::format("show.panels: {} of them do not fit into {}x{}; leave some out, or "
                    "make the frame larger",
                    plan.panels.size(), view.width_px, view.height_px));
  }
}

/// What the stage needs to be as wide as the area.
double stage_height(const View& view, const Rectangle& area, double measure) {
  const double lengths = to_double(view.y.high - view.y.low) / to_double(view.x.high - view.x.low);
  return std::clamp(area.width * lengths + 0.2 * measure, kLeastStage * area.height,
                    kMostStage * area.height);
}

/// Places caption and logo. @return the height of both above the lower margin
double plan_foot(const Scene& scene, const Palette& palette, const Font& font, FramePlan& plan) {
  const View& view = scene.view;
  const Show& show = scene.show;
  const double measure = short_measure(whole(view));
  const double margin = kMargin * measure;
  double foot = 0;
  Rectangle caption_line{margin, 0, view.width_px - 2 * margin, 0};
  if (!show.logo.empty()) {
    plan.logo = {view.width_px - margin - kLogoWidth * measure,
                 view.height_px - margin - kLogoHeight * measure, kLogoWidth * measure,
                 kLogoHeight * measure};
    foot = kLogoHeight * measure;
    // As much is left free on the other side, so that the caption stays in the middle.
    caption_line.x += plan.logo.width + margin;
    caption_line.width -= 2 * (plan.logo.width + margin);
  }
  if (!show.caption.empty()) {
    plan.caption = set_line(ItemId::caption, "show.caption", show.caption, kCaptionSize * measure,
                            caption_line, palette.muted, font);
    foot = std::max(foot, (kCapHeight + kDescent) * kCaptionSize * measure);
    plan.caption->origin.y =
        std::round(view.height_px - margin - (foot - kCapHeight * kCaptionSize * measure) / 2);
  }
  return foot;
}

}  // namespace

double small_text_px(const View& view) { return kSmallText * short_measure(whole(view)); }

Rectangle read_out_area(const View& view) {
  const double margin = kMargin * short_measure(whole(view));
  return {margin, 0, view.width_px - 2 * margin, 0};
}

FramePlan plan_frame(const Scene& scene, const Palette& palette, const Font& font,
                     double read_outs_px) {
  const View& view = scene.view;
  const Show& show = scene.show;
  const double measure = short_measure(whole(view));
  const double margin = kMargin * measure;
  FramePlan plan;
  plan.text_px = small_text_px(view);
  plan.line_px = std::max(1.0, std::round(kLineWidth * measure));

  Rectangle left = whole(view);
  const Rectangle line{margin, 0, view.width_px - 2 * margin, 0};
  if (!show.title.empty()) {
    plan.title = set_line(ItemId::title, "show.title", show.title, kTitleSize * measure, line,
                          palette.text, font);
    plan.title->origin.y = std::round(margin + kCapHeight * kTitleSize * measure);
    left.y = plan.title->origin.y + (kDescent + kBelowTitle) * kTitleSize * measure;
    left.height -= left.y;
  }
  if (show.title.empty() && !show.panels.empty()) {
    // Else the counter would stick to the upper edge.
    left.y += margin / 2;
    left.height -= margin / 2;
  }
  const double foot = plan_foot(scene, palette, font, plan);
  if (foot > 0) left.height -= foot + margin;

  plan.stage = left;
  if (show.panels.empty()) {
    plan.stage.height -= read_outs_px;
    // Else read-outs would stick to the lower edge.
    if (read_outs_px > 0 && foot == 0) plan.stage.height -= margin / 2;
    return plan;
  }
  plan.stage.height = stage_height(view, left, measure);
  const double top = plan.stage.y + plan.stage.height + read_outs_px + margin / 2;
  plan.panels = grid(show.panels.size(),
                     {margin, top, view.width_px - 2 * margin, left.y + left.height - margin - top},
                     kPanelGap * measure, kLeastPanel_em * plan.text_px);
  check_panels(plan, view);
  return plan;
}

}  // namespace piblocks
