#include "draw/damage.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <variant>

namespace piblocks {
namespace {

// Of the embedded font, in ems, with room to spare: marks above capitals, tails below the baseline,
// and how far a glyph may reach out of its advance.
constexpr double kAscent = 1.1;
constexpr double kDescent = 0.35;
constexpr double kOverhang = 0.15;

/// Cairo rounds every coordinate to 1/256 pixel, and some sums of them again.
constexpr double kFixedPoint = 1.0 / 64;

/// Where something may have painted, in pixels but not whole ones.
struct Extent {
  double left;
  double top;
  double right;
  double bottom;
};

Extent extent_of(const Rectangle& r) { return {r.x, r.y, r.x + r.width, r.y + r.height}; }

/// How far a centred line reaches beyond the outline it is drawn on.
double reach_of(const std::optional<Stroke>& stroke) { return stroke ? stroke->width_px / 2 : 0; }

Extent extent_of(const RectangleItem& item) { return extent_of(item.bounds); }
Extent extent_of(const ImageItem& item) { return extent_of(item.bounds); }
Extent extent_of(const PlateItem& item) { return extent_of(item.bounds); }

Extent extent_of(const DiskItem& disk) {
  const double reach = disk.radius + reach_of(disk.stroke);
  return {disk.centre.x - reach, disk.centre.y - reach, disk.centre.x + reach,
          disk.centre.y + reach};
}

Extent extent_of(const GroupItem& group) {
  const double x = group.x_px;
  const double y = group.y_px;
  return {x, y, x + group.list->width_px, y + group.list->height_px};
}

Extent extent_of(const PathItem& path) {
  const Extent points = extent_of(path.points.bounds());
  const double reach = reach_of(path.stroke);
  return {points.left - reach, points.top - reach, points.right + reach, points.bottom + reach};
}

/// From one coordinate to another, in pixels.
struct Interval {
  double from;
  double to;
};

/// Where the left edge is while the frame is exposed.
Interval left_edges_of(const ExposedBlock& block) {
  if (block.stops.empty()) return {block.bounds.x, block.bounds.x};
  return {block.stops.front().x, block.stops.back().x};
}

Extent extent_of(const ExposedBlock& block) {
  const auto [from, to] = left_edges_of(block);
  const Rectangle& r = block.bounds;
  return {from, r.y, to + r.width, r.y + r.height};
}

Extent extent_of(const ExposedItem& item) {
  const Extent a = extent_of(item.behind);
  const Extent b = extent_of(item.front);
  return {std::min(a.left, b.left), std::min(a.top, b.top), std::max(a.right, b.right),
          std::max(a.bottom, b.bottom)};
}

/// Of the characters of a line of text between two distances from its origin.
Extent extent_of(const TextItem& text, double left_em, double right_em) {
  const double em = text.size_px;
  return {text.origin.x + (left_em - kOverhang) * em, text.origin.y - kAscent * em,
          text.origin.x + (right_em + kOverhang) * em, text.origin.y + kDescent * em};
}

/// Collects rectangles and cuts them to whole pixels of the frame.
class Damage {
 public:
  explicit Damage(const DrawList& list) : width_px_(list.width_px), height_px_(list.height_px) {}

  void add(const Extent& extent) {
    if (is_frame_) return;
    const int x = to_pixel(std::floor(extent.left - kFixedPoint), width_px_);
    const int y = to_pixel(std::floor(extent.top - kFixedPoint), height_px_);
    const int end_x = to_pixel(std::ceil(extent.right + kFixedPoint), width_px_);
    const int end_y = to_pixel(std::ceil(extent.bottom + kFixedPoint), height_px_);
    if (x >= end_x || y >= end_y) return;
    const PixelRect rect{x, y, end_x - x, end_y - y};
    if (rect == frame()) return add_frame();
    rects_.push_back(rect);
  }
  /// What is added after it is part of it.
  void add_frame() {
    is_frame_ = true;
    rects_ = {frame()};
  }

  std::vector<PixelRect> take() { return std::move(rects_); }

 private:
  /// Also for what is far outside of the frame, or not a number.
  static int to_pixel(double position, int end) {
    return static_cast<int>(std::min(std::max(0.0, position), double(end)));
  }

  PixelRect frame() const { return {0, 0, width_px_, height_px_}; }

  int width_px_;
  int height_px_;
  std::vector<PixelRect> rects_;
  bool is_frame_ = false;
};

/// Whether a rectangle that is only moved sideways has the same pixels but for its ends.
bool slides(const RectangleItem& before, const RectangleItem& after) {
  const bool dashed = before.stroke && before.stroke->dash_px > 0;
  return !dashed && before.fill == after.fill && before.stroke == after.stroke &&
         before.bounds.y == after.bounds.y && before.bounds.height == after.bounds.height;
}

template <typename Item>
void compare(const Item& before, const Item& after, const MeasureText& /*width_em*/,
             Damage& damage) {
  damage.add(extent_of(before));
  damage.add(extent_of(after));
}

void compare(const RectangleItem& before, const RectangleItem& after,
             const MeasureText& /*width_em*/, Damage& damage) {
  const Rectangle& a = before.bounds;
  const Rectangle& b = after.bounds;
  if (!slides(before, after)) {
    damage.add(extent_of(a));
    damage.add(extent_of(b));
    return;
  }
  const double line = before.stroke ? before.stroke->width_px : 0;
  const auto [first_left, last_left] = std::minmax({a.x, b.x});
  const auto [first_right, last_right] = std::minmax({a.x + a.width, b.x + b.width});
  damage.add({first_left, a.y, last_left + line, a.y + a.height});
  damage.add({first_right - line, a.y, last_right, a.y + a.height});
}

/// Of a picture that stays where it is only what differs in it.
void compare(const GroupItem& before, const GroupItem& after, const MeasureText& width_em,
             Damage& damage) {
  const bool stays = before.x_px == after.x_px && before.y_px == after.y_px &&
                     before.opacity == after.opacity &&
                     before.list->width_px == after.list->width_px &&
                     before.list->height_px == after.list->height_px;
  if (!stays) {
    damage.add(extent_of(before));
    damage.add(extent_of(after));
    return;
  }
  for (const PixelRect& rect : piblocks::damage(*before.list, *after.list, width_em)) {
    const double x = after.x_px + rect.x_px;
    const double y = after.y_px + rect.y_px;
    damage.add({x, y, x + rect.width_px, y + rect.height_px});
  }
}

/// Rows of both blocks: where one passes, the other is painted with it.
Interval rows_of(const ExposedItem& before, const ExposedItem& after) {
  const Extent a = extent_of(before);
  const Extent b = extent_of(after);
  return {std::min(a.top, b.top), std::max(a.bottom, b.bottom)};
}

/// Between its ends a block that moves has the same pixels, wherever its ends are.
void compare(const ExposedBlock& before, const ExposedBlock& after, const Interval& rows,
             Damage& damage) {
  if (before == after) return;
  const Rectangle& a = before.bounds;
  const Rectangle& b = after.bounds;
  const bool alike = before.fill == after.fill && before.stroke == after.stroke &&
                     before.bars == after.bars && a.y == b.y && a.height == b.height &&
                     a.width == b.width && before.stops.empty() == after.stops.empty();
  const Interval first = left_edges_of(before);
  const Interval second = left_edges_of(after);
  if (!alike) {
    damage.add({first.from, rows.from, first.to + a.width, rows.to});
    damage.add({second.from, rows.from, second.to + b.width, rows.to});
    return;
  }
  const double from = std::min(first.from, second.from);
  const double to = std::max(first.to, second.to);
  const double line = before.stroke.width_px;
  damage.add({from, rows.from, to + line, rows.to});
  damage.add({from + a.width - line, rows.from, to + a.width, rows.to});
}

void compare(const ExposedItem& before, const ExposedItem& after, const MeasureText& /*width_em*/,
             Damage& damage) {
  const Interval rows = rows_of(before, after);
  compare(before.behind, after.behind, rows, damage);
  compare(before.front, after.front, rows, damage);
  if (before.contacts == after.contacts) return;
  for (const ExposedItem* item : {&before, &after}) {
    if (item->contacts.empty()) continue;
    damage.add(
        {item->contacts.front().behind_x, rows.from, item->contacts.back().behind_x + 1, rows.to});
  }
}

/// Bytes that both texts begin with, whole characters only.
std::size_t common_prefix(std::string_view a, std::string_view b) {
  auto length = static_cast<std::size_t>(
      std::mismatch(a.begin(), a.end(), b.begin(), b.end()).first - a.begin());
  const auto continues = [](std::string_view text, std::size_t at) {
    return at < text.size() && (static_cast<unsigned char>(text[at]) & 0xc0) == 0x80;
  };
  while (length > 0 && (continues(a, length) || continues(b, length))) --length;
  return length;
}

/// Every glyph is painted by itself: what the lines have in common keeps its pixels.
void compare(const TextItem& before, const TextItem& after, const MeasureText& width_em,
             Damage& damage) {
  const bool set_alike = before.origin == after.origin && before.size_px == after.size_px &&
                         before.color == after.color;
  const std::size_t common = set_alike ? common_prefix(before.text, after.text) : 0;
  const double left = common > 0 ? width_em(std::string_view(after.text).substr(0, common)) : 0;
  damage.add(extent_of(before, left, width_em(before.text)));
  damage.add(extent_of(after, left, width_em(after.text)));
}

ItemId id_of(const DrawItem& item) {
  return std::visit([](const auto& any) { return any.id; }, item);
}

Extent extent_of(const TextItem& text, const MeasureText& width_em) {
  return extent_of(text, 0, width_em(text.text));
}

/// An item that is in one of the lists only.
void add_whole(const DrawItem& item, const MeasureText& width_em, Damage& damage) {
  if (const auto* text = std::get_if<TextItem>(&item)) {
    damage.add(extent_of(*text, width_em));
    return;
  }
  std::visit(
      [&](const auto& any) {
        if constexpr (!std::is_same_v<decltype(any), const TextItem&>) damage.add(extent_of(any));
      },
      item);
}

/// Two items that show the same thing.
void compare(const DrawItem& before, const DrawItem& after, const MeasureText& width_em,
             Damage& damage) {
  if (before == after) return;
  if (before.index() != after.index()) {
    add_whole(before, width_em, damage);
    add_whole(after, width_em, damage);
    return;
  }
  std::visit(
      [&](const auto& b) {
        compare(b, std::get<std::remove_cvref_t<decltype(b)>>(after), width_em, damage);
      },
      before);
}

bool have_same_ids(const DrawList& before, const DrawList& after) {
  return std::ranges::equal(before.items, after.items, {}, id_of, id_of);
}

bool has_rising_ids(const DrawList& list) {
  return std::ranges::adjacent_find(list.items, std::ranges::greater_equal(), id_of) ==
         list.items.end();
}

/// Lists whose ids rise: what is in both is compared, what is in one only is added.
void compare_by_id(const DrawList& before, const DrawList& after, const MeasureText& width_em,
                   Damage& damage) {
  auto a = before.items.begin();
  auto b = after.items.begin();
  while (a != before.items.end() || b != after.items.end()) {
    const bool only_before =
        b == after.items.end() || (a != before.items.end() && id_of(*a) < id_of(*b));
    const bool only_after =
        a == before.items.end() || (b != after.items.end() && id_of(*b) < id_of(*a));
    if (only_before) {
      add_whole(*a++, width_em, damage);
    } else if (only_after) {
      add_whole(*b++, width_em, damage);
    } else {
      compare(*a++, *b++, width_em, damage);
    }
  }
}

}  // namespace

bool reaches(const DrawItem& item, const PixelRect& rect) {
  // A line is taken as endless rather than measured.
  constexpr double kEndless_em = 1e6;
  const Extent extent = std::visit(
      [](const auto& any) {
        if constexpr (std::is_same_v<decltype(any), const TextItem&>) {
          return extent_of(any, 0, kEndless_em);
        } else {
          return extent_of(any);
        }
      },
      item);
  return extent.left - kFixedPoint < rect.x_px + rect.width_px &&
         extent.right + kFixedPoint > rect.x_px &&
         extent.top - kFixedPoint < rect.y_px + rect.height_px &&
         extent.bottom + kFixedPoint > rect.y_px;
}

std::vector<PixelRect> damage(const DrawList& before, const DrawList& after,
                              const MeasureText& width_em) {
  Damage result(after);
  const bool alike = before.width_px == after.width_px && before.height_px == after.height_px &&
                     before.background == after.background;
  if (alike && have_same_ids(before, after)) {
    for (std::size_t i = 0; i < after.items.size(); ++i) {
      compare(before.items[i], after.items[i], width_em, result);
    }
  } else if (alike && has_rising_ids(before) && has_rising_ids(after)) {
    compare_by_id(before, after, width_em, result);
  } else {
    result.add_frame();
  }
  return result.take();
}

}  // namespace piblocks
