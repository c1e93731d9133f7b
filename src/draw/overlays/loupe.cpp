#include "draw/overlays/loupe.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/rounded.hpp"
#include "draw/number_text.hpp"
#include "draw/stage/stage.hpp"
#include "scene/pacing.hpp"

namespace piblocks {
namespace {

// In fractions of the frame's shorter side.
constexpr double kBlocksHeight = 0.2;  ///< of the taller block, at most
constexpr double kBlockWidth = 0.068;  ///< cut: enlarged like the gap, it would have no room
constexpr double kLeastOuter = 0.04;   ///< what is seen of the outer block at least

constexpr double kBelowFloor = 0.025;
constexpr double kAboveBlocks = 0.015;
constexpr double kOutside = 0.025;  ///< between the inset and what is around it
constexpr double kHeight = 0.27;    ///< of the inset, at most
// Of one that is as wide as most of the frame; its width in parts of a wide frame's.
constexpr double kStageWidth = 0.7;
constexpr double kStageTop = 0.25;
constexpr double kStageHeight = 0.5;
constexpr double kStageLines = 0.05;
constexpr double kLeastBlocks = 0.075;
/// Between blocks and zoom, for the lines from the one to the other.
constexpr double kLinesLength = 0.16;
// Room for figures of velocities and masses that reach beyond their block.
constexpr double kVelocityOverhang = 0.12;
constexpr double kMassOverhang = 0.08;

constexpr long kMostPower = 300;
/// Heights of the blocks in the inset differ by this factor at most.
constexpr double kMaxInsetHeightRatio = 1.6;
constexpr double kRow_em = 1.35;       ///< from one row of text to the next
constexpr double kBelowLine_em = 0.3;  ///< from the baseline of the article's counter

/// Width of the inset, in pixels.
double loupe_width_px(const View& view, const Sizes& sizes, bool is_stage) {
  if (!is_stage) return std::round(style::kLoupeWidth * sizes.short_side);
  if (view.width_px <= view.height_px) return std::floor(view.width_px - 2 * sizes.margin);
  return std::round(kStageWidth * view.width_px);
}

/// Room for the inset beside two blocks, on the side that they leave to; or above all blocks.
/// Computes in a frame that is mirrored if the anchor is on the right.
class LoupePlacer {
 public:
  /// @param zoom_px  width of the longest zoom
  LoupePlacer(const DrawingContext& context, const FramePlan& plan, const LoupeGap& gap,
              double zoom_px, bool has_slow_motion)
      : context_(context),
        plan_(plan),
        gap_(gap),
        zoom_px_(zoom_px),
        has_slow_motion_(has_slow_motion) {}

  /// Nothing if there is no room.
  std::optional<LoupePlace> find() const {
    // Below the least size of type nothing could be read.
    if (style::kLeastType * short_side() < style::kLeastText_px) return std::nullopt;
    if (!gap_.between) return above_meeting();
    if (gap_.is_stage) {
      const double lines = kStageLines * short_side();
      return at(right() - width(), stage_top() - lines, false);
    }
    const double farthest = right() - width();
    const double floor = context_.layout.floor_px - kOutside * short_side();
    const double beside = blocks_right() + zoom_px_ + kOutside * short_side();
    std::optional<LoupePlace> found;
    if (beside <= farthest) {
      found = at(std::min(farthest, beside + kLinesLength * short_side()), floor, true);
      // The digits of pi may be in the way there, and not farther to the left.
      if (!found) found = at(beside, floor, true);
    }
    if (!found && blocks_right() <= farthest) found = at(farthest, floor, false);
    if (!found) found = at(farthest, stage_top(), false);
    return found;
  }

 private:
  /// Blocks may come from both sides.
  std::optional<LoupePlace> above_meeting() const {
    const double frame = context_.scene.view.width_px;
    const double meeting = context_.layout.at(gap_.meeting, 0).x;
    const double middle = gap_.side > 0 ? meeting : frame - meeting;
    const auto place = [&](bool is_zoom_beside) {
      double least = context_.sizes.margin;
      if (gap_.side < 0) least = std::max(least, frame - context_.layout.content_right_px);
      if (is_zoom_beside) least += zoom_px_ + kOutside * short_side();
      const double left = std::min(std::max(middle - width() / 2, least), right() - width());
      return left < least ? std::nullopt : at(left, stage_top(), is_zoom_beside);
    };
    std::optional<LoupePlace> found = place(false);
    return found ? found : place(true);
  }

  double short_side() const { return context_.sizes.short_side; }
  double row() const { return kRow_em * context_.sizes.text; }
  double width() const {
    return loupe_width_px(context_.scene.view, context_.sizes, gap_.is_stage);
  }
  double right() const {
    const View& view = context_.scene.view;
    // The counter may be beside the stage.
    const bool is_article = view.theme == Theme::article;
    return is_article || gap_.side < 0 ? view.width_px - context_.sizes.margin
                                       : context_.layout.content_right_px;
  }

  /// The blocks and what is above them stay left of this while the loupe is seen.
  double blocks_right() const {
    const Layout& layout = context_.layout;
    const Show& show = context_.scene.show;
    const TwoBlocks& blocks = context_.two_blocks().blocks();
    const double face = layout.at(gap_.side * to_double(blocks.wall_face), 0).x;
    double right = (gap_.side > 0 ? face : context_.scene.view.width_px - face) +
                   style::kMaxLoupeGap * short_side() + layout.width_px(*gap_.between) +
                   layout.width_px(gap_.outer);
    if (show.has(Overlay::velocities)) right += kVelocityOverhang * short_side();
    if (!labelled_above(context_, layout).empty()) right += kMassOverhang * short_side();
    return right + kOutside * short_side();
  }

  /// Upper end of the room for something in these columns.
  double top(const Rect& columns) const {
    const bool is_article = context_.scene.view.theme == Theme::article;
    const CountLine& line = context_.layout.count_line;
    double top = std::max(plan_.stage.y, context_.sizes.margin);
    if (gap_.is_stage) top = std::max(top, kStageTop * context_.scene.view.height_px);
    if (is_article) {
      top = std::max(top, line.label.y + kBelowLine_em * line.text_px);
    } else if (columns.right() + kOutside * short_side() > plan_.counter.pi_row_left_px) {
      top = std::max(top, plan_.header_bottom_px);
    }
    return std::ceil(top + kOutside / 2 * short_side());
  }

  /// Upper end of all that is above the floor.
  double stage_top() const {
    const Show& show = context_.scene.show;
    const Layout& layout = context_.layout;
    double above = kOutside;
    if (show.has(Overlay::velocities)) above += kArrowRoom;
    if (!labelled_above(context_, layout).empty()) above += kMassRoom;
    return layout.top_px() - above * short_side();
  }

  double rows_px(bool is_zoom_beside) const {
    if (gap_.is_stage) return row();  // both are beside each other
    return row() * ((has_slow_motion_ ? 1 : 0) + (is_zoom_beside ? 0 : 1));
  }

  std::optional<LoupePlace> at(double left, double bottom, bool is_zoom_beside) const {
    const double rows = rows_px(is_zoom_beside);
    const double least =
        rows + (kBelowFloor + kAboveBlocks + LoupeInset::kInside + kLeastBlocks) * short_side();
    const double lower = std::floor(bottom);
    const double x = gap_.side > 0 ? left : context_.scene.view.width_px - left - width();
    Rect bounds{std::floor(x), 0, width(), 0};
    const double most = (gap_.is_stage ? kStageHeight : kHeight) * short_side();
    bounds.height = std::floor(std::min(most, lower - top(bounds)));
    bounds.y = lower - bounds.height;
    if (bounds.height < least || left < context_.sizes.margin) return std::nullopt;
    const double lines = stage_top() + kOutside * short_side();
    return LoupePlace{bounds, rows, is_zoom_beside, lines};
  }

  const DrawingContext& context_;
  const FramePlan& plan_;
  const LoupeGap& gap_;
  double zoom_px_;
  bool has_slow_motion_;
};

}  // namespace

std::shared_ptr<const LoupeInset> LoupeInset::make(const DrawingContext& context,
                                                   const FramePlan& plan) {
  const std::optional<LoupeGap> gap = loupe_gap(context);
  if (!gap) return nullptr;
  auto inset = std::shared_ptr<LoupeInset>(new LoupeInset(context, *gap));
  const LoupePlacer placer(context, plan, *gap, inset->widest_zoom_px_, inset->shows_slow_motion());
  if (const auto place = placer.find()) {
    inset->place(context, *place);
    return inset;
  }
  if (!gap->window && !gap->is_stage) return nullptr;
  const View& view = context.scene.view;
  throw UsageError("show.loupe",
                   fmt::format("there is no room for it in {}x{}; make the frame larger, or leave "
                               "out diagrams, overlays or the loupe",
                               view.width_px, view.height_px));
}

LoupeInset::LoupeInset(const DrawingContext& context, const LoupeGap& gap)
    : gap_(gap),
      sizes_(context.sizes),
      palette_(context.palette),
      face_(context.font.face()),
      frames_per_s_(to_double(context.scene.view.frame_rate)),
      background_(background_of(context.scene.view)),
      window_zoom_(gap.window ? std::optional(to_double(context.scene.show.loupe->window->zoom))
                              : std::nullopt),
      zoom_([&] {
        double most = std::floor(rounded::log10(
            loupe_width_px(context.scene.view, sizes_, gap.is_stage) / gap.least_px));
        if (window_zoom_) most = std::max(most, rounded::log10(*window_zoom_) + 1);
        return static_cast<long>(std::clamp<double>(most, 1, kMostPower));
      }()),
      widths_(context.font, "0123456789,.×·"),
      stage_(context.layout),
      outer_(context.colors[gap.outer]),
      hit_color_(color_of_hit(gap.meeting_pair(), context.scene.system, context.colors)) {
  if (gap.between) between_ = context.colors[*gap.between];
  if (gap.anchor < context.colors.size()) anchor_ = context.colors[gap.anchor];
  for (long exponent = 0; exponent <= zoom_.most_exponent(); ++exponent) {
    if (!window_zoom_ || zoom_.power(exponent) < *window_zoom_) {
      zooms_.push_back(zoom_.power(exponent));
    }
  }
  if (window_zoom_) zooms_.push_back(*window_zoom_);
  const FormulaSetter setter = context.setter();
  const long most = zoom_.most_exponent() + 1;
  double widest_em = widths_.width_em("×8,888");
  for (long exponent = kLeastPower; exponent <= most; ++exponent) {
    powers_.push_back(setter.raised(setter.text("10"), setter.text(std::to_string(exponent))));
    widest_em = std::max(widest_em, widths_.width_em("×8.8·") + powers_.back().width_em());
  }
  widest_zoom_px_ = widest_em * sizes_.mass;
  if (has_slow_motion(context.scene.pacing)) {
    SlowMotionLabel label = slow_motion_label(context);
    const double width = context.font.width_em(label.widest) * sizes_.text;
    // Else it stays among the read-outs.
    if (width <= (style::kLoupeWidth - 2 * kInside) * sizes_.short_side) {
      slow_text_ = std::move(label.text);
    }
  }
}

void LoupeInset::place(const DrawingContext& context, const LoupePlace& found) {
  const double short_side = sizes_.short_side;
  const Layout& layout = context.layout;
  bounds_ = found.bounds;
  // All widths in a wider inset are so much larger.
  const double wider = bounds_.width / (style::kLoupeWidth * short_side);
  const double anchor = anchor_ ? kBlockWidth : kInside + style::kWallWidth;
  face_px_ = std::round(sizes_.grid_line + anchor * short_side);
  between_px_ = gap_.between ? std::round(wider * kBlockWidth * short_side) : 0;
  room_px_ = bounds_.width - face_px_ - between_px_ - wider * kLeastOuter * short_side;
  floor_px_ = std::round(bounds_.height - kBelowFloor * short_side);
  const double room = floor_px_ - found.rows_px - (kInside + kAboveBlocks) * short_side;
  const double taller = std::round(std::min(wider * kBlocksHeight * short_side, room));
  const std::size_t inner_block = gap_.between.value_or(anchor_ ? gap_.anchor : gap_.outer);
  const double ratio = std::clamp(layout.height_px(gap_.outer) / layout.height_px(inner_block),
                                  1 / kMaxInsetHeightRatio, kMaxInsetHeightRatio);
  inner_height_px_ = std::round(taller / std::max(1.0, ratio));
  outer_height_px_ = std::round(taller * std::min(1.0, ratio));
  // What stands still beside two blocks is as high as both.
  anchor_height_px_ =
      gap_.between ? std::max(inner_height_px_, outer_height_px_) : inner_height_px_;
  if (context.shows_hits()) {
    marks_.emplace(context, HUGE_VAL, HUGE_VAL);
  }

  const double baseline = kInside * short_side + sizes_.text;
  slow_baseline_px_ = baseline;
  const double inner = gap_.side > 0 ? bounds_.x : bounds_.right();  // the edge at the blocks
  if (found.is_zoom_beside) {
    is_zoom_end_left_ = gap_.side < 0;
    zoom_end_ = {inner - gap_.side * kOutside * short_side,
                 bounds_.y + bounds_.height / 2 + kHalfFigure_em * sizes_.mass};
  } else {
    const double row = slow_text_ && !gap_.is_stage ? kRow_em * sizes_.text : 0;
    zoom_end_ = {bounds_.right() - kInside * short_side, bounds_.y + baseline + row};
  }
  const double bottom = bounds_.bottom();
  if (bottom < layout.top_px()) {
    corners_ = {Point{bounds_.x, bottom}, Point{bounds_.right(), bottom}};
    lines_y_ = found.lines_px;
  } else {
    corners_ = {Point{inner, bounds_.y}, Point{inner, bottom}};
    lines_y_ = layout.floor_px - layout.height_px(inner_block) / 2;
  }
  place_scenery();
}

Rect LoupeInset::mirrored(const Rect& r) const {
  return gap_.side > 0 ? r : Rect{bounds_.width - r.right(), r.y, r.width, r.height};
}

Point LoupeInset::mirrored(const Point& p) const {
  return gap_.side > 0 ? p : Point{bounds_.width - p.x, p.y};
}

void LoupeInset::place_scenery() {
  const double line = sizes_.wall_line;
  const double top = floor_px_ - std::max(inner_height_px_, outer_height_px_) -
                     kAboveBlocks / 2 * sizes_.short_side;
  const double floor_left = anchor_ ? 0 : face_px_ - line;
  std::vector<DrawItem> items;
  if (!anchor_) {
    Point from = mirrored(Point{face_px_, top});
    Point to = mirrored(Point{face_px_, floor_px_ + line});
    if (gap_.side < 0) std::swap(from, to);
    items = hatched_face(from, to, palette_, sizes_, kWallHatch);
  }
  items.emplace_back(RectangleItem{nth(ItemId::wall, items.size()),
                                   mirrored(Rect{floor_left, floor_px_, bounds_.width, line}),
                                   palette_.wall});
  scenery_ = plate_of(ItemId::wall, {0, 0, bounds_.width, bounds_.height}, std::move(items));
}

}  // namespace piblocks
