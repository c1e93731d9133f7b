#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include "draw/layout.hpp"
#include "draw/look.hpp"
#include "draw/overlays/overlays.hpp"

namespace piblocks {
namespace {

// In ems.
constexpr double kTitleDescent = 0.24;
constexpr double kBelowTitle = 0.25;
/// Least side of a diagram.
constexpr double kLeastPanel_em = 8;
/// A line that has to be smaller than this part of its planned size is too long.
constexpr double kLeastTitleShrink = 0.5;
/// The width of a diagram that looks best, in parts of its height.
constexpr double kPanelAspect = 1.3;
/// Least height for the blocks and all that is not title, caption or logo, in parts of the frame's.
constexpr double kLeastLeft = 0.25;
/// Heights of the stage where there are diagrams, in parts of what title, caption and logo leave.
constexpr double kLeastStage = 0.22;
constexpr double kMostStage = 0.46;

/// The grid in which `count` panels come out largest, if possible with no side below `least`.
std::vector<Rectangle> panel_grid(std::size_t count, const Rectangle& area, double gap,
                                  double least) {
  const auto side = [gap](double length, std::size_t n) {
    return (length - gap * double(n - 1)) / double(n);
  };
  const auto cell = [&](std::size_t columns) {
    const std::size_t rows = (count + columns - 1) / columns;
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
  std::vector<Rectangle> cells(count, cell(best));
  for (std::size_t i = 0; i < count; ++i) {
    Rectangle& place = cells[i];
    const std::size_t row = i / best;
    // A last row that is not full is centred.
    const std::size_t in_row = std::min(best, count - row * best);
    const double shift = double(best - in_row) * (place.width + gap) / 2;
    place.x = area.x + shift + double(i % best) * (place.width + gap);
    place.y = area.y + double(row) * (place.height + gap);
  }
  return cells;
}

/// What a scene shows above and below the blocks, for a message.
std::vector<std::string> names_of_lines(const Scene& scene) {
  std::vector<std::string> names;
  if (!scene.show.title.empty()) names.emplace_back("the title");
  if (!scene.show.caption.empty()) names.emplace_back("the caption");
  if (!scene.show.logo.empty()) names.emplace_back("the logo");
  for (const Overlay overlay : {Overlay::time, Overlay::energy, Overlay::momentum}) {
    if (scene.show.has(overlay)) names.push_back(fmt::format("'{}'", exact_text(overlay)));
  }
  if (has_slow_motion(scene.pacing)) names.emplace_back("the slow motion's factor");
  return names;
}

/// Places things from the edges of the frame inwards. The stage gets what is left.
class FramePlanner {
 public:
  explicit FramePlanner(const DrawingContext& context)
      : context_(context),
        view_(context.scene.view),
        show_(context.scene.show),
        measure_(short_measure(view_)),
        margin_(style::kMargin * measure_),
        right_(view_.width_px - margin_),
        bottom_(view_.height_px - margin_) {
    plan_.stage = whole(view_);
  }

  FramePlan run(double read_outs_px) {
    place_title();
    place_foot();
    if (show_.panels.empty()) {
      plan_.stage.height -= read_outs_px;
      // Else read-outs would stick to the lower edge.
      const bool are_lowest = !plan_.caption && show_.logo.empty();
      if (read_outs_px > 0 && are_lowest) plan_.stage.height -= margin_ / 2;
      check_stage(plan_.stage.height);
    } else {
      check_stage(plan_.stage.height - read_outs_px);
      place_panels(read_outs_px);
    }
    return std::move(plan_);
  }

 private:
  /// Centres a line in `room`, and makes it smaller to fit. Its baseline is set later.
  /// @param key  named in messages
  void set_line(const char* key, TextItem& line, const Rectangle& room) const {
    context_.font.check(line.text, key);
    const double planned_px = line.size_px;
    if (planned_px < style::kLeastText_px) {
      const bool is_low = view_.height_px < kNarrow * view_.width_px;
      throw UsageError(fmt::format(
          "{}: '{}' would be {:.1f} pixels high in {}x{}, which cannot be read; leave it out, or "
          "make the frame {}",
          key, line.text, planned_px, view_.width_px, view_.height_px,
          is_low ? "higher" : "wider"));
    }
    line.size_px = context_.font.fitted_px(line.text, planned_px, room.width);
    if (line.size_px < std::max(kLeastTitleShrink * planned_px, style::kLeastText_px)) {
      throw UsageError(
          fmt::format("{}: '{}' is too long to be read in {:.0f} pixels; shorten it, or "
                      "make the frame wider",
                      key, line.text, room.width));
    }
    line.origin.x = room.x + (room.width - context_.font.width_em(line.text) * line.size_px) / 2;
  }

  /// The title is at the top; the stage begins below.
  void place_title() {
    double top = 0;
    if (!show_.title.empty()) {
      const double size_px = style::kTitle * measure_;
      const double baseline = std::round(margin_ + Font::kCapHeight_em * size_px);
      plan_.title = {ItemId::title, {0, baseline}, show_.title, size_px, context_.palette.text};
      set_line("show.title", *plan_.title, {margin_, 0, right_ - margin_, 0});
      top = baseline + (kTitleDescent + kBelowTitle) * size_px;
    } else if (!show_.panels.empty()) {
      // Else the counter would stick to the upper edge.
      top = margin_ / 2;
    }
    plan_.stage.y += top;
    plan_.stage.height -= top;
  }

  /// Caption and logo are at the bottom; the stage ends above.
  void place_foot() {
    double height = 0;
    Rectangle room{margin_, 0, right_ - margin_, 0};
    if (!show_.logo.empty()) {
      const double logo_width = style::kLogoWidth * measure_;
      height = style::kLogoHeight * measure_;
      plan_.logo = {right_ - logo_width, bottom_ - height, logo_width, height};
      // The other side stays free as well, so that the caption is in the middle.
      room.x += logo_width + margin_;
      room.width -= 2 * (logo_width + margin_);
    }
    if (!show_.caption.empty()) {
      const double size_px = style::kCaption * measure_;
      height = std::max(height, (Font::kCapHeight_em + kTitleDescent) * size_px);
      const double baseline = std::round(bottom_ - (height - Font::kCapHeight_em * size_px) / 2);
      plan_.caption = {
          ItemId::caption, {0, baseline}, show_.caption, size_px, context_.palette.muted};
      set_line("show.caption", *plan_.caption, room);
    }
    if (height > 0) plan_.stage.height -= height + margin_;
  }

  /// Diagrams are below the stage and its read-outs.
  void place_panels(double read_outs_px) {
    const Rectangle area = plan_.stage;
    // At this height the stage is as wide as the frame.
    const double lengths =
        to_double(view_.y.high - view_.y.low) / to_double(view_.x.high - view_.x.low);
    plan_.stage.height = std::clamp(area.width * lengths + 0.2 * measure_,
                                    kLeastStage * area.height, kMostStage * area.height);
    const double top = area.y + plan_.stage.height + read_outs_px + margin_ / 2;
    const double bottom = area.y + area.height - margin_;
    const double least = kLeastPanel_em * context_.text_px;
    plan_.panels = panel_grid(show_.panels.size(), {margin_, top, right_ - margin_, bottom - top},
                              style::kPanelGap * measure_, least);
    const Rectangle& panel = plan_.panels.front();
    if (std::min(panel.width, panel.height) >= least) return;
    const std::size_t count = show_.panels.size();
    throw UsageError(fmt::format(
        "show.panels: {} into {}x{}; {}make the frame larger",
        count == 1 ? "a diagram does not fit" : fmt::format("{} diagrams do not fit", count),
        view_.width_px, view_.height_px, count == 1 ? "" : "leave some out, or "));
  }

  void check_stage(double height_px) const {
    if (height_px >= kLeastLeft * view_.height_px) return;
    throw UsageError(fmt::format(
        "show: beside {} there is too little room for the blocks in {}x{}; leave something out, or "
        "make the frame higher",
        fmt::join(names_of_lines(context_.scene), ", "), view_.width_px, view_.height_px));
  }

  const DrawingContext& context_;
  const View& view_;
  const Show& show_;
  double measure_;
  double margin_;
  double right_;
  double bottom_;
  FramePlan plan_;
};

}  // namespace

FramePlan plan_frame(const DrawingContext& context, double read_outs_px) {
  return FramePlanner(context).run(read_outs_px);
}

}  // namespace piblocks
