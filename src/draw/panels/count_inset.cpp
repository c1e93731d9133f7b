#include "draw/panels/count_inset.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace piblocks {
namespace {

// In ems.
constexpr double kAboveInset_em = 0.35;  // from the baseline of the label
constexpr double kBelowInset_em = 0.95;  // to that of the other one
constexpr double kMarked_em = 0.3;       // half of the rectangle around the place that it enlarges

}  // namespace

Point CountInset::at(const Rational& time, const Integer& count) const {
  const auto& [span, time_factor, count_factor, low, high] = part_;
  const double across = to_double((time - span.from) / (span.to - span.from));
  const double up = to_double(Rational(2 * count - low - high) * count_factor.value() / 2);
  return {frame_.x + across * frame_.width, frame_.y + frame_.height / 2 - up * count_px_};
}

bool CountInset::add_labels(const Diagram& diagram, double room_px,
                            std::vector<DrawItem>& items) const {
  const FormulaSetter set = diagram.setter();
  const double em = diagram.text_px();
  const Color& color = diagram.palette().muted;
  const Formula time = set.text("time ×" + part_.time_factor.text());
  Formula count;
  if (part_.count_factor.value() > 1) count = set.text("count ×" + part_.count_factor.text());
  if (std::max(time.width_em(), count.width_em()) * em > room_px) return false;
  const ItemId id = diagram.moving(0);
  time.add_to(items, id, {frame_.x, frame_.y - kAboveInset_em * em}, em, color);
  count.add_to(items, id, {frame_.x, frame_.bottom() + kBelowInset_em * em}, em, color);
  return true;
}

void CountInset::add_frame(const Diagram& diagram, const Point& from,
                           std::vector<DrawItem>& items) const {
  const Color& color = diagram.palette().muted;
  const double em = diagram.text_px();
  // The area below the curve must not be seen behind it and its labels.
  items.emplace_back(RectangleItem{diagram.moving(0), frame_.grown(0, kLabel_em * em),
                                   diagram.palette().background, std::nullopt});
  const bool is_left = frame_.x < from.x;
  const double side = is_left ? frame_.right() : frame_.x;
  const double half = (is_left ? kMarked_em : -kMarked_em) * em;
  const auto add = [&](std::vector<Point> points) {
    items.emplace_back(diagram.moving_line(0, std::move(points), color));
  };
  add({{side, frame_.y}, {from.x - half, from.y - std::abs(half)}});
  add({{side, frame_.bottom()}, {from.x - half, from.y + std::abs(half)}});
  for (const Rect& box :
       {frame_, Rect{from.x - half, from.y - std::abs(half), 2 * half, 2 * std::abs(half)}}) {
    std::vector<Point> around = box.corners();
    around.push_back(around.front());
    add(std::move(around));
  }
}

void CountInset::add_steps(const Diagram& diagram, const PairLog& log,
                           std::vector<DrawItem>& items) const {
  const Palette& palette = diagram.palette();
  const int columns = std::max(1, static_cast<int>(frame_.width));
  const std::vector<CountPoint> points = count_curve(log, part_.span, columns);
  const auto place_of = [&](const CountPoint& point) {
    Point place = at(part_.span.from, point.count);
    place.x += point.share * frame_.width;
    return place;
  };
  for (std::size_t i = 1; i < points.size(); ++i) {
    Color color = palette.text;
    if (points[i].share == points[i - 1].share) {
      const bool is_wall = log.blocks_collision(points[i].count).kind == CollisionKind::wall;
      color = is_wall ? palette.blue.line : palette.red.line;
    }
    items.emplace_back(diagram.moving_line(0, {place_of(points[i - 1]), place_of(points[i])}, color,
                                           diagram.data_width()));
  }
}

}  // namespace piblocks
