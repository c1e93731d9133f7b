#include <algorithm>
#include <cmath>

#include "draw/overlays/loupe.hpp"
#include "draw/stage/stage.hpp"

namespace piblocks {
namespace {

// In fractions of the frame's shorter side.
constexpr double kHeight = 0.27;  ///< of the inset, at most
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

constexpr double kBelowLine_em = 0.3;  ///< from the baseline of the article's counter

/// Computes in a frame that is mirrored if the anchor is on the right.
class LoupePlacer {
 public:
  LoupePlacer(const DrawingContext& context, const FramePlan& plan, const LoupeGap& gap,
              const LoupeTexts& texts)
      : context_(context), plan_(plan), gap_(gap), texts_(texts) {}

  std::optional<LoupePlace> find() const {
    // Below the least size of type nothing could be read.
    if (style::kLeastType * short_side() < style::kLeastText_px) return std::nullopt;
    if (!gap_.between) return above_meeting();
    if (gap_.is_stage) {
      const double lines = kStageLines * short_side();
      return at(right() - width(), stage_top() - lines, false);
    }
    const double farthest = right() - width();
    const double floor = context_.layout.floor_px - loupe_style::kOutside * short_side();
    const double beside = blocks_right() + texts_.zoom_px + loupe_style::kOutside * short_side();
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
      if (is_zoom_beside) least += texts_.zoom_px + loupe_style::kOutside * short_side();
      const double left = std::min(std::max(middle - width() / 2, least), right() - width());
      return left < least ? std::nullopt : at(left, stage_top(), is_zoom_beside);
    };
    std::optional<LoupePlace> found = place(false);
    return found ? found : place(true);
  }

  double short_side() const { return context_.sizes.short_side; }
  double row() const { return loupe_style::kRow_em * context_.sizes.text; }
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
    return right + loupe_style::kOutside * short_side();
  }

  /// Upper end of the room for something in these columns.
  double top(const Rect& columns) const {
    const bool is_article = context_.scene.view.theme == Theme::article;
    const CountLine& line = context_.layout.count_line;
    double top = std::max(plan_.stage.y, context_.sizes.margin);
    if (gap_.is_stage) top = std::max(top, kStageTop * context_.scene.view.height_px);
    if (is_article) {
      top = std::max(top, line.label.y + kBelowLine_em * line.text_px);
    } else if (columns.right() + loupe_style::kOutside * short_side() >
               plan_.counter.pi_row_left_px) {
      top = std::max(top, plan_.header_bottom_px);
    }
    return std::ceil(top + loupe_style::kOutside / 2 * short_side());
  }

  /// Upper end of all that is above the floor.
  double stage_top() const {
    const Show& show = context_.scene.show;
    const Layout& layout = context_.layout;
    double above = loupe_style::kOutside;
    if (show.has(Overlay::velocities)) above += kArrowRoom;
    if (!labelled_above(context_, layout).empty()) above += kMassRoom;
    return layout.top_px() - above * short_side();
  }

  double rows_px(bool is_zoom_beside) const {
    if (gap_.is_stage) return row();  // both are beside each other
    return row() * ((texts_.has_slow_motion ? 1 : 0) + (is_zoom_beside ? 0 : 1));
  }

  std::optional<LoupePlace> at(double left, double bottom, bool is_zoom_beside) const {
    const double rows = rows_px(is_zoom_beside);
    const double least = rows + (loupe_style::kBelowFloor + loupe_style::kAboveBlocks +
                                 loupe_style::kInside + kLeastBlocks) *
                                    short_side();
    const double lower = std::floor(bottom);
    const double x = gap_.side > 0 ? left : context_.scene.view.width_px - left - width();
    Rect bounds{std::floor(x), 0, width(), 0};
    const double most = (gap_.is_stage ? kStageHeight : kHeight) * short_side();
    bounds.height = std::floor(std::min(most, lower - top(bounds)));
    bounds.y = lower - bounds.height;
    if (bounds.height < least || left < context_.sizes.margin) return std::nullopt;
    const double lines = stage_top() + loupe_style::kOutside * short_side();
    return LoupePlace{bounds, rows, is_zoom_beside, lines};
  }

  const DrawingContext& context_;
  const FramePlan& plan_;
  const LoupeGap& gap_;
  const LoupeTexts& texts_;
};

}  // namespace

double loupe_width_px(const View& view, const Sizes& sizes, bool is_stage) {
  if (!is_stage) return std::round(style::kLoupeWidth * sizes.short_side);
  if (view.width_px <= view.height_px) return std::floor(view.width_px - 2 * sizes.margin);
  return std::round(kStageWidth * view.width_px);
}

std::optional<LoupePlace> find_loupe_place(const DrawingContext& context, const FramePlan& plan,
                                           const LoupeGap& gap, const LoupeTexts& texts) {
  return LoupePlacer(context, plan, gap, texts).find();
}

}  // namespace piblocks
