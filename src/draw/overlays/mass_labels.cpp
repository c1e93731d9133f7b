#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include "draw/number_text.hpp"
#include "draw/overlays/overlays.hpp"

namespace piblocks {
namespace {

/// A mass takes at most this part of its block's width.
constexpr double kMostOfBlock = 0.9;
/// Of the least block that a mass is written on, in ems. A unit has a letter below the line.
constexpr double kHeight_em = 1;
constexpr double kHeightWithUnit_em = 1.2;
/// Between a block and the mass above it, in fractions of the frame's shorter side.
constexpr double kBelowMass = 0.016;
/// And between that mass and what is above it.
constexpr double kAboveMass = 0.006;

bool fits(const std::string& text, const BlockShape& block, const Layout& layout, double size_px,
          const Font& font) {
  const bool has_unit = text.ends_with('g');
  return font.width_em(text) * size_px <= kMostOfBlock * block.width * layout.scale &&
         (has_unit ? kHeightWithUnit_em : kHeight_em) * size_px <= block.height_px;
}

struct MassTexts {
  std::string blue;
  std::string red;
};

/// What the two masses can be written on, and which is the lighter one.
struct MassPlaces {
  const BlockShape& lighter;
  const BlockShape& heavier;

  /// The heavier block's mass may be above it, unless the other block would run into it.
  bool can_be_above() const { return heavier.height_px >= lighter.height_px; }
};

bool is_red_lighter(const BlockSystem& system) { return system.red.mass < system.blue.mass; }

MassPlaces mass_places(const BlockSystem& system, const Layout& layout) {
  if (is_red_lighter(system)) return {layout.red, layout.blue};
  return {layout.blue, layout.red};
}

/// With a unit, unless only a number has room.
MassTexts mass_texts(const Scene& scene, const Layout& layout, const Font& font) {
  const BlockSystem& system = scene.system;
  const MassTexts plain{short_text(system.blue.mass), short_text(system.red.mass)};
  const MassTexts full{plain.blue + " kg", plain.red + " kg"};
  const MassPlaces places = mass_places(system, layout);
  const bool is_red = is_red_lighter(system);
  const double size_px = Sizes(scene.view).mass;
  const bool has_room =
      fits(is_red ? full.red : full.blue, places.lighter, layout, size_px, font) &&
      (places.can_be_above() ||
       fits(is_red ? full.blue : full.red, places.heavier, layout, size_px, font));
  return has_room ? full : plain;
}

/// A block's label, whose middle is in column 0.
struct MassLabel {
  TextItem text;
  bool is_inside = true;  ///< on the block, else above it
  Color beside;           ///< its colour when it is not on the block

  double half_px() const { return -text.origin.x; }
};

/// Where labels can be while their blocks are in sight. No label is cut: half a number would be
/// another number.
class LabelRoom {
 public:
  explicit LabelRoom(const DrawingContext& context)
      : left_(context.sizes.margin),
        right_(std::min(context.scene.view.width_px - context.sizes.margin,
                        context.layout.content_right_px)),
        edge_(context.layout.visible_right_px),
        pad_(kBelowMass * context.sizes.short_side) {}

  void add(MassLabel label, const Rectangle& block, const Rectangle& other,
           std::vector<DrawItem>& items) const {
    if (block.x + block.width <= 0 || block.x >= edge_) return;
    const double half = label.half_px();
    double middle = block.x + block.width / 2;
    const double pad = std::min(pad_, std::max(0.0, block.width / 2 - half - kRounded_px));
    if (!label.is_inside) {
      middle = std::clamp(middle, left_ + half, std::max(left_ + half, right_ - half));
    } else {
      const double least = std::max(left_, block.x + pad) + half;
      const double most = std::min(right_, block.x + block.width - pad) - half;
      middle = least <= most ? std::clamp(middle, least, most) : leave(label, block, other);
    }
    // By whole pixels, its figures keep their distances, and encoders find it again.
    double& x = label.text.origin.x;
    x = std::min(std::max(std::round(x + middle), std::ceil(left_)), std::floor(right_ - 2 * half));
    items.emplace_back(std::move(label.text));
  }

 private:
  /// Moves the label of a block of which too little is seen beside the block, or above it if the
  /// other block is in the way. @returns the middle of the label
  double leave(MassLabel& label, const Rectangle& block, const Rectangle& other) const {
    const double half = label.half_px();
    label.text.color = label.beside;
    const bool goes_right = block.x + block.width > right_;
    const double middle = goes_right ? std::min(block.x - pad_, right_) - half
                                     : std::max(block.x + block.width + pad_, left_) + half;
    const bool is_free =
        other.x + other.width <= middle - half - pad_ || other.x >= middle + half + pad_;
    if (is_free) return middle;
    label.text.origin.y = block.y - pad_;
    return std::clamp(block.x + block.width / 2, left_ + half,
                      std::max(left_ + half, right_ - half));
  }

  // Labels above or beside their blocks stay between these.
  double left_;
  double right_;
  double edge_;  ///< blocks are seen up to here
  double pad_;
};

MassLabel mass_label(std::size_t n, std::string text, const Block& block,
                     const DrawingContext& context) {
  const BlockSystem& system = context.scene.system;
  const Layout& layout = context.layout;
  const bool is_red = &block == &system.red;
  const BlockColors& colors = is_red ? context.palette.red : context.palette.blue;
  const BlockShape& shape = is_red ? layout.red : layout.blue;
  const bool is_lighter = is_red == is_red_lighter(system);
  const double size_px = context.sizes.mass;
  const double left = -context.font.width_em(text) * size_px / 2;
  const double top = layout.floor_px - shape.height_px;
  const bool is_inside = fits(text, shape, layout, size_px, context.font);
  if (!is_inside && (is_lighter || !mass_places(system, layout).can_be_above())) {
    throw UsageError(
        fmt::format("show.overlays: the mass '{}' does not fit on its block of {:.0f}x{:.0f} "
                    "pixels; leave out 'masses', make the block or the frame larger, or show less "
                    "of the x axis",
                    text, shape.width * layout.scale, shape.height_px));
  }
  if (!is_inside && layout.above_px + kRounded_px < mass_room_px(context.sizes)) {
    throw UsageError(
        fmt::format("show.overlays: the mass '{}' needs {:.0f} pixels above its block, and there "
                    "are {:.0f}; leave out 'masses', or make the block wider or the frame higher",
                    text, mass_room_px(context.sizes), std::max(0.0, layout.above_px)));
  }
  const double baseline = is_inside
                              ? layout.floor_px - shape.height_px / 2 + kHalfFigure_em * size_px
                              : top - kBelowMass * context.sizes.short_side;
  return {{nth(ItemId::masses, n),
           {left, baseline},
           std::move(text),
           size_px,
           is_inside ? colors.text : colors.label,
           context.font.face()},
          is_inside,
          colors.label};
}

}  // namespace

double mass_room_px(const Sizes& sizes) {
  return std::max(kMassRoom * sizes.short_side,
                  (kBelowMass + kAboveMass) * sizes.short_side + Font::kCapHeight_em * sizes.mass);
}

bool has_mass_above(const Scene& scene, const Layout& layout, const Font& font) {
  const double size_px = Sizes(scene.view).mass;
  const auto [blue, red] = mass_texts(scene, layout, font);
  return !fits(red, layout.red, layout, size_px, font) ||
         !fits(blue, layout.blue, layout, size_px, font);
}

Drawable mass_labels(const DrawingContext& context) {
  const BlockSystem& system = context.scene.system;
  const MassTexts texts = mass_texts(context.scene, context.layout, context.font);
  const MassLabel red = mass_label(0, texts.red, system.red, context);
  const MassLabel blue = mass_label(1, texts.blue, system.blue, context);
  return [=, room = LabelRoom(context), layout = context.layout](const FrameState& shown,
                                                                 std::vector<DrawItem>& items) {
    const Rectangle red_block = layout.at(layout.red, shown.state.bodies[1].position[0]);
    const Rectangle blue_block = layout.at(layout.blue, shown.state.bodies[0].position[0]);
    room.add(red, red_block, blue_block, items);
    room.add(blue, blue_block, red_block, items);
  };
}

}  // namespace piblocks
