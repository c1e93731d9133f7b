#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <cmath>

#include "draw/number_text.hpp"
#include "draw/overlays/overlays.hpp"
#include "draw/text_widths.hpp"

namespace piblocks {
namespace {

// In parts of the room above the blocks.
constexpr double kShaft = 0.3;     // height of the shaft above the block
constexpr double kBaseline = 0.5;  // height of the figure's baseline
constexpr double kTextSize = 0.4;
constexpr double kHead = 0.17;
constexpr double kLeastRoom_px = 16;
/// No arrow is as long as this, in units of the scene.
constexpr double kLongest = 0.9;
/// So many times red's usual speed has an arrow half as long.
constexpr double kHalfLength = 2;

/// Red's largest speed if it is the heavier one: all energy its own.
double usual_speed(const BlockSystem& system) {
  const double ratio = to_double(system.blue.mass / system.red.mass);
  return std::hypot(std::sqrt(ratio) * to_double(system.blue.velocity),
                    to_double(system.red.velocity));
}

class VelocityArrows final : public PicturePart {
 public:
  explicit VelocityArrows(const Setting& setting)
      : layout_(setting.stage),
        palette_(setting.palette),
        widths_(setting.font, kNumberCharacters),
        usual_speed_(usual_speed(setting.scene.system)),
        line_px_(setting.line_px) {
    const BlockSystem& system = setting.scene.system;
    top_ = to_double(std::max(system.blue.width, system.red.width)) / 2;
    room_px_ = (to_double(setting.scene.view.y.high) - top_) * layout_.scale + layout_.above_px;
    text_px_ = std::min(kTextSize * room_px_, setting.text_px);
    if (room_px_ < kLeastRoom_px) {
      throw UsageError(fmt::format(
          "show.overlays: the velocities need {} pixels above the blocks, and there are {:.0f}; "
          "raise the upper end of view.y, or make the frame larger",
          kLeastRoom_px, std::max(0.0, room_px_)));
    }
  }

  void add(const Shown& shown, std::vector<DrawItem>& items) const override {
    add_arrow(0, shown.state.red, palette_.red.fill, items);
    add_arrow(4, shown.state.blue, palette_.blue.fill, items);
  }

 private:
  double length_px(double velocity) const {
    const double speed = std::abs(velocity);
    if (!(usual_speed_ > 0) || !(speed > 0)) return 0;
    const double share = 1 / (1 + kHalfLength * usual_speed_ / speed);
    return std::copysign(kLongest * share * layout_.scale, velocity);
  }

  void add_arrow(std::size_t n, const Motion& motion, const Color& color,
                 std::vector<DrawItem>& items) const {
    const Point foot = layout_.at(motion.position, top_);
    const double y = foot.y - kShaft * room_px_;
    const double head = kHead * room_px_;
    const double tip = foot.x + length_px(motion.velocity);
    const double side = tip < foot.x ? -1 : 1;
    const Color edge = palette_.text;
    if (std::abs(tip - foot.x) > head) {
      const double neck = tip - side * head;
      items.emplace_back(PathItem{nth(ItemId::velocities, n),
                                  std::vector<Point>{{foot.x, y}, {neck, y}}, false, std::nullopt,
                                  Stroke{edge, 2 * line_px_}});
      items.emplace_back(PathItem{nth(ItemId::velocities, n + 1),
                                  std::vector<Point>{{tip, y}, {neck, y - head}, {neck, y + head}},
                                  true, color, Stroke{edge, line_px_}});
    }
    const std::string text = rounded_text(motion.velocity);
    items.emplace_back(
        TextItem{nth(ItemId::velocities, n + 2),
                 {foot.x - widths_.width_em(text) * text_px_ / 2, foot.y - kBaseline * room_px_},
                 text,
                 text_px_,
                 palette_.text});
  }

  Layout layout_;
  Palette palette_;
  TextWidths widths_;
  double usual_speed_;
  double line_px_;
  double top_ = 0;
  double room_px_ = 0;
  double text_px_ = 0;
};

}  // namespace

std::unique_ptr<PicturePart> velocity_arrows(const Setting& setting) {
  return std::make_unique<VelocityArrows>(setting);
}

}  // namespace piblocks
