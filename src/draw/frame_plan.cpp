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
constexpr double kLogoHeight = 0.09;
constexpr double kLogoWidth = 0.24;
constexpr double kPanelGap = 0.035;
// In ems.
constexpr double kDescent = 0.24;
constexpr double kBelowTitle = 0.25;
/// A line may be set so much smaller than planned; beyond that it is too long.
constexpr double kLeastShrink = 0.5;
/// Least side of a diagram, in ems of its text.
constexpr double kLeastPanel_em = 8;
/// What diagrams look best in.
constexpr double kPanelAspect = 1.3;
/// Of the frame's height, for the blocks and what else there is.
constexpr double kLeastLeft = 0.25;
/// Of what is left beside title and caption, where there are diagrams.
constexpr double kLeastStage = 0.22;
constexpr double kMostStage = 0.46;

Rectangle whole(const View& view) { return {0, 0, double(view.width_px), double(view.height_px)}; }

/// A centred line that is made smaller to fit. @param key  named in messages.
TextItem set_line(ItemId id, const char* key, const std::string& text, double size_px,
                  const Rectangle& area, const View& view, const Color& color, const Font& font) {
  font.check(text, key);
  if (size_px < kLeastText_px) {
    const bool is_low = view.height_px < kNarrow * view.width_px;
    throw UsageError(fmt::format(
        "{}: '{}' would be {:.1f} pixels high in {}x{}, which cannot be read; leave it out, or "
        "make the frame {}",
        key, text, size_px, view.width_px, view.height_px, is_low ? "higher" : "wider"));
  }
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
    if (std::min(panel.width, panel.height) >= least) continue;
    throw UsageError(
        plan.panels.size() == 1
            ? fmt::format("show.panels: a diagram does not fit into {}x{}; make the frame larger",
                          view.width_px, view.height_px)
            : fmt::format("show.panels: {} diagrams do not fit into {}x{}; leave some out, or "
                          "make the frame larger",
                          plan.panels.size(), view.width_px, view.height_px));
  }
}

/// What a scene shows above and below the blocks.
std::vector<std::string> lines_of(const Scene& scene) {
  std::vector<std::string> lines;
  if (!scene.show.title.empty()) lines.emplace_back("the title");
  if (!scene.show.caption.empty()) lines.emplace_back("the caption");
  if (!scene.show.logo.empty()) lines.emplace_back("the logo");
  for (const Overlay overlay : {Overlay::time, Overlay::energy, Overlay::momentum}) {
    if (scene.show.has(overlay)) lines.push_back(fmt::format("'{}'", exact_text(overlay)));
  }
  if (has_slow_motion(scene.pacing)) lines.emplace_back("the slow motion's factor");
  return lines;
}

/// @param height_px  what is left of the frame for the blocks.
void check_stage(const Scene& scene, double height_px) {
  const View& view = scene.view;
  if (height_px >= kLeastLeft * view.height_px) return;
  throw UsageError(fmt::format(
      "show: beside {} there is too little room for the blocks in {}x{}; leave something out, or "
      "make the frame higher",
      fmt::join(lines_of(scene), ", "), view.width_px, view.height_px));
}

/// What the stage needs to be as wide as the area.
double stage_height(const View& view, const Rectangle& area, double measure) {
  const double lengths = to_double(view.y.high - view.y.low) / to_double(view.x.high - view.x.low);
  return std::clamp(area.width * lengths + 0.2 * measure, kLeastStage * area.height,
                    kMostStage * area.height);
}

/// What lengths in a frame are in proportion to.
struct FrameMeasures {
  explicit FrameMeasures(const View& frame)
      : view(frame),
        measure(short_measure(whole(frame))),
        margin(kMargin * measure),
        right(frame.width_px - margin),
        bottom(frame.height_px - margin) {}

  /// Between the margins.
  Rectangle line() const { return {margin, 0, right - margin, 0}; }

  const View& view;
  double measure;
  double margin;
  double right;
  double bottom;
};

/// At the top; what is left of the stage begins below.
void place_title(const Show& show, const FrameMeasures& frame, const Palette& palette,
                 const Font& font, FramePlan& plan) {
  double top = 0;
  if (!show.title.empty()) {
    const double size_px = kTitleSize * frame.measure;
    plan.title = set_line(ItemId::title, "show.title", show.title, size_px, frame.line(),
                          frame.view, palette.text, font);
    plan.title->origin.y = std::round(frame.margin + Font::kCapHeight_em * size_px);
    top = plan.title->origin.y + (kDescent + kBelowTitle) * size_px;
  } else if (!show.panels.empty()) {
    // Else the counter would stick to the upper edge.
    top = frame.margin / 2;
  }
  plan.stage.y += top;
  plan.stage.height -= top;
}

/// Caption and logo, at the bottom; what is left of the stage ends above.
void place_foot(const Show& show, const FrameMeasures& frame, const Palette& palette,
                const Font& font, FramePlan& plan) {
  double height = 0;
  Rectangle line = frame.line();
  if (!show.logo.empty()) {
    const double logo_width = kLogoWidth * frame.measure;
    height = kLogoHeight * frame.measure;
    plan.logo = {frame.right - logo_width, frame.bottom - height, logo_width, height};
    // As much is left free on the other side, so that the caption stays in the middle.
    line.x += logo_width + frame.margin;
    line.width -= 2 * (logo_width + frame.margin);
  }
  if (!show.caption.empty()) {
    const double size_px = kCaptionSize * frame.measure;
    plan.caption = set_line(ItemId::caption, "show.caption", show.caption, size_px, line,
                            frame.view, palette.muted, font);
    height = std::max(height, (Font::kCapHeight_em + kDescent) * size_px);
    plan.caption->origin.y =
        std::round(frame.bottom - (height - Font::kCapHeight_em * size_px) / 2);
  }
  if (height > 0) plan.stage.height -= height + frame.margin;
}

/// Below the stage and its read-outs, which together get what they need at least.
void place_panels(const Scene& scene, const FrameMeasures& frame, double read_outs_px,
                  FramePlan& plan) {
  const double bottom = plan.stage.y + plan.stage.height - frame.margin;
  plan.stage.height = stage_height(scene.view, plan.stage, frame.measure);
  const double top = plan.stage.y + plan.stage.height + read_outs_px + frame.margin / 2;
  plan.panels =
      grid(scene.show.panels.size(), {frame.margin, top, frame.right - frame.margin, bottom - top},
           kPanelGap * frame.measure, kLeastPanel_em * plan.text_px);
  check_panels(plan, scene.view);
}

}  // namespace

double small_text_px(const View& view) {
  return std::max(kLeastText_px, kSmallText * short_measure(whole(view)));
}

Rectangle read_out_area(const View& view) {
  const double margin = kMargin * short_measure(whole(view));
  return {margin, 0, view.width_px - 2 * margin, 0};
}

FramePlan plan_frame(const Scene& scene, const Palette& palette, const Font& font,
                     double read_outs_px) {
  const FrameMeasures measures{scene.view};
  FramePlan plan;
  plan.text_px = small_text_px(scene.view);
  plan.line_px = std::max(1.0, line_width_px(scene.view) / 2);
  plan.stage = whole(scene.view);
  place_title(scene.show, measures, palette, font, plan);
  place_foot(scene.show, measures, palette, font, plan);
  if (scene.show.panels.empty()) {
    plan.stage.height -= read_outs_px;
    // Else read-outs would stick to the lower edge.
    const bool are_lowest = !plan.caption && scene.show.logo.empty();
    if (read_outs_px > 0 && are_lowest) plan.stage.height -= measures.margin / 2;
    check_stage(scene, plan.stage.height);
  } else {
    check_stage(scene, plan.stage.height - read_outs_px);
    place_panels(scene, measures, read_outs_px, plan);
  }
  return plan;
}

}  // namespace piblocks
