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

constexpr long kMostPower = 300;
/// Heights of the blocks in the inset differ by this factor at most.
constexpr double kMaxInsetHeightRatio = 1.6;

}  // namespace

std::shared_ptr<const LoupeInset> LoupeInset::make(const DrawingContext& context,
                                                   const FramePlan& plan) {
  const std::optional<LoupeGap> gap = loupe_gap(context);
  if (!gap) return nullptr;
  auto inset = std::shared_ptr<LoupeInset>(new LoupeInset(context, *gap));
  if (const auto place = find_loupe_place(context, plan, *gap, inset->texts())) {
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
      window_zoom_([&]() -> std::optional<double> {
        if (!gap.window) return std::nullopt;
        return to_double(context.scene.show.loupe->window->zoom);
      }()),
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
  for (long exponent = loupe_style::kLeastPower; exponent <= most; ++exponent) {
    powers_.push_back(setter.raised(setter.text("10"), setter.text(std::to_string(exponent))));
    widest_em = std::max(widest_em, widths_.width_em("×8.8·") + powers_.back().width_em());
  }
  widest_zoom_px_ = widest_em * sizes_.mass;
  if (has_slow_motion(context.scene.pacing)) {
    SlowMotionLabel label = slow_motion_label(context);
    const double width = context.font.width_em(label.widest) * sizes_.text;
    // Else it stays among the read-outs.
    if (width <= (style::kLoupeWidth - 2 * loupe_style::kInside) * sizes_.short_side) {
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
  const double anchor = anchor_ ? kBlockWidth : loupe_style::kInside + style::kWallWidth;
  face_px_ = std::round(sizes_.grid_line + anchor * short_side);
  between_px_ = gap_.between ? std::round(wider * kBlockWidth * short_side) : 0;
  room_px_ = bounds_.width - face_px_ - between_px_ - wider * kLeastOuter * short_side;
  floor_px_ = std::round(bounds_.height - loupe_style::kBelowFloor * short_side);
  const double room =
      floor_px_ - found.rows_px - (loupe_style::kInside + loupe_style::kAboveBlocks) * short_side;
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

  const double baseline = loupe_style::kInside * short_side + sizes_.text;
  slow_baseline_px_ = baseline;
  const double inner = gap_.side > 0 ? bounds_.x : bounds_.right();  // the edge at the blocks
  if (found.is_zoom_beside) {
    is_zoom_end_left_ = gap_.side < 0;
    zoom_end_ = {inner - gap_.side * loupe_style::kOutside * short_side,
                 bounds_.y + bounds_.height / 2 + kHalfFigure_em * sizes_.mass};
  } else {
    const double row = slow_text_ && !gap_.is_stage ? loupe_style::kRow_em * sizes_.text : 0;
    zoom_end_ = {bounds_.right() - loupe_style::kInside * short_side, bounds_.y + baseline + row};
  }
  const double bottom = bounds_.bottom();
  if (bottom < layout.top_px()) {
    corners_ = {Point{bounds_.x, bottom}, Point{bounds_.right(), bottom}};
    lines_y_ = found.lines_px;
  } else {
    corners_ = {Point{inner, bounds_.y}, Point{inner, bottom}};
    lines_y_ = layout.floor_px - layout.height_px(inner_block) / 2;
  }
  place_scenery(context);
}

Rect LoupeInset::mirrored(const Rect& r) const {
  return gap_.side > 0 ? r : Rect{bounds_.width - r.right(), r.y, r.width, r.height};
}

Point LoupeInset::mirrored(const Point& p) const {
  return gap_.side > 0 ? p : Point{bounds_.width - p.x, p.y};
}

void LoupeInset::place_scenery(const DrawingContext& context) {
  const double line = sizes_.wall_line;
  const double top = floor_px_ - std::max(inner_height_px_, outer_height_px_) -
                     loupe_style::kAboveBlocks / 2 * sizes_.short_side;
  const double floor_left = anchor_ ? 0 : face_px_ - line;
  std::vector<DrawItem> items;
  if (!anchor_) {
    Point from = mirrored(Point{face_px_, top});
    Point to = mirrored(Point{face_px_, floor_px_ + line});
    if (gap_.side < 0) std::swap(from, to);
    items = hatched_face(from, to, FaceStyle(context), kWallHatch);
  }
  items.emplace_back(RectangleItem{nth(ItemId::wall, items.size()),
                                   mirrored(Rect{floor_left, floor_px_, bounds_.width, line}),
                                   palette_.wall});
  scenery_ = plate_of(ItemId::wall, {0, 0, bounds_.width, bounds_.height}, std::move(items));
}

}  // namespace piblocks
