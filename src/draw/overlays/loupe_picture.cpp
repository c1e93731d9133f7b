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

// Of the tear in the block between, in fractions of the frame's shorter side.
constexpr double kTearWidth = 0.012;
constexpr double kTearTooth = 0.014;  ///< height and depth
/// Where it is, in parts of the block's width.
constexpr double kTearAt = 0.25;
/// Where the lines to the inset begin, in parts of the outer block's width from the gap.
constexpr double kLinesInOuter = 0.6;
/// The loupe is seen in full below this share of the gap at which it begins to be seen.
constexpr double kFullyShown = 0.5;
/// The share of its window in which the loupe fades in, and out.
constexpr double kWindowFade = 0.1;
/// At this many hits a frame or more, the block between may be anywhere in the gap, and the loupe
/// shows mostly the interval that it sweeps. Below a quarter of this it shows only the block.
constexpr double kSweepHits = 1;
constexpr double kSweepAlpha = 0.5;
constexpr double kFastBlock = 0.35;  ///< alpha of the block then

}  // namespace

double LoupeInset::gap_px(const FrameState& shown) const {
  return gap_.gaps_in(shown, stage_).y2 * stage_.scale;
}

double LoupeInset::opacity(const FrameState& shown) const {
  const double from_px = style::kMaxLoupeGap * sizes_.short_side;
  double opacity = (from_px - gap_px(shown)) / (from_px * (1 - kFullyShown));
  if (gap_.window) {
    const Rational way = (shown.time - gap_.window->from) / (gap_.window->to - gap_.window->from);
    const double from_end = to_double(std::min<Rational>(way, 1 - way));
    opacity = std::min(opacity, from_end / kWindowFade);
  }
  return std::clamp(opacity, 0.0, 1.0);
}

double LoupeInset::level(const FrameState& shown) const {
  const auto level_of = [&](const FrameState& state) {
    const auto above = std::ranges::upper_bound(zooms_, room_px_ / gap_px(state));
    return static_cast<int>(std::max<std::ptrdiff_t>(1, above - zooms_.begin())) - 1;
  };
  if (!shown.moment) return level_of(shown);
  return eased_level([&](double from_now_s) { return level_of(shown.moment(from_now_s)); });
}

/// Below the first level the gap fills the inset, which shows more than no zoom would.
double LoupeInset::zoom_at(double level, const FrameState& shown) const {
  if (level < 1) return std::clamp(room_px_ / gap_px(shown), 1.0, zooms_[1]);
  const auto below = static_cast<std::size_t>(level);
  if (double(below) == level) return zooms_[below];
  const double ratio = zooms_[below + 1] / zooms_[below];
  return zooms_[below] * straight_exp2((level - double(below)) * straight_log2(ratio));
}

/// They begin above the outer block; or behind it, where its far side is when the gap is closed, so
/// that they stay while the gap is small. Between the blocks they would be in the way.
void LoupeInset::add_lines(const FrameState& shown, std::vector<DrawItem>& items) const {
  const double seen = opacity(shown);
  if (seen <= 0) return;
  const Rect outer = stage_.at(gap_.outer, shown);
  double inside = kLinesInOuter * outer.width;
  const bool is_behind = lines_y_ > outer.y;
  if (is_behind) inside = std::max(inside, outer.width - gap_px(shown));
  // By whole pixels, they stay as they are while the block hardly moves.
  const Point from{std::round(gap_.side > 0 ? outer.x + inside : outer.right() - inside), lines_y_};
  const Stroke stroke{faded(palette_.muted, seen), sizes_.grid_line};
  for (std::size_t n = 0; n < corners_.size(); ++n) {
    items.emplace_back(
        line_item(nth(ItemId::wall, kFirstLine + n), {from, corners_.at(n)}, stroke));
  }
}

void LoupeInset::operator()(const FrameState& shown, std::vector<DrawItem>& items) const {
  const double seen = opacity(shown);
  if (seen <= 0) return;
  const double now = level(shown);
  const double zoomed = zoom_at(now, shown);
  items.emplace_back(
      GroupItem{ItemId::loupe, bounds_,
                std::make_shared<const DrawList>(picture(shown, stage_.scale * zoomed)), seen});
  // The label names one entry of zooms_: between two entries the nearer one.
  if (zoomed < zooms_[1]) return;
  const auto nearest = static_cast<std::size_t>(std::max(1L, std::lround(now)));
  add_zoom(zooms_[nearest], faded(palette_.text, seen), items);
}

DrawList LoupeInset::picture(const FrameState& shown, double px_per_unit) const {
  DrawList list{static_cast<int>(bounds_.width), static_cast<int>(bounds_.height), background_, {}};
  list.items.emplace_back(scenery_);
  add_blocks(shown, px_per_unit, list.items);
  std::string slow = slow_text_ ? slow_text_(shown) : std::string();
  if (!slow.empty()) {
    const Point at{kInside * sizes_.short_side, slow_baseline_px_};
    list.items.emplace_back(
        TextItem{ItemId::label, at, std::move(slow), sizes_.text, palette_.accent, face_});
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
  const SeenBlocks blocks = blocks_of(shown, px_per_unit);
  for (std::size_t n = 0; n < shown.hits.size(); ++n) {
    const Hit& hit = shown.hits[n];
    const bool is_outer = hit.pair == gap_.meeting_pair();
    if (!gap_.between && !is_outer) continue;
    marks_->add_arc(n, hit.age_s, is_outer ? at_outer(hit.gaps.y2) : at_anchor, items);
    std::optional<Rect> left = gap_.between && is_outer ? blocks.between : blocks.anchor;
    std::optional<Rect> right = is_outer ? blocks.outer : blocks.between;
    if (gap_.side < 0) std::swap(left, right);
    marks_->add_edges(n, hit.age_s, left, right, items);
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
  const auto add = [&](ItemId id, const Rect& block, const BlockColors& colors) {
    add_rectangles(id, block_at(block, colors, stage_), items);
  };
  const SeenBlocks blocks = blocks_of(shown, px_per_unit);
  if (blocks.anchor) add(nth(ItemId::wall, kAnchor), *blocks.anchor, *anchor_);
  add(ItemId::red_block, blocks.outer, outer_);
  if (!blocks.between) return;
  const double hits = shown.hits_per_s / frames_per_s_;
  const double swept =
      std::clamp((hits - kSweepHits / 4) / (kSweepHits - kSweepHits / 4), 0.0, 1.0);
  if (swept > 0) {
    const double outer_x = mirrored(blocks.outer).x;
    items.emplace_back(RectangleItem{nth(ItemId::red_block, kSweep),
                                     mirrored(Rect{face_px_, floor_px_ - inner_height_px_,
                                                   outer_x - face_px_, inner_height_px_}),
                                     faded(between_.fill, swept * kSweepAlpha)});
  }
  const double seen = 1 - swept * (1 - kFastBlock);
  BlockColors colors = between_;
  colors.fill = faded(colors.fill, seen);
  colors.edge = faded(colors.edge, seen);
  add(ItemId::blue_block, *blocks.between, colors);
  add_tear(*blocks.between, faded(palette_.background, seen), items);
}

LoupeInset::SeenBlocks LoupeInset::blocks_of(const FrameState& shown, double px_per_unit) const {
  const Gaps gaps = gap_.gaps_in(shown, stage_);
  const auto block = [&](double left, double width, double height) {
    return mirrored(Rect{left, floor_px_ - height, width, height});
  };
  // The far sides are outside.
  const double beyond = 2 * (stage_.line_px + stage_.corner_px);
  const double outer_x = face_px_ + gaps.y2 * px_per_unit + between_px_;
  SeenBlocks blocks;
  if (anchor_) blocks.anchor = block(-beyond, face_px_ + beyond, anchor_height_px_);
  if (gap_.between) {
    blocks.between = block(face_px_ + gaps.y1 * px_per_unit, between_px_, inner_height_px_);
  }
  blocks.outer = block(outer_x, std::max(0.0, bounds_.width - outer_x) + beyond, outer_height_px_);
  return blocks;
}

/// Near the anchor, for the enlarged block would reach far beyond it.
void LoupeInset::add_tear(const Rect& block, const Color& color,
                          std::vector<DrawItem>& items) const {
  const double tooth = kTearTooth * sizes_.short_side;
  const double along = kTearAt * block.width;
  const double left = gap_.side > 0 ? block.x + along : block.right() - along;
  const int teeth = 2 * std::max(1, static_cast<int>(std::round(block.height / (2 * tooth)))) + 1;
  std::vector<Point> edge;
  for (int i = 0; i <= teeth; ++i) {
    const double aside = (i % 2 == 0 ? -tooth : tooth) / 2;
    edge.push_back({left + aside, block.y + block.height * i / teeth});
  }
  std::vector<Point> outline = edge;
  const Point across{kTearWidth * sizes_.short_side, 0};
  for (auto at = edge.rbegin(); at != edge.rend(); ++at) outline.push_back(*at + across);
  items.emplace_back(PathItem{nth(ItemId::blue_block, kCut), std::move(outline), true, color});
}

/// "×100" and "×10⁷"; of a window's zoom two digits, as "×3.5·10⁷".
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
  const bool is_plain = exponent < kLeastPower;
  std::string text = "×";
  if (is_plain) {
    text += fixed_text(digits * zoom_.power(exponent), exponent == 0 ? 1 : 0);
  } else if (tens > 10) {
    text += fixed_text(digits, 1) + "·";
  }
  const Formula* const power =
      is_plain ? nullptr : &powers_.at(static_cast<std::size_t>(exponent - kLeastPower));
  const double width_em = widths_.width_em(text) + (power != nullptr ? power->width_em() : 0);
  const Point left{zoom_end_.x - (is_zoom_end_left_ ? 0 : width_em * size_px), zoom_end_.y};
  const double text_px = widths_.width_em(text) * size_px;
  items.emplace_back(TextItem{nth(ItemId::loupe, 1), left, std::move(text), size_px, color, face_});
  if (power != nullptr) {
    power->add_to(items, nth(ItemId::loupe, 2), {left.x + text_px, left.y}, size_px, color);
  }
}

}  // namespace piblocks
