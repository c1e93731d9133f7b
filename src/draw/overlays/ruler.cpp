#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <cmath>

#include "draw/number_text.hpp"
#include "draw/overlays/overlays.hpp"
#include "draw/ticks.hpp"

namespace piblocks {
namespace {

// In parts of the room below the blocks.
constexpr double kAxis = 0.25;
constexpr double kTick = 0.14;
constexpr double kBaseline = 0.82;
constexpr double kTextSize = 0.44;
constexpr double kLeastRoom_px = 16;
constexpr double kLeastGap_em = 1.0;  // between figures
constexpr double kAside_em = 0.25;    // from the wall and the edge of the frame

/// So far apart that their figures do not touch.
Ticks spaced_ticks(double low, double high, double em, const Font& font) {
  Ticks ticks = ticks_of(low, high, kLeastGap_em * em);
  const auto widest = [&] {
    return std::max(font.width_em(tick_text(low, ticks.step)),
                    font.width_em(tick_text(high, ticks.step)));
  };
  while (ticks.values.size() > 1 && ticks.step < (widest() + kLeastGap_em) * em) {
    ticks = ticks_of(low, high, 1.5 * ticks.step);
  }
  return ticks;
}

/// Where the ruler has its place.
struct Room {
  double top;
  double height;

  double at(double share) const { return top + share * height; }
};

/// @throws UsageError if there is none below the blocks.
Room room_for(const Setting& setting) {
  const BlockSystem& system = setting.scene.system;
  const Layout& layout = setting.stage;
  const double foot = -to_double(std::max(system.blue.width, system.red.width)) / 2;
  const double height = (foot - to_double(setting.scene.view.y.low)) * layout.scale +
                        std::min(layout.below_px, setting.text_px);
  if (height >= kLeastRoom_px) return {layout.at(0, foot).y, height};
  throw UsageError(
      fmt::format("show.overlays: the ruler needs {} pixels below the blocks, and there are "
                  "{:.0f}; lower the lower end of view.y, or make the frame larger",
                  kLeastRoom_px, std::max(0.0, height)));
}

class Ruler final : public PicturePart {
 public:
  explicit Ruler(const Setting& setting) {
    const Layout& layout = setting.stage;
    const Room room = room_for(setting);
    const double size_px = std::min(kTextSize * room.height, setting.text_px);
    const double left =
        to_double(std::max(setting.scene.view.x.low, setting.scene.system.wall_face));
    const double right = to_double(setting.scene.view.x.high);
    const double axis = std::round(room.at(kAxis));
    const Stroke stroke{setting.palette.muted, setting.line_px};
    add_line({layout.at(left, 0).x, axis}, {layout.at(right, 0).x, axis}, stroke);
    // The wall reaches down to the figures: the one at its face stands beside it.
    const double wall_px = layout.at(to_double(setting.scene.system.wall_face), 0).x;
    const double first_px = wall_px + kAside_em * size_px;
    const double end_px = setting.scene.view.width_px - kAside_em * size_px;
    const Ticks ticks = spaced_ticks(left, right, size_px / layout.scale, setting.font);
    for (const double value : ticks.values) {
      const double x = layout.at(value, 0).x;
      add_line({x, axis}, {x, axis + kTick * room.height}, stroke);
      const std::string text = tick_text(value, ticks.step);
      const double width_px = setting.font.width_em(text) * size_px;
      const double left_px = std::max(first_px, std::min(x - width_px / 2, end_px - width_px));
      items_.emplace_back(TextItem{next_id(),
                                   {left_px, axis + (kBaseline - kAxis) * room.height},
                                   text,
                                   size_px,
                                   setting.palette.muted});
    }
  }

  void add(const Shown& /*shown*/, std::vector<DrawItem>& items) const override {
    items.insert(items.end(), items_.begin(), items_.end());
  }

 private:
  ItemId next_id() const { return nth(ItemId::ruler, items_.size()); }
  void add_line(const Point& from, const Point& to, const Stroke& stroke) {
    items_.emplace_back(
        PathItem{next_id(), std::vector<Point>{from, to}, false, std::nullopt, stroke});
  }

  std::vector<DrawItem> items_;
};

}  // namespace

std::unique_ptr<PicturePart> ruler(const Setting& setting) {
  return std::make_unique<Ruler>(setting);
}

}  // namespace piblocks
