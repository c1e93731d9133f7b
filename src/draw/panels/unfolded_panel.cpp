#include <fmt/format.h>
#include <piblocks/schedule.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "draw/number_text.hpp"
#include "draw/panels/gaps.hpp"
#include "draw/panels/panels.hpp"

namespace piblocks {
namespace {

constexpr double kLeastBetween_px = 6;  // between rays, at their ends
constexpr double kRimStep = 0.05;       // radians
constexpr double kBelow_em = 1.5;

/// 1, 10, 100, …: every how many-th ray is drawn.
double ray_stride(double between_px) {
  return std::pow(10, std::max(0.0, std::ceil(std::log10(kLeastBetween_px / between_px))));
}

/// Reflected again and again instead of the path, the wedge fills the half-plane, and the path is a
/// straight line: it crosses a ray at every collision.
class UnfoldedPanel final : public Part {
 public:
  UnfoldedPanel(const Setting& setting, const PanelPlace& place)
      : gaps_(setting.scene.system), sheet_(setting, place, "Unfolded: a straight line") {
    const BlockSystem& system = setting.scene.system;
    start_ = {to_double(system.blue_gap() + system.blocks_gap()),
              gaps_.sigma * to_double(system.blue_gap())};
    velocity_ = {to_double(system.red.velocity), gaps_.sigma * to_double(system.blue.velocity)};
    from_ = plane_at(to_double(setting.scene.time.from));
    const Point to = plane_at(to_double(end_of(setting.scene, setting.log)));
    most_ = std::max({std::hypot(from_.x, from_.y), std::hypot(to.x, to.y), 1e-300});
    place_half_plane();
    add_rays();
    sheet_.line({at(from_), at(to)}, sheet_.palette().muted, 1, 4);
    sheet_.finish();
  }

  void add(const Shown& shown, std::vector<DrawItem>& items) const override {
    items.emplace_back(sheet_.item());
    const Point present = plane_at(to_double(shown.time));
    if (std::hypot(present.x, present.y) > most_ * (1 + 1e-9)) return;
    if (stride_ == 1) add_present_wedge(present, items);
    items.emplace_back(PathItem{sheet_.moving(1), std::vector<Point>{at(from_), at(present)}, false,
                                std::nullopt,
                                Stroke{sheet_.palette().accent, 2 * sheet_.line_px()}});
    items.emplace_back(sheet_.dot(2, at(present), sheet_.palette().accent));
  }

 private:
  /// Without the time before the start, in which the motion may be reflected too.
  Point plane_at(double time) const {
    return {start_.x + velocity_.x * time, start_.y + velocity_.y * time};
  }
  Point at(const Point& plane) const {
    return {corner_.x + scale_ * plane.x, corner_.y - scale_ * plane.y};
  }
  Point on_rim(double angle) const {
    return {corner_.x + radius_ * std::cos(angle), corner_.y - radius_ * std::sin(angle)};
  }

  void place_half_plane() {
    const Rectangle& inside = sheet_.inside();
    const double height = inside.height - kBelow_em * sheet_.text_px();
    radius_ = std::min(inside.width / 2, height);
    scale_ = radius_ / most_;
    corner_ = {inside.x + inside.width / 2, inside.y + (height + radius_) / 2};
  }

  void add_rays() {
    stride_ = ray_stride(gaps_.theta * radius_);
    const double step = stride_ * gaps_.theta;
    std::vector<Point> rays;
    for (double k = 0; k * step <= std::numbers::pi * (1 + 1e-12); ++k) {
      rays.push_back(corner_);
      rays.push_back(on_rim(k * step));
    }
    sheet_.line(std::move(rays), sheet_.palette().grid);
    std::vector<Point> rim;
    for (double angle = 0; angle < std::numbers::pi; angle += kRimStep)
      rim.push_back(on_rim(angle));
    rim.push_back(on_rim(std::numbers::pi));
    sheet_.path(std::move(rim), true, std::nullopt,
                Stroke{sheet_.palette().muted, sheet_.line_px()});
    if (stride_ > 1) {
      sheet_.text(fmt::format("1 ray in {}", short_text(Rational(stride_))),
                  {corner_.x, corner_.y + 1.2 * sheet_.text_px()}, 0.5, sheet_.palette().muted);
    }
  }

  void add_present_wedge(const Point& present, std::vector<DrawItem>& items) const {
    const double k = std::floor(std::atan2(present.y, present.x) / gaps_.theta);
    const double end = std::min((k + 1) * gaps_.theta, std::numbers::pi);
    std::vector<Point> outline{corner_};
    const int steps = static_cast<int>(std::ceil((end - k * gaps_.theta) / kRimStep));
    for (int i = 0; i <= steps; ++i) {
      outline.push_back(on_rim(k * gaps_.theta + (end - k * gaps_.theta) * i / steps));
    }
    items.emplace_back(PathItem{sheet_.moving(0), std::move(outline), true, sheet_.palette().shade,
                                Stroke{sheet_.palette().muted, sheet_.line_px()}});
  }

  Gaps gaps_;
  PanelSheet sheet_;
  Point start_;
  Point velocity_;
  Point from_;
  Point corner_;
  double most_ = 1;
  double scale_ = 1;
  double radius_ = 1;
  double stride_ = 1;
};

}  // namespace

std::unique_ptr<Part> unfolded_panel(const Setting& setting, const PanelPlace& place) {
  return std::make_unique<UnfoldedPanel>(setting, place);
}

}  // namespace piblocks
