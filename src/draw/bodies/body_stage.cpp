#include "draw/bodies/body_stage.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/rounded.hpp"
#include "draw/bodies/body_look.hpp"
#include "draw/bodies/body_painter.hpp"
#include "draw/bodies/body_walls.hpp"
#include "draw/look.hpp"
#include "draw/number_text.hpp"
#include "draw/overlays/overlays.hpp"
#include "draw/overlays/stage_parts.hpp"
#include "draw/text_lines.hpp"

namespace piblocks {
namespace {

/// In fractions of the frame's shorter side.
constexpr double kTallest = 0.5;
/// Part of a body's width or diameter that its label may take.
constexpr double kLabelRoom = 0.86;
/// More bodies have no labels, masses or arrows, nor are more drawn at all.
constexpr std::size_t kMostMarked = 10'000;
constexpr std::size_t kMostDrawn = 50'000;

class BodyStage {
 public:
  BodyStage(const DrawingContext& context, const Rectangle& area)
      : context_(context), system_(context.bodies.system), area_(area) {
    bodies_.are_blocks = system_.dimensions == 1;
    check_number();
    constexpr int kTrail_s = 2;  // of video at the scene's own speed
    if (context.scene.show.has(Overlay::trails)) {
      context.needs.trail = context.scene.time.speed * kTrail_s;
    }
    if (bodies_.are_blocks) {
      lay_out_line();
    } else {
      window_ = {std::ceil(area.x), std::ceil(area.y), std::floor(area.width - 1),
                 std::floor(area.height - 1)};
      area_ = {0, 0, window_.width, window_.height};
      lay_out_plane();
    }
    check_scale();
    add_labels();
  }

  /// Discs that leave what is shown are cut off at its edge, so that they hide no text.
  Drawable drawable() && {
    if (bodies_.are_blocks) return bodies();
    return [inside = bodies(), window = window_, background = background_of(context_.scene.view)](
               const FrameState& shown, std::vector<DrawItem>& items) {
      DrawList list{int(window.width), int(window.height), background, {}};
      inside(shown, list.items);
      items.emplace_back(
          GroupItem{ItemId::wall, window, std::make_shared<const DrawList>(std::move(list))});
    };
  }

 private:
  Drawable bodies() {
    std::vector<DrawItem> stays = body_walls(context_, bodies_, area_);
    return [stays = std::move(stays), moves = body_painter(context_, std::move(bodies_))](
               const FrameState& shown, std::vector<DrawItem>& items) {
      items.insert(items.end(), stays.begin(), stays.end());
      moves(shown, items);
    };
  }

  void check_number() const {
    const Show& show = context_.scene.show;
    const bool is_marked = show.has(Overlay::velocities) || has_labels();
    const std::size_t most = is_marked ? kMostMarked : kMostDrawn;
    if (system_.bodies.size() <= most) return;
    throw UsageError(fmt::format("body: {} of them cannot be drawn{}; use at most {}",
                                 system_.bodies.size(),
                                 is_marked ? " with labels, masses or velocities" : "", most));
  }

  bool has_labels() const {
    return context_.scene.show.has(Overlay::masses) ||
           std::ranges::any_of(context_.bodies.styles,
                               [](const BodyStyle& style) { return !style.label.empty(); });
  }

  double wall_px() const {
    return system_.walls.empty() ? 0 : style::kWallWidth * context_.sizes.short_side;
  }

  void lay_out_line() {
    const Sizes& sizes = context_.sizes;
    const View& view = context_.scene.view;
    const double left = area_.x + (system_.walls.empty() ? 0 : wall_px());
    const double width = area_.width - 2 * (left - area_.x);
    bodies_.map.scale = width / to_double(view.x.high - view.x.low);
    bodies_.map.origin.x = left - to_double(view.x.low) * bodies_.map.scale;
    double labels = has_labels() ? sizes.mass + kLabelAbove * sizes.short_side : 0;
    if (context_.scene.show.has(Overlay::velocities)) labels += kArrowAbove * sizes.short_side;
    const double room =
        area_.height - 2 * sizes.wall_line - labels - kWallAboveBodies * sizes.short_side;
    if (room < kLeastHeight * sizes.short_side) throw_too_small();
    set_heights(std::min(room, kTallest * sizes.short_side));
    const double tallest = bodies_.tallest_px();
    bodies_.map.origin.y =
        std::floor(area_.y + area_.height - 2 * sizes.wall_line - (room - tallest) / 2);
  }

  /// Blocks are as high as the widest is wide, and higher by their mass.
  void set_heights(double most_px) {
    std::optional<Rational> least;
    Rational widest = 0;
    for (const Body& body : system_.bodies) {
      if (body.mass && (!least || *body.mass < *least)) least = *body.mass;
      widest = std::max(widest, body.size);
    }
    double tallest = 1;
    std::vector<double> heights;
    for (const Body& body : system_.bodies) {
      double height = style::kMaxHeightRatio;
      if (body.mass) {
        const Magnitude ratio = magnitude_of(*body.mass / *least);
        const double logarithm = rounded::log10(ratio.mantissa) + double(ratio.exponent);
        height = std::min(height, 1 + kHeightByMass * logarithm);
      }
      heights.push_back(height);
      tallest = std::max(tallest, height);
    }
    const double unit = std::min(to_double(widest) * bodies_.map.scale, most_px / tallest);
    for (std::size_t i = 0; i < heights.size(); ++i) {
      BodyShape& shape = bodies_.shapes.emplace_back();
      shape.half_width_px = to_double(system_.bodies[i].size) * bodies_.map.scale / 2;
      shape.height_px = std::max(1.0, std::floor(heights[i] * unit));
      shape.colors = body_colors(context_, i);
    }
  }

  void lay_out_plane() {
    const View& view = context_.scene.view;
    const double margin = wall_px();
    const double width = area_.width - 2 * std::max(margin, context_.sizes.margin / 2);
    const double height = area_.height - 2 * std::max(margin, context_.sizes.margin / 2);
    if (std::min(width, height) < kLeastHeight * context_.sizes.short_side) throw_too_small();
    const double units_x = to_double(view.x.high - view.x.low);
    const double units_y = to_double(view.y.high - view.y.low);
    bodies_.map.scale = std::min(width / units_x, height / units_y);
    bodies_.map.origin = {
        area_.x + area_.width / 2 - to_double(view.x.high + view.x.low) / 2 * bodies_.map.scale,
        area_.y + area_.height / 2 + to_double(view.y.high + view.y.low) / 2 * bodies_.map.scale};
    bodies_.map.origin = {std::round(bodies_.map.origin.x), std::round(bodies_.map.origin.y)};
    for (std::size_t i = 0; i < system_.bodies.size(); ++i) {
      BodyShape& shape = bodies_.shapes.emplace_back();
      shape.half_width_px = to_double(system_.bodies[i].size) * bodies_.map.scale;
      shape.colors = body_colors(context_, i);
    }
  }

  void check_scale() const {
    if (bodies_.are_blocks) return check_resolution(context_.scene.view, bodies_.map.scale);
    const View& view = context_.scene.view;
    const double farthest =
        std::max({std::fabs(to_double(view.x.low)), std::fabs(to_double(view.x.high)),
                  std::fabs(to_double(view.y.low)), std::fabs(to_double(view.y.high))});
    if (farthest * 0x1p-52 * bodies_.map.scale <= kMostStep_px) return;
    throw UsageError(
        "view.x: so far from 0 positions cannot be told apart by a pixel; show more of the plane, "
        "or move the bodies towards 0");
  }

  [[noreturn]] void throw_too_small() const {
    throw UsageError(fmt::format(
        "show: there is too little room for the bodies in {}x{}; leave something out, or make the "
        "frame larger",
        context_.scene.view.width_px, context_.scene.view.height_px));
  }

  /// What is written on each body: its label, or its mass.
  void add_labels() {
    const double size_px = context_.sizes.mass;
    for (std::size_t i = 0; i < bodies_.shapes.size(); ++i) {
      BodyShape& shape = bodies_.shapes[i];
      shape.label = context_.bodies.styles[i].label;
      const auto& mass = system_.bodies[i].mass;
      if (shape.label.empty() && mass && context_.scene.show.has(Overlay::masses)) {
        shape.label = short_text(*mass);
      }
      if (shape.label.empty()) continue;
      check_readable(context_, "body.label", shape.label);
      shape.label_px = context_.font.width_em(shape.label) * size_px;
      const double height = bodies_.are_blocks ? shape.height_px : shape.half_width_px;
      shape.is_label_on =
          shape.label_px <= 2 * kLabelRoom * shape.half_width_px && size_px <= kLabelRoom * height;
    }
  }

  const DrawingContext& context_;
  const BodySystem& system_;
  Rectangle window_;  ///< in the frame, whole pixels; of discs
  Rectangle area_;    ///< in the frame; of discs, in the window
  BodyShapes bodies_;
};

}  // namespace

Drawable body_stage(const DrawingContext& context, const Rectangle& area) {
  return BodyStage(context, area).drawable();
}

}  // namespace piblocks
