#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <utility>

#include "draw/number_text.hpp"
#include "draw/overlays/overlays.hpp"
#include "draw/ticks.hpp"

namespace piblocks {
namespace {

// In parts of the block's side.
constexpr double kHeight = 0.3;
constexpr double kWidth = 0.84;

/// A smaller label cannot be read.
constexpr double kLeast_px = 4;

struct Label {
  TextItem text;
  double centre_y;  ///< of the block, in units of the scene
  Point offset;     ///< from there to the text's origin
};

Label label_of(ItemId id, const Block& block, const BlockColors& colors, const Setting& setting) {
  const double side_px = to_double(block.width) * setting.stage.scale;
  std::string text = short_text(block.mass);
  const double width_em = setting.font.width_em(text);
  const double size_px = setting.font.fitted_px(text, kHeight * side_px, kWidth * side_px);
  if (size_px < kLeast_px) {
    throw UsageError(fmt::format(
        "show.overlays: the mass '{}' would be {:.1f} pixels high on its block, which cannot be "
        "read; leave out 'masses', or make the frame or the block larger",
        text, size_px));
  }
  return {{id, {}, std::move(text), size_px, colors.text},
          base_of(setting.scene.system) + to_double(block.width) / 2,
          {-width_em * size_px / 2, kHalfFigure_em * size_px}};
}

}  // namespace

Drawable mass_labels(const Setting& setting) {
  const BlockSystem& system = setting.scene.system;
  const Label red = label_of(nth(ItemId::masses, 0), system.red, setting.palette.red, setting);
  const Label blue = label_of(nth(ItemId::masses, 1), system.blue, setting.palette.blue, setting);
  return [=, layout = setting.stage](const FrameState& shown, std::vector<DrawItem>& items) {
    const auto add = [&](const Label& label, const Motion& motion) {
      TextItem text = label.text;
      const Point centre = layout.at(motion.position, label.centre_y);
      text.origin = {centre.x + label.offset.x, centre.y + label.offset.y};
      items.emplace_back(std::move(text));
    };
    add(red, shown.state.red);
    add(blue, shown.state.blue);
  };
}

}  // namespace piblocks
