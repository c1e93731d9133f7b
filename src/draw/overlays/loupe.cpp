#include "draw/overlays/loupe.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "draw/number_text.hpp"
#include "draw/overlays/stage_parts.hpp"
#include "scene/pacing.hpp"

namespace piblocks {
namespace {

// In fractions of the frame's shorter side.
constexpr double kHeight = 0.27;       ///< of the inset, at most
constexpr double kBlocksHeight = 0.2;  ///< of the taller block, at most
constexpr double kLeastBlocks = 0.075;
constexpr double kBelowFloor = 0.025;
constexpr double kAboveBlocks = 0.015;
constexpr double kInside = 0.012;     ///< between the inset's edges and what is in it
constexpr double kOutside = 0.025;    ///< between the inset and what is around it
constexpr double kBlueWidth = 0.068;  ///< cut: enlarged like the gaps, it would have no room
constexpr double kLeastRed = 0.04;    ///< what is seen of red at least
constexpr double kCutWidth = 0.016;   ///< of the break in blue
constexpr double kCutSlant = 0.02;
/// Between blocks and zoom, for the lines from the one to the other.
constexpr double kLinesLength = 0.16;
// Room for figures of velocities and masses that reach beyond their block.
constexpr double kVelocityOverhang = 0.12;
constexpr double kMassOverhang = 0.08;

constexpr double kRow_em = 1.35;
constexpr double kBelowBaseline_em = 0.3;
/// From this exponent on a zoom is written as a power of ten.
constexpr long kLeastPower = 4;
constexpr long kMostPower = 300;
/// The loupe is seen in full below this share of the gap at which it begins to be seen.
constexpr double kFullyShown = 0.5;
/// The share of its window in which it fades in, and out.
constexpr double kWindowFade = 0.1;
/// From so many hits a frame on, blue seems to be at any place between wall and red, and what is
/// seen of it most is the way that it sweeps. Below a quarter of this only the block is seen.
constexpr double kSweepHits = 1;
constexpr double kSweepAlpha = 0.5;
constexpr double kFastBlue = 0.35;  ///< alpha of blue then
/// Heights of the blocks in the inset differ by this factor at most.
constexpr double kMostHeights = 1.6;

std::optional<Loupe> loupe_of(const Scene& scene) {
  const Theme theme = scene.view.theme;
  const bool is_lecture = theme == Theme::lecture || theme == Theme::lecture_light;
  Loupe loupe = scene.show.loupe.value_or(Loupe{.is_on = is_lecture});
  return loupe.is_on ? std::optional(std::move(loupe)) : std::nullopt;
}

/// The gap between wall and red when it is about least.
double least_gap(const DrawingContext& context) {
  const std::optional<Rational> turn = turn_of(context.scene.system);
  return gaps_at(context.log, turn.value_or(0)).y2;
}

}  // namespace

/// Finds room for the inset: to the right of the blocks, or above them.
class LoupeInset::Placer {
 public:
  /// @param zoom_px  width of the longest zoom
  Placer(const DrawingContext& context, const FramePlan& plan, double zoom_px)
      : context_(context), plan_(plan), zoom_px_(zoom_px) {}

  std::optional<Place> find() const {
    // Below the least size of type nothing could be read.
    if (style::kLeastType * unit() < style::kLeastText_px) return std::nullopt;
    const double farthest = right() - width();
    const double floor = context_.layout.floor_px - kOutside * unit();
    const double beside = blocks_right() + zoom_px_ + kOutside * unit();
    std::optional<Place> found;
    if (beside <= farthest) {
      found = at(std::min(farthest, beside + kLinesLength * unit()), floor, true);
      // The digits of pi may be in the way there, and not farther to the left.
      if (!found) found = at(beside, floor, true);
    }
    if (!found && blocks_right() <= farthest) found = at(farthest, floor, false);
    if (!found) found = at(farthest, stage_top(), false);
    return found;
  }

 private:
  double unit() const { return context_.sizes.unit; }
  double row() const { return kRow_em * context_.sizes.text; }
  double width() const { return std::round(style::kLoupe * unit()); }
  double right() const {
    const View& view = context_.scene.view;
    // The counter may be beside the stage.
    const bool is_article = view.theme == Theme::article;
    return is_article ? view.width_px - context_.sizes.margin : context_.layout.right_px;
  }

  /// Red and what is above it stay left of this while the loupe is seen.
  double blocks_right() const {
    const Layout& layout = context_.layout;
    const Show& show = context_.scene.show;
    const double face = layout.at(to_double(context_.scene.system.wall_face), 0).x;
    double right =
        face + style::kLoupeFrom * unit() + (layout.blue.width + layout.red.width) * layout.scale;
    if (show.has(Overlay::velocities)) right += kVelocityOverhang * unit();
    if (show.has(Overlay::masses) && has_mass_above(context_.scene, layout, context_.font)) {
      right += kMassOverhang * unit();
    }
    return right + kOutside * unit();
  }

  /// Upper end of the room for something that reaches from `left` to the right.
  double top(double left) const {
    const bool is_article = context_.scene.view.theme == Theme::article;
    const CountLine& line = context_.layout.line;
    double top = std::max(plan_.stage.y, context_.sizes.margin);
    if (is_article) {
      top = std::max(top, line.label.y + kBelowBaseline_em * line.text_px);
    } else if (left + width() + kOutside * unit() > plan_.counter.pi_left_px) {
      top = std::max(top, plan_.header_px);
    }
    return std::ceil(top + kOutside / 2 * unit());
  }

  /// Upper end of all that is above the floor.
  double stage_top() const {
    const Show& show = context_.scene.show;
    const Layout& layout = context_.layout;
    double above = kOutside;
    if (show.has(Overlay::velocities)) above += kArrowRoom;
    if (show.has(Overlay::masses) && has_mass_above(context_.scene, layout, context_.font)) {
      above += kMassRoom;
    }
    return layout.top_px() - above * unit();
  }

  double rows_px(bool is_zoom_beside) const {
    const int slow_motion = has_slow_motion(context_.scene.pacing) ? 1 : 0;
    return row() * (slow_motion + (is_zoom_beside ? 0 : 1));
  }

  std::optional<Place> at(double left, double bottom, bool is_zoom_beside) const {
    const double rows = rows_px(is_zoom_beside);
    const double least = rows + (kBelowFloor + kAboveBlocks + kInside + kLeastBlocks) * unit();
    const double lower = std::floor(bottom);
    const double height = std::floor(std::min(kHeight * unit(), lower - top(left)));
    if (height < least || left < context_.sizes.margin) return std::nullopt;
    return Place{{std::floor(left), lower - height, width(), height}, rows, is_zoom_beside};
  }

  const DrawingContext& context_;
  const FramePlan& plan_;
  double zoom_px_;
};

bool may_show_loupe(const DrawingContext& context) {
  const View& view = context.scene.view;
  if (!shows_wall(context.scene) || !loupe_of(context.scene)) return false;
  // The stage's scale is known only once there is a stage. It is not larger.
  const double scale = view.width_px / to_double(view.x.high - context.scene.system.wall_face);
  return least_gap(context) * scale < style::kLoupeFrom * context.sizes.unit;
}

std::shared_ptr<const LoupeInset> LoupeInset::make(const DrawingContext& context,
                                                   const FramePlan& plan) {
  const Scene& scene = context.scene;
  const std::optional<Loupe> loupe = loupe_of(scene);
  if (!loupe) return nullptr;
  const bool is_asked_for = loupe->window.has_value();
  const double gap_px = least_gap(context) * context.layout.scale;
  if (!shows_wall(scene)) {
    if (!is_asked_for) return nullptr;
    throw UsageError(
        "show.loupe: it enlarges the gap at the wall, which the view does not show; let view.x "
        "reach from below wall.face, or leave the loupe out");
  }
  const bool is_small = gap_px < style::kLoupeFrom * context.sizes.unit;
  if (!is_asked_for && !is_small) return nullptr;
  auto inset = std::shared_ptr<LoupeInset>(new LoupeInset(context, *loupe, gap_px));
  const std::optional<Place> place = Placer(context, plan, inset->widest_zoom_px_).find();
  if (place) {
    inset->settle(context, *place);
    return inset;
  }
  if (!is_asked_for) return nullptr;
  throw UsageError(
      fmt::format("show.loupe: there is no room for it in {}x{}; make the frame larger, or leave "
                  "out diagrams, overlays or the loupe",
                  scene.view.width_px, scene.view.height_px));
}

LoupeInset::LoupeInset(const DrawingContext& context, const Loupe& loupe, double least_gap_px)
    : sizes_(context.sizes),
      palette_(context.palette),
      face_(context.font.face()),
      scale_(context.layout.scale),
      frames_per_s_(to_double(context.scene.view.frame_rate)),
      line_px_(context.layout.line_px),
      background_(background_of(context.scene.view)),
      zoom_([&] {
        const double most = std::floor(std::log10(style::kLoupe * sizes_.unit / least_gap_px));
        return static_cast<long>(std::clamp<double>(most, 1, kMostPower));
      }()),
      widths_(context.font, "0123456789,.×·") {
  context.needs.gaps = true;
  if (loupe.window) {
    constexpr const char* kKey = "show.loupe";
    window_ = Window{time_of(loupe.window->from, kKey, context.log),
                     time_of(loupe.window->to, kKey, context.log), to_double(loupe.window->zoom)};
    if (window_->from >= window_->to) {
      throw UsageError(fmt::format("{}: its window from {} to {} ends before it begins", kKey,
                                   to_text(window_->from), to_text(window_->to)));
    }
  }
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
    if (width <= (style::kLoupe - 2 * kInside) * sizes_.unit) slow_text_ = std::move(label.text);
  }
}

void LoupeInset::settle(const DrawingContext& context, const Place& place) {
  const double unit = sizes_.unit;
  const Layout& layout = context.layout;
  bounds_ = place.bounds;
  face_px_ = std::round(sizes_.grid_line + (kInside + style::kHatch) * unit);
  blue_px_ = std::round(kBlueWidth * unit);
  room_px_ = bounds_.width - face_px_ - blue_px_ - kLeastRed * unit;
  const double floor_px = std::round(bounds_.height - kBelowFloor * unit);
  const double room = floor_px - place.rows_px - (kInside + kAboveBlocks) * unit;
  const double taller = std::round(std::min(kBlocksHeight * unit, room));
  const double ratio =
      std::clamp(layout.red.height_px / layout.blue.height_px, 1 / kMostHeights, kMostHeights);
  shapes_ = {floor_px, std::round(taller / std::max(1.0, ratio)),
             std::round(taller * std::min(1.0, ratio)), HUGE_VAL};
  if (context.scene.show.hits && context.scene.view.theme != Theme::article) {
    marks_.emplace(context, shapes_, HUGE_VAL);
  }

  const double baseline = kInside * unit + sizes_.text;
  slow_baseline_px_ = baseline;
  if (place.is_zoom_beside) {
    zoom_right_ = {bounds_.x - kOutside * unit,
                   bounds_.y + bounds_.height / 2 + kHalfFigure_em * sizes_.mass};
  } else {
    const double row = slow_text_ ? kRow_em * sizes_.text : 0;
    zoom_right_ = {bounds_.x + bounds_.width - kInside * unit, bounds_.y + baseline + row};
  }
  place_lines(context);
  place_scenery(context);
}

void LoupeInset::place_lines(const DrawingContext& context) {
  const Layout& layout = context.layout;
  const Point gap{layout.at(to_double(context.scene.system.wall_face), 0).x,
                  layout.floor_px - layout.blue.height_px / 2};
  const double right = bounds_.x + bounds_.width;
  const double bottom = bounds_.y + bounds_.height;
  const bool is_above = bottom < layout.top_px();
  const Point first = is_above ? Point{bounds_.x, bottom} : Point{bounds_.x, bounds_.y};
  const Point second = is_above ? Point{right, bottom} : Point{bounds_.x, bottom};
  lines_ = {Points({gap, first}), Points({gap, second})};
  std::vector<DrawItem> items;
  add_lines(1, items);
  const double top = std::min(first.y, gap.y) - 1;
  const Rectangle around{gap.x - 1, top, std::max(first.x, second.x) - gap.x + 2,
                         std::max(second.y, gap.y) - top + 2};
  full_lines_ = plate_of(nth(ItemId::wall, kFirstLine), around, std::move(items));
}

void LoupeInset::place_scenery(const DrawingContext& context) {
  const double line = sizes_.wall_line;
  const double top =
      shapes_.floor_px - std::max(shapes_.blue_px, shapes_.red_px) - kAboveBlocks / 2 * sizes_.unit;
  std::vector<DrawItem> items = wall_items({face_px_, top, shapes_.floor_px + line}, context);
  items.emplace_back(RectangleItem{nth(ItemId::wall, items.size()),
                                   {face_px_ - line, shapes_.floor_px, bounds_.width, line},
                                   palette_.wall,
                                   std::nullopt});
  scenery_ = plate_of(ItemId::wall, {0, 0, bounds_.width, bounds_.height}, std::move(items));
}

double LoupeInset::opacity(const FrameState& shown) const {
  const double from_px = style::kLoupeFrom * sizes_.unit;
  const double gap_px = shown.gaps.y2 * scale_;
  double opacity = (from_px - gap_px) / (from_px * (1 - kFullyShown));
  if (window_) {
    const Rational way = (shown.time - window_->from) / (window_->to - window_->from);
    const double from_end = to_double(std::min<Rational>(way, 1 - way));
    opacity = std::min(opacity, from_end / kWindowFade);
  }
  return std::clamp(opacity, 0.0, 1.0);
}

double LoupeInset::zoom(double gap) const {
  const double room = room_px_ / (gap * scale_);
  return window_ ? std::max(1.0, std::min(window_->zoom, room)) : zoom_.of(room);
}

void LoupeInset::add_lines(const FrameState& shown, std::vector<DrawItem>& items) const {
  const double seen = opacity(shown);
  if (seen >= 1) {
    items.emplace_back(full_lines_);
  } else if (seen > 0) {
    add_lines(seen, items);
  }
}

void LoupeInset::add_lines(double seen, std::vector<DrawItem>& items) const {
  const Stroke stroke{faded(palette_.muted, seen), sizes_.grid_line};
  for (std::size_t n = 0; n < lines_.size(); ++n) {
    items.emplace_back(
        PathItem{nth(ItemId::wall, kFirstLine + n), lines_.at(n), false, std::nullopt, stroke});
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
                                     {kInside * sizes_.unit, slow_baseline_px_},
                                     std::move(slow),
                                     sizes_.text,
                                     palette_.accent,
                                     face_});
  }
  if (marks_) {
    const auto red_face = [&](double gap) { return face_px_ + gap * px_per_unit + blue_px_; };
    const auto column_of = [&](const Hit& hit) {
      return hit.kind == CollisionKind::wall ? face_px_ : red_face(hit.gaps.y2);
    };
    marks_->add(shown, {face_px_, red_face(shown.gaps.y2)}, column_of, list.items);
  }
  list.items.emplace_back(RectangleItem{ItemId::loupe,
                                        {0, 0, bounds_.width, bounds_.height},
                                        std::nullopt,
                                        Stroke{palette_.muted, sizes_.grid_line}});
  return list;
}

void LoupeInset::add_blocks(const FrameState& shown, double px_per_unit,
                            std::vector<DrawItem>& items) const {
  const double floor_px = shapes_.floor_px;
  const double red_x = face_px_ + shown.gaps.y2 * px_per_unit + blue_px_;
  // Red's far side is outside.
  const double red_width = std::max(0.0, bounds_.width - red_x) + 2 * line_px_;
  add_rectangles(ItemId::red_block,
                 block_at({red_x, floor_px - shapes_.red_px, red_width, shapes_.red_px},
                          palette_.red, line_px_),
                 items);
  const double hits = shown.hits_per_s / frames_per_s_;
  const double swept =
      std::clamp((hits - kSweepHits / 4) / (kSweepHits - kSweepHits / 4), 0.0, 1.0);
  if (swept > 0) {
    items.emplace_back(
        RectangleItem{nth(ItemId::red_block, kSweep),
                      {face_px_, floor_px - shapes_.blue_px, red_x - face_px_, shapes_.blue_px},
                      faded(palette_.blue.fill, swept * kSweepAlpha),
                      std::nullopt});
  }
  add_blue(face_px_ + shown.gaps.y1 * px_per_unit, 1 - swept * (1 - kFastBlue), items);
}

void LoupeInset::add_blue(double x_px, double seen, std::vector<DrawItem>& items) const {
  const double floor_px = shapes_.floor_px;
  const double top = floor_px - shapes_.blue_px;
  BlockColors colors = palette_.blue;
  colors.fill = faded(colors.fill, seen);
  colors.edge = faded(colors.edge, seen);
  add_rectangles(ItemId::blue_block,
                 block_at({x_px, top, blue_px_, shapes_.blue_px}, colors, line_px_), items);
  const double half = kCutWidth / 2 * sizes_.unit;
  const double slant = kCutSlant / 2 * sizes_.unit;
  const double middle = x_px + blue_px_ / 2;
  items.emplace_back(PathItem{nth(ItemId::blue_block, kCut),
                              std::vector<Point>{{middle - half + slant, top},
                                                 {middle + half + slant, top},
                                                 {middle + half - slant, floor_px},
                                                 {middle - half - slant, floor_px}},
                              true, faded(palette_.background, seen), std::nullopt});
}

/// "×100" and "×10⁷" where the zoom stays; two digits, as "×3.5·10⁷", where it does not.
void LoupeInset::add_zoom(double zoomed, const Color& color, std::vector<DrawItem>& items) const {
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
  const Point left{zoom_right_.x - width_em * size_px, zoom_right_.y};
  const double text_px = widths_.width_em(text) * size_px;
  items.emplace_back(TextItem{nth(ItemId::loupe, 1), left, std::move(text), size_px, color, face_});
  if (power != nullptr) {
    power->add_to(items, nth(ItemId::loupe, 2), {left.x + text_px, left.y}, size_px, color);
  }
}

}  // namespace piblocks
