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

// Of the break in blue, in fractions of the frame's shorter side.
constexpr double kCutWidth = 0.016;
constexpr double kCutSlant = 0.02;
/// Where the lines to the inset begin, in parts of red's width from the gap.
constexpr double kLinesInRed = 0.6;
/// The share of its window in which the loupe fades in, and out.
constexpr double kWindowFade = 0.1;
/// At this many hits a frame or more, blue may be anywhere between wall and red, and the loupe
/// shows mostly the interval that blue sweeps. Below a quarter of this it shows only the block.
constexpr double kSweepHits = 1;
constexpr double kSweepAlpha = 0.5;
constexpr double kFastBlue = 0.35;  ///< alpha of blue then

}  // namespace

double LoupeInset::opacity(const FrameState& shown) const {
  const double from_px = style::kMaxLoupeGap * sizes_.short_side;
  const double gap_px = shown.gaps.y2 * scale_;
  double opacity = (from_px - gap_px) / (from_px * (1 - loupe_style::kFullyShown));
  if (window_) {
    const Rational way =
        (shown.time - window_->span.from) / (window_->span.to - window_->span.from);
    const double from_end = to_double(std::min<Rational>(way, 1 - way));
    opacity = std::min(opacity, from_end / kWindowFade);
  }
  return std::clamp(opacity, 0.0, 1.0);
}

double LoupeInset::zoom(double gap) const {
  const double room = room_px_ / (gap * scale_);
  return window_ ? std::max(1.0, std::min(window_->zoom, room)) : zoom_.factor_for(room);
}

/// They begin behind red, or above it: between the blocks they would be in the way.
void LoupeInset::add_lines(const FrameState& shown, std::vector<DrawItem>& items) const {
  const double seen = opacity(shown);
  if (seen <= 0) return;
  const Rect red = stage_.at(blocks_.red_id, shown);
  // By whole pixels, they stay as they are while red hardly moves.
  const Point from{std::round(red.x + kLinesInRed * red.width), lines_y_};
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
  const double zoomed = zoom(shown.gaps.y2);
  items.emplace_back(GroupItem{ItemId::loupe, bounds_,
                               std::make_shared<const DrawList>(picture(shown, zoomed)), seen});
  add_zoom(zoomed, faded(palette_.text, seen), items);
}

DrawList LoupeInset::picture(const FrameState& shown, double zoomed) const {
  const double px_per_unit = scale_ * zoomed;
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

void LoupeInset::add_marks(const FrameState& shown, double px_per_unit,
                           std::vector<DrawItem>& items) const {
  const Contact wall =
      contact_of(face_px_, floor_px_, HUGE_VAL, blue_height_px_, palette_.blue.line);
  const auto blocks = [&](double gap) {
    return contact_of(face_px_ + gap * px_per_unit + blue_width_px_, floor_px_, blue_height_px_,
                      red_height_px_, palette_.red.line);
  };
  const auto is_of_blocks = [&](const Hit& hit) {
    return hit.pair[0] == blocks_.red_id || hit.pair[1] == blocks_.red_id;
  };
  for (std::size_t n = 0; n < shown.hits.size(); ++n) {
    const Hit& hit = shown.hits[n];
    marks_->add_arc(nth(ItemId::hits, n), hit.age_s, is_of_blocks(hit) ? blocks(hit.gaps.y2) : wall,
                    items);
  }
  marks_->add_glow(shown.hits_per_s, std::array{wall, blocks(shown.gaps.y2)}, items);
}

void LoupeInset::add_blocks(const FrameState& shown, double px_per_unit,
                            std::vector<DrawItem>& items) const {
  const double red_x = face_px_ + shown.gaps.y2 * px_per_unit + blue_width_px_;
  // Red's far side is outside.
  const double red_width = std::max(0.0, bounds_.width - red_x) + 2 * line_px_;
  add_rectangles(ItemId::red_block,
                 block_at({red_x, floor_px_ - red_height_px_, red_width, red_height_px_},
                          palette_.red, line_px_),
                 items);
  const double hits = shown.hits_per_s / frames_per_s_;
  const double swept =
      std::clamp((hits - kSweepHits / 4) / (kSweepHits - kSweepHits / 4), 0.0, 1.0);
  if (swept > 0) {
    items.emplace_back(
        RectangleItem{nth(ItemId::red_block, kSweep),
                      {face_px_, floor_px_ - blue_height_px_, red_x - face_px_, blue_height_px_},
                      faded(palette_.blue.fill, swept * kSweepAlpha),
                      std::nullopt});
  }
  add_blue(face_px_ + shown.gaps.y1 * px_per_unit, 1 - swept * (1 - kFastBlue), items);
}

void LoupeInset::add_blue(double x_px, double seen, std::vector<DrawItem>& items) const {
  const double top = floor_px_ - blue_height_px_;
  BlockColors colors = palette_.blue;
  colors.fill = faded(colors.fill, seen);
  colors.edge = faded(colors.edge, seen);
  add_rectangles(ItemId::blue_block,
                 block_at({x_px, top, blue_width_px_, blue_height_px_}, colors, line_px_), items);
  const double half = kCutWidth / 2 * sizes_.short_side;
  const double slant = kCutSlant / 2 * sizes_.short_side;
  const double middle = x_px + blue_width_px_ / 2;
  items.emplace_back(PathItem{nth(ItemId::blue_block, kCut),
                              std::vector<Point>{{middle - half + slant, top},
                                                 {middle + half + slant, top},
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
  const Point left{zoom_right_.x - width_em * size_px, zoom_right_.y};
  const double text_px = widths_.width_em(text) * size_px;
  items.emplace_back(TextItem{nth(ItemId::loupe, 1), left, std::move(text), size_px, color, face_});
  if (power != nullptr) {
    power->add_to(items, nth(ItemId::loupe, 2), {left.x + text_px, left.y}, size_px, color);
  }
}

}  // namespace piblocks
