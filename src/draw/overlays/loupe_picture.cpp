#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "draw/number_text.hpp"
#include "draw/overlays/loupe.hpp"
#include "draw/stage/stage.hpp"

namespace piblocks {
namespace {

// Of the break in the block between, in fractions of the frame's shorter side.
constexpr double kCutWidth = 0.016;
constexpr double kCutSlant = 0.02;
/// Where the lines to the inset begin, in parts of the outer block's width from the gap.
constexpr double kLinesInOuter = 0.6;
/// The share of its window in which the loupe fades in, and out.
constexpr double kWindowFade = 0.1;
/// At this many hits a frame or more, the block between may be anywhere in the gap, and the loupe
/// shows mostly the interval that it sweeps. Below a quarter of this it shows only the block.
constexpr double kSweepHits = 1;
constexpr double kSweepAlpha = 0.5;
constexpr double kFastBlock = 0.35;  ///< alpha of the block then

}  // namespace

double LoupeInset::opacity(const FrameState& shown) const {
  const double from_px = style::kMaxLoupeGap * sizes_.short_side;
  const double gap_px = gap_.gaps_in(shown, stage_).y2 * stage_.scale;
  double opacity = (from_px - gap_px) / (from_px * (1 - loupe_style::kFullyShown));
  if (gap_.window) {
    const Rational way = (shown.time - gap_.window->from) / (gap_.window->to - gap_.window->from);
    const double from_end = to_double(std::min<Rational>(way, 1 - way));
    opacity = std::min(opacity, from_end / kWindowFade);
  }
  return std::clamp(opacity, 0.0, 1.0);
}

double LoupeInset::zoom(double gap) const {
  const double room = room_px_ / (gap * stage_.scale);
  return window_zoom_ ? std::max(1.0, std::min(*window_zoom_, room)) : zoom_.factor_for(room);
}

/// They begin behind the outer block, or above it: between the blocks they would be in the way.
void LoupeInset::add_lines(const FrameState& shown, std::vector<DrawItem>& items) const {
  const double seen = opacity(shown);
  if (seen <= 0) return;
  const Rect outer = stage_.at(gap_.outer, shown);
  const double inside = kLinesInOuter * outer.width;
  // By whole pixels, they stay as they are while the block hardly moves.
  const Point from{std::round(gap_.side > 0 ? outer.x + inside : outer.right() - inside), lines_y_};
  const Stroke stroke{faded(palette_.muted, seen), sizes_.grid_line};
  for (std::size_t n = 0; n < corners_.size(); ++n) {
    items.emplace_back(PathItem{nth(ItemId::wall, kFirstLine + n),
                                std::vector<Point>{from, corners_.at(n)}, false, std::nullopt,
                                stroke});
  }
}

void LoupeInset::operator()(const FrameState& shown, std::vector<DrawItem>& items) const {
  const double seen = opacity(shown);
  if (seen <= 0) return;
  const double zoomed = zoom(gap_.gaps_in(shown, stage_).y2);
  items.emplace_back(GroupItem{ItemId::loupe, bounds_,
                               std::make_shared<const DrawList>(picture(shown, zoomed)), seen});
  add_zoom(zoomed, faded(palette_.text, seen), items);
}

DrawList LoupeInset::picture(const FrameState& shown, double zoomed) const {
  const double px_per_unit = stage_.scale * zoomed;
  DrawList list{static_cast<int>(bounds_.width), static_cast<int>(bounds_.height), background_, {}};
  list.items.emplace_back(scenery_);
  add_blocks(shown, px_per_unit, list.items);
  std::string slow = slow_text_ ? slow_text_(shown) : std::string();
  if (!slow.empty()) {
    list.items.emplace_back(TextItem{ItemId::label,
                                     {loupe_style::kInside * sizes_.short_side, slow_baseline_px_},
                                     std::move(slow),
                                     sizes_.text,
                                     palette_.accent,
                                     face_});
  }
  if (marks_) add_marks(shown, px_per_unit, list.items);
  list.items.emplace_back(RectangleItem{ItemId::loupe,
                                        {0, 0, bounds_.width, bounds_.height},
                                        std::nullopt,
                                        Stroke{palette_.muted, sizes_.grid_line}});
  return list;
}

Contact LoupeInset::contact_at(double x_px, double left_px, double right_px,
                               const Color& color) const {
  if (gap_.side < 0) std::swap(left_px, right_px);
  return contact_of(mirrored(Point{x_px, 0}).x, floor_px_, left_px, right_px, color);
}

void LoupeInset::add_marks(const FrameState& shown, double px_per_unit,
                           std::vector<DrawItem>& items) const {
  const double inner = gap_.between || anchor_ ? inner_height_px_ : HUGE_VAL;
  const auto at_outer = [&](double gap) {
    return contact_at(face_px_ + gap * px_per_unit + between_px_, inner, outer_height_px_,
                      hit_color_);
  };
  const Contact at_anchor =
      contact_at(face_px_, anchor_ ? anchor_height_px_ : HUGE_VAL, inner_height_px_, between_.line);
  for (std::size_t n = 0; n < shown.hits.size(); ++n) {
    const Hit& hit = shown.hits[n];
    const bool is_outer = hit.pair == gap_.meeting_pair();
    if (!gap_.between && !is_outer) continue;
    marks_->add_arc(nth(ItemId::hits, n), hit.age_s, is_outer ? at_outer(hit.gaps.y2) : at_anchor,
                    items);
  }
  const double gap = gap_.gaps_in(shown, stage_).y2;
  if (gap_.between) {
    std::array both{at_anchor, at_outer(gap)};
    if (gap_.side < 0) std::swap(both[0], both[1]);
    marks_->add_glow(shown.hits_per_s, both, items);
  } else if (std::ranges::count(shown.met_pairs, gap_.meeting_pair()) > 0) {
    marks_->add_glow(shown.hits_per_s, std::array{at_outer(gap)}, items);
  }
}

void LoupeInset::add_blocks(const FrameState& shown, double px_per_unit,
                            std::vector<DrawItem>& items) const {
  const Gaps gaps = gap_.gaps_in(shown, stage_);
  const auto add = [&](ItemId id, double left, double right, double height,
                       const BlockColors& colors) {
    const Rect block{left, floor_px_ - height, std::max(0.0, right - left), height};
    add_rectangles(id, block_at(mirrored(block), colors, line_px_), items);
  };
  // The far sides are outside.
  const double beyond = 2 * line_px_;
  const double outer_x = face_px_ + gaps.y2 * px_per_unit + between_px_;
  if (anchor_) add(nth(ItemId::wall, kAnchor), -beyond, face_px_, anchor_height_px_, *anchor_);
  add(ItemId::red_block, outer_x, std::max(outer_x, bounds_.width) + beyond, outer_height_px_,
      outer_);
  if (!gap_.between) return;
  const double hits = shown.hits_per_s / frames_per_s_;
  const double swept =
      std::clamp((hits - kSweepHits / 4) / (kSweepHits - kSweepHits / 4), 0.0, 1.0);
  if (swept > 0) {
    items.emplace_back(RectangleItem{nth(ItemId::red_block, kSweep),
                                     mirrored(Rect{face_px_, floor_px_ - inner_height_px_,
                                                   outer_x - face_px_, inner_height_px_}),
                                     faded(between_.fill, swept * kSweepAlpha), std::nullopt});
  }
  add_between(face_px_ + gaps.y1 * px_per_unit, 1 - swept * (1 - kFastBlock), items);
}

void LoupeInset::add_between(double x_px, double seen, std::vector<DrawItem>& items) const {
  const Rect block =
      mirrored(Rect{x_px, floor_px_ - inner_height_px_, between_px_, inner_height_px_});
  BlockColors colors = between_;
  colors.fill = faded(colors.fill, seen);
  colors.edge = faded(colors.edge, seen);
  add_rectangles(ItemId::blue_block, block_at(block, colors, line_px_), items);
  const double half = kCutWidth / 2 * sizes_.short_side;
  const double slant = kCutSlant / 2 * sizes_.short_side;
  const double middle = block.x + block.width / 2;
  items.emplace_back(PathItem{nth(ItemId::blue_block, kCut),
                              std::vector<Point>{{middle - half + slant, block.y},
                                                 {middle + half + slant, block.y},
                                                 {middle + half - slant, floor_px_},
                                                 {middle - half - slant, floor_px_}},
                              true, faded(palette_.background, seen), std::nullopt});
}

/// "×100" and "×10⁷" where the zoom stays; two digits, as "×3.5·10⁷", where it does not.
void LoupeInset::add_zoom(double zoomed, const Color& color, std::vector<DrawItem>& items) const {
  zoomed = std::min(zoomed, zoom_.power(zoom_.most_exponent()));
  long exponent = zoom_.exponent_of(zoomed);
  long tens = std::lround(zoomed / zoom_.power(exponent) * 10);
  if (tens >= 100) {
    ++exponent;
    tens = 10;
  }
  const double size_px = sizes_.mass;
  const double digits = double(tens) / 10;
  const bool is_plain = exponent < loupe_style::kLeastPower;
  std::string text = "×";
  if (is_plain) {
    text += fixed_text(digits * zoom_.power(exponent), exponent == 0 ? 1 : 0);
  } else if (tens > 10) {
    text += fixed_text(digits, 1) + "·";
  }
  const Formula* const power =
      is_plain ? nullptr
               : &powers_.at(static_cast<std::size_t>(exponent - loupe_style::kLeastPower));
  const double width_em = widths_.width_em(text) + (power != nullptr ? power->width_em() : 0);
  const Point left{zoom_end_.x - (is_zoom_end_left_ ? 0 : width_em * size_px), zoom_end_.y};
  const double text_px = widths_.width_em(text) * size_px;
  items.emplace_back(TextItem{nth(ItemId::loupe, 1), left, std::move(text), size_px, color, face_});
  if (power != nullptr) {
    power->add_to(items, nth(ItemId::loupe, 2), {left.x + text_px, left.y}, size_px, color);
  }
}

}  // namespace piblocks
