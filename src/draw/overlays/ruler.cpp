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

class Ruler final : public Part {
 public:
  explicit Ruler(const Setting& setting) {
    const Layout& layout = setting.stage;
    const BlockSystem& system = setting.scene.system;
    const View& view = setting.scene.view;
    const double foot = -to_double(std::max(system.blue.width, system.red.width)) / 2;
    const double room_px =
        (foot - to_double(view.y.low)) * layout.scale + std::min(layout.below_px, setting.text_px);
    if (room_px < kLeastRoom_px) {
      throw UsageError(
          fmt::format("show.overlays: the ruler needs {} pixels below the blocks, and there are "
                      "{:.0f}; lower the lower end of view.y, or make the frame larger",
                      kLeastRoom_px, std::max(0.0, room_px)));
    }
    const double size_px = std::min(kTextSize * room_px, setting.text_px);
    const double left = to_double(std::max(view.x.low, system.wall_face));
    const double right = to_double(view.x.high);
    const double axis = std::round(layout.at(0, foot).y + kAxis * room_px);
    const auto line = [&](std::size_t n, double x0, double y0, double x1, double y1) {
      items_.emplace_back(PathItem{nth(ItemId::ruler, n), std::vector<Point>{{x0, y0}, {x1, y1}},
                                   false, std::nullopt,
                                   Stroke{setting.palette.muted, setting.line_px}});
    };
    line(0, layout.at(left, 0).x, axis, layout.at(right, 0).x, axis);
    std::size_t n = 1;
    // The wall reaches down to the figures: the one at its face stands beside it.
    const double first_px = layout.at(to_double(system.wall_face), 0).x + kAside_em * size_px;
    const double end_px = view.width_px - kAside_em * size_px;
    const Ticks ticks = spaced_ticks(left, right, size_px / layout.scale, setting.font);
    for (const double value : ticks.values) {
      const double x = layout.at(value, 0).x;
      line(n++, x, axis, x, axis + kTick * room_px);
      const std::string text = tick_text(value, ticks.step);
      const double width_px = setting.font.width_em(text) * size_px;
      const double left_px = std::max(first_px, std::min(x - width_px / 2, end_px - width_px));
      items_.emplace_back(TextItem{nth(ItemId::ruler, n++),
                                   {left_px, axis + (kBaseline - kAxis) * room_px},
                                   text,
                                   size_px,
                                   setting.palette.muted});
    }
  }

  void add(const Shown&, std::vector<DrawItem>& items) const override {
    items.insert(items.end(), items_.begin(), items_.end());
  }

 private:
  std::vector<DrawItem> items_;
};

}  // namespace

std::unique_ptr<Part> ruler(const Setting& setting) { return std::make_unique<Ruler>(setting); }

}  // namespace piblocks
