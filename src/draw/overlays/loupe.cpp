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
constexpr double kBlueWidth = 0.068;   ///< cut: enlarged like the gaps, it would have no room
constexpr double kLeastRed = 0.04;     ///< what is seen of red at least

constexpr const char* kLoupeKey = "show.loupe";
constexpr long kMostPower = 300;
/// Heights of the blocks in the inset differ by this factor at most.
constexpr double kMaxInsetHeightRatio = 1.6;

bool shows_wall(const LayoutContext& context) {
  const auto& [low, high] = context.scene.view.x;
  const Rational& face = context.two_blocks().blocks().wall_face;
  return context.two_blocks().blocks().side > 0 && low <= face && face < high;
}

std::optional<Loupe> loupe_of(const Scene& scene) {
  Loupe loupe = scene.show.loupe.value_or(Loupe{.is_on = is_lecture(scene.view.theme)});
  return loupe.is_on ? std::optional(std::move(loupe)) : std::nullopt;
}

/// The gap between wall and red when it is about least; infinite if that cannot be told.
/// @param within  the times of interest; if empty, all
double least_gap(const LayoutContext& context, const std::optional<Span>& within = {}) {
  const PairLog& log = context.two_blocks();
  const auto is_within = [&](const Rational& time) {
    return !within || (time >= within->from && time <= within->to);
  };
  const Rational turn = turn_of(context.two_blocks().blocks()).value_or(0);
  try {
    double least = HUGE_VAL;
    if (is_within(turn)) least = log.gaps_at(turn).y2;
    // A light red is nearest at a collision beside the turn.
    const Integer before = log.blocks_at(turn).count;
    for (const Integer& k : {before, Integer(before + 1)}) {
      if (k < log.first_index() || k > log.last()) continue;
      if (!is_within(to_rational(log.blocks_collision(k).time))) continue;
      least = std::min(least, log.gaps_at_collision(k).y2);
    }
    if (!within) return least;
    // Red comes nearer all the time up to then, and goes away all the time from then on.
    return std::min({least, log.gaps_at(within->from).y2, log.gaps_at(within->to).y2});
  } catch (const SimulationError&) {  // beyond the range of a double
    return HUGE_VAL;
  }
}

Span span_of_window(const LoupeWindow& window, const Log& log) {
  Span span{time_of(window.from, kLoupeKey, log), time_of(window.to, kLoupeKey, log)};
  if (span.from < span.to) return span;
  throw UsageError(fmt::format("{}: its window from {} to {} must end after it begins", kLoupeKey,
                               to_text(span.from), to_text(span.to)));
}

/// @throws UsageError if the loupe would not be seen in its window.
void check_is_seen(const DrawingContext& context, const Span& window) {
  Span shown = window;
  if (has_span(context.scene, context.log)) {
    const Span span = span_of(context.scene, context.log);
    shown = {std::max(window.from, span.from), std::min(window.to, span.to)};
    if (shown.from >= shown.to) {
      throw UsageError(fmt::format(
          "{}: its window from {} to {} is outside of what is shown, {} to {}; move it there, or "
          "leave the loupe out",
          kLoupeKey, to_text(window.from), to_text(window.to), to_text(span.from),
          to_text(span.to)));
    }
  }
  const double gap_px = least_gap(context, shown) * context.layout.scale;
  const double most_px = style::kMaxLoupeGap * context.sizes.short_side;
  if (gap_px < most_px) return;
  throw UsageError(
      fmt::format("{}: in its window from {} to {} the gap between wall and red is never below "
                  "{:.4g} pixels, and the loupe is seen below {:.4g}; move the window to the turn, "
                  "use more digits, or leave the loupe out",
                  kLoupeKey, to_text(window.from), to_text(window.to), gap_px, most_px));
}

}  // namespace

bool may_show_loupe(const LayoutContext& context, const AxisPlace& axis) {
  if (context.pair() == nullptr) return false;
  if (!shows_wall(context) || !loupe_of(context.scene)) return false;
  return least_gap(context) * axis.scale < style::kMaxLoupeGap * context.sizes.short_side;
}

std::shared_ptr<const LoupeInset> LoupeInset::make(const DrawingContext& context,
                                                   const FramePlan& plan) {
  const Scene& scene = context.scene;
  const std::optional<Loupe> loupe = loupe_of(scene);
  if (!loupe || context.pair() == nullptr) return nullptr;
  const bool is_asked_for = loupe->window.has_value();
  const double gap_px = least_gap(context) * context.layout.scale;
  if (!shows_wall(context)) {
    if (!is_asked_for) return nullptr;
    throw UsageError(
        "show.loupe: the loupe enlarges the gap at a wall on the left, and the view shows none; "
        "let "
        "view.x begin at or below the wall's face and end above it, or leave the loupe out");
  }
  const bool is_small = gap_px < style::kMaxLoupeGap * context.sizes.short_side;
  if (!is_asked_for && !is_small) return nullptr;
  if (is_asked_for) check_is_seen(context, span_of_window(*loupe->window, context.log));
  auto inset = std::shared_ptr<LoupeInset>(new LoupeInset(context, *loupe, gap_px));
  const std::optional<LoupePlace> place = find_loupe_place(context, plan, inset->texts());
  if (place) {
    inset->place(context, *place);
    return inset;
  }
  if (!is_asked_for) return nullptr;
  throw UsageError(
      fmt::format("show.loupe: there is no room for it in {}x{}; make the frame larger, or leave "
                  "out diagrams, overlays or the loupe",
                  scene.view.width_px, scene.view.height_px));
}

LoupeInset::LoupeInset(const DrawingContext& context, const Loupe& loupe, double least_gap_px)
    : blocks_(context.two_blocks().blocks()),
      sizes_(context.sizes),
      palette_(context.palette),
      face_(context.font.face()),
      scale_(context.layout.scale),
      frames_per_s_(to_double(context.scene.view.frame_rate)),
      line_px_(context.layout.line_px),
      background_(background_of(context.scene.view)),
      zoom_([&] {
        double most =
            std::floor(rounded::log10(style::kLoupeWidth * sizes_.short_side / least_gap_px));
        if (loupe.window) most = std::max(most, rounded::log10(to_double(loupe.window->zoom)) + 1);
        return static_cast<long>(std::clamp<double>(most, 1, kMostPower));
      }()),
      widths_(context.font, "0123456789,.×·") {
  if (loupe.window) {
    window_ = Window{span_of_window(*loupe.window, context.log), to_double(loupe.window->zoom)};
  }
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
  face_px_ = std::round(sizes_.grid_line + (loupe_style::kInside + style::kWallWidth) * short_side);
  blue_width_px_ = std::round(kBlueWidth * short_side);
  room_px_ = bounds_.width - face_px_ - blue_width_px_ - kLeastRed * short_side;
  floor_px_ = std::round(bounds_.height - loupe_style::kBelowFloor * short_side);
  const double room =
      floor_px_ - found.rows_px - (loupe_style::kInside + loupe_style::kAboveBlocks) * short_side;
  const double taller = std::round(std::min(kBlocksHeight * short_side, room));
  const double ratio =
      std::clamp(layout.height_px(blocks_.red_id) / layout.height_px(blocks_.blue_id),
                 1 / kMaxInsetHeightRatio, kMaxInsetHeightRatio);
  blue_height_px_ = std::round(taller / std::max(1.0, ratio));
  red_height_px_ = std::round(taller * std::min(1.0, ratio));
  if (context.scene.show.hits && context.scene.view.theme != Theme::article) {
    marks_.emplace(context, HUGE_VAL, HUGE_VAL);
  }

  const double baseline = loupe_style::kInside * short_side + sizes_.text;
  slow_baseline_px_ = baseline;
  if (found.is_zoom_beside) {
    zoom_right_ = {bounds_.x - loupe_style::kOutside * short_side,
                   bounds_.y + bounds_.height / 2 + kHalfFigure_em * sizes_.mass};
  } else {
    const double row = slow_text_ ? loupe_style::kRow_em * sizes_.text : 0;
    zoom_right_ = {bounds_.right() - loupe_style::kInside * short_side, bounds_.y + baseline + row};
  }
  stage_ = layout;
  const double right = bounds_.right();
  const double bottom = bounds_.bottom();
  if (bottom < layout.top_px()) {
    corners_ = {Point{bounds_.x, bottom}, Point{right, bottom}};
    lines_y_ = bottom + loupe_style::kOutside * short_side;  // above all that is above red
  } else {
    corners_ = {Point{bounds_.x, bounds_.y}, Point{bounds_.x, bottom}};
    lines_y_ = layout.floor_px - layout.height_px(0) / 2;
  }
  place_scenery(context);
}

void LoupeInset::place_scenery(const DrawingContext& context) {
  const double line = sizes_.wall_line;
  const double top = floor_px_ - std::max(blue_height_px_, red_height_px_) -
                     loupe_style::kAboveBlocks / 2 * sizes_.short_side;
  std::vector<DrawItem> items =
      hatched_wall({face_px_, top}, {face_px_, floor_px_ + line}, context);
  items.emplace_back(RectangleItem{nth(ItemId::wall, items.size()),
                                   {face_px_ - line, floor_px_, bounds_.width, line},
                                   palette_.wall,
                                   std::nullopt});
  scenery_ = plate_of(ItemId::wall, {0, 0, bounds_.width, bounds_.height}, std::move(items));
}

}  // namespace piblocks
