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

/// Below this it could not be read.
constexpr double kLeast_px = 4;

struct Label {
  std::string text;
  double size_px;
  double half_width_px;
  double centre_y;  ///< of the block, in units of the scene
  double down_px;   ///< from there to the baseline
  Color color;
};

class MassLabels final : public PicturePart {
 public:
  explicit MassLabels(const Setting& setting)
      : layout_(setting.stage),
        base_(base_of(setting.scene.system)),
        red_(label_of(setting.scene.system.red, setting.palette.red, setting.font)),
        blue_(label_of(setting.scene.system.blue, setting.palette.blue, setting.font)) {}

  void add(const FrameState& shown, std::vector<DrawItem>& items) const override {
    add_label(0, red_, shown.state.red, items);
    add_label(1, blue_, shown.state.blue, items);
  }

 private:
  Label label_of(const Block& block, const BlockColors& colors, const Font& font) const {
    const double side_px = to_double(block.width) * layout_.scale;
    std::string text = short_text(block.mass);
    const double width_em = font.width_em(text);
    const double size_px = std::min(kHeight * side_px, kWidth * side_px / width_em);
    if (size_px < kLeast_px) {
      throw UsageError(fmt::format(
          "show.overlays: the mass '{}' would be {:.1f} pixels high on its block, which cannot be "
          "read; leave out 'masses', or make the frame or the block larger",
          text, size_px));
    }
    return {std::move(text),          size_px,
            width_em * size_px / 2,   base_ + to_double(block.width) / 2,
            kHalfFigure_em * size_px, colors.text};
  }

  void add_label(std::size_t n, const Label& label, const Motion& motion,
                 std::vector<DrawItem>& items) const {
    const Point centre = layout_.at(motion.position, label.centre_y);
    items.emplace_back(TextItem{nth(ItemId::masses, n),
                                {centre.x - label.half_width_px, centre.y + label.down_px},
                                label.text,
                                label.size_px,
                                label.color});
  }

  Layout layout_;
  double base_;
  Label red_;
  Label blue_;
};

}  // namespace

std::unique_ptr<PicturePart> mass_labels(const Setting& setting) {
  return std::make_unique<MassLabels>(setting);
}

}  // namespace piblocks
