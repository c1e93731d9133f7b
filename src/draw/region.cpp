#include "draw/region.hpp"

#include <algorithm>
#include <type_traits>
#include <utility>
#include <variant>

namespace piblocks {

Region::Region(int width_px, int height_px)
    : width_cells_((width_px + kCell_px - 1) / kCell_px),
      rows_(static_cast<std::size_t>((height_px + kCell_px - 1) / kCell_px)) {
  cells_.resize(static_cast<std::size_t>(width_cells_) * rows_.size());
}

void Region::clear() {
  for (std::size_t y = 0; y < rows_.size(); ++y) {
    const auto [begin, end] = std::exchange(rows_[y], {});
    Box* const boxes = row(static_cast<int>(y));
    std::fill(boxes + begin, boxes + end, Box{});
  }
}

void Region::add(const PixelRect& rect) {
  const int end_x = rect.right_px();
  const int end_y = rect.bottom_px();
  if (rect.is_empty()) return;
  const int begin_column = rect.x_px / kCell_px;
  const int end_column = (end_x - 1) / kCell_px + 1;
  for (int y = rect.y_px / kCell_px; y * kCell_px < end_y; ++y) {
    const auto top = static_cast<std::uint8_t>(std::max(0, rect.y_px - y * kCell_px));
    const auto bottom = static_cast<std::uint8_t>(std::min(kCell_px, end_y - y * kCell_px));
    Columns& columns = rows_[static_cast<std::size_t>(y)];
    const bool is_empty = columns.begin == columns.end;
    columns = {is_empty ? begin_column : std::min(columns.begin, begin_column),
               std::max(columns.end, end_column)};
    for (int x = begin_column; x < end_column; ++x) {
      const auto left = static_cast<std::uint8_t>(std::max(0, rect.x_px - x * kCell_px));
      const auto right = static_cast<std::uint8_t>(std::min(kCell_px, end_x - x * kCell_px));
      Box& box = row(y)[x];
      box = box.right == 0 ? Box{left, top, right, bottom}
                           : Box{std::min(box.left, left), std::min(box.top, top),
                                 std::max(box.right, right), std::max(box.bottom, bottom)};
    }
  }
}

std::span<const PixelRect> Region::rects() {
  rects_.clear();
  above_.clear();
  for (std::size_t y = 0; y < rows_.size(); ++y) {
    here_.clear();
    add_row(static_cast<int>(y));
    std::swap(above_, here_);
  }
  return rects_;
}

void Region::add_row(int y_cells) {
  const auto [begin, end] = rows_[static_cast<std::size_t>(y_cells)];
  auto above = above_.begin();
  for (int x = begin; x < end; ++x) {
    if (row(y_cells)[x].right == 0) continue;
    const PixelRect rect = run(x, y_cells);
    above = std::find_if(above, above_.end(),
                         [&](std::size_t i) { return rects_[i].x_px >= rect.x_px; });
    const bool continues = above != above_.end() && rect.y_px == y_cells * kCell_px &&
                           rects_[*above].x_px == rect.x_px &&
                           rects_[*above].width_px == rect.width_px;
    const std::size_t index = continues ? *above : rects_.size();
    if (continues) {
      rects_[index].height_px += rect.height_px;
    } else {
      rects_.push_back(rect);
    }
    if (rect.bottom_px() == (y_cells + 1) * kCell_px) here_.push_back(index);
  }
}

PixelRect Region::run(int& x_cells, int y_cells) {
  const Box* const boxes = row(y_cells);
  const Box& first = boxes[x_cells];
  const int left = x_cells * kCell_px + first.left;
  const auto continues = [&](const Box& box, const Box& next) {
    return box.right == kCell_px && next.right > 0 && next.left == 0 && next.top == first.top &&
           next.bottom == first.bottom;
  };
  while (x_cells + 1 < width_cells_ && continues(boxes[x_cells], boxes[x_cells + 1])) ++x_cells;
  return {left, y_cells * kCell_px + first.top, x_cells * kCell_px + boxes[x_cells].right - left,
          first.bottom - first.top};
}

namespace {

ItemId id_of(const DrawItem& item) {
  return std::visit([](const auto& any) { return any.id; }, item);
}

bool has_rising_ids(const DrawList& list) {
  return std::ranges::adjacent_find(list.items, std::ranges::greater_equal(), id_of) ==
         list.items.end();
}

/// Whether only the ends of a rectangle that moves sideways change.
bool slides(const RectangleItem& before, const RectangleItem& after) {
  const bool dashed = before.stroke && before.stroke->dash_px > 0;
  return !dashed && before.fill == after.fill && before.stroke == after.stroke &&
         before.corner_px == after.corner_px && before.bounds.y == after.bounds.y &&
         before.bounds.height == after.bounds.height;
}

/// The same of an exposed block.
bool slides(const ExposedBlock& before, const ExposedBlock& after) {
  return before.fill == after.fill && before.stroke == after.stroke && before.bars == after.bars &&
         before.corner_px == after.corner_px && before.bounds.y == after.bounds.y &&
         before.bounds.height == after.bounds.height && before.bounds.width == after.bounds.width &&
         before.is_still() == after.is_still();
}

/// Whether only the second end of a level line changes. What stays of it has the same pixels.
bool grows(const PathItem& before, const PathItem& after) {
  const std::span<const Point> a = before.points.view();
  const std::span<const Point> b = after.points.view();
  return !before.fill && !after.fill && before.stroke && before.stroke == after.stroke &&
         before.stroke->dash_px == 0 && !before.closed && !after.closed && a.size() == 2 &&
         b.size() == 2 && a[0] == b[0] && a[1].y == a[0].y && b[1].y == b[0].y &&
         (a[1].x < a[0].x) == (b[1].x < b[0].x);
}

/// Whether only the content of a group changes.
bool stays(const GroupItem& before, const GroupItem& after) {
  return is_on_pixels(after) && before.bounds == after.bounds && before.opacity == after.opacity &&
         before.list->width_px == after.list->width_px &&
         before.list->height_px == after.list->height_px;
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

/// A picture that is partly faded into its own background.
const GroupItem* as_faded(const DrawList& list) {
  if (list.items.size() != 1) return nullptr;
  const auto* const group = std::get_if<GroupItem>(&list.items.front());
  const bool is_faded = group != nullptr && list.background &&
                        group->list->background == list.background &&
                        group->list->width_px == list.width_px &&
                        group->bounds == Rect{0, 0, double(list.width_px), double(list.height_px)};
  return is_faded ? group : nullptr;
}

/// Collects what differs, cut to whole pixels of the frame.
class Comparison {
 public:
  Comparison(const DrawList& list, const MeasureText& width_em)
      : frame_{0, 0, list.width_px, list.height_px}, width_em_(width_em) {}

  void compare(const DrawList& before, const DrawList& after) {
    const GroupItem* const faded_before = as_faded(before);
    const GroupItem* const faded_after = as_faded(after);
    const bool alike = before.width_px == after.width_px && before.height_px == after.height_px &&
                       before.background == after.background;
    if (alike && faded_before != nullptr && faded_after != nullptr &&
        faded_before->opacity != faded_after->opacity) {
      // Background over background is the background, however much of it there is.
      for (const DrawItem& item : faded_before->list->items) add(item);
      for (const DrawItem& item : faded_after->list->items) add(item);
      return;
    }
    if (alike && std::ranges::equal(before.items, after.items, {}, id_of, id_of)) {
      for (std::size_t i = 0; i < after.items.size(); ++i) compare(before.items[i], after.items[i]);
      return;
    }
    if (!alike || !has_rising_ids(before) || !has_rising_ids(after)) {
      rects_ = {frame_};
      return;
    }
    auto a = before.items.begin();
    auto b = after.items.begin();
    while (a != before.items.end() && b != after.items.end()) {
      if (id_of(*a) < id_of(*b)) {
        add(*a++);
      } else if (id_of(*b) < id_of(*a)) {
        add(*b++);
      } else {
        compare(*a++, *b++);
      }
    }
    while (a != before.items.end()) add(*a++);
    while (b != after.items.end()) add(*b++);
  }

  const std::vector<PixelRect>& rects() const { return rects_; }

 private:
  /// Two items that show the same thing.
  void compare(const DrawItem& before, const DrawItem& after) {
    if (before == after) return;
    std::visit(
        [&]<typename A, typename B>(const A& a, const B& b) {
          if constexpr (std::is_same_v<A, B>) {
            compare(a, b);
          } else {
            replace(before, after);
          }
        },
        before, after);
  }

  /// Discs, images and plates change as a whole.
  void compare(const auto& before, const auto& after) { replace(before, after); }

  void replace(const auto& before, const auto& after) {
    add(before);
    add(after);
  }

  /// Every glyph is painted by itself, so that the common beginning keeps its pixels.
  void compare(const TextItem& before, const TextItem& after) {
    const bool set_alike = before.origin == after.origin && before.size_px == after.size_px &&
                           before.color == after.color && before.face == after.face;
    const std::size_t common = set_alike ? common_prefix(before.text, after.text) : 0;
    const std::string_view prefix = std::string_view(after.text).substr(0, common);
    const double left = common > 0 ? width_em_(after.face, prefix) : 0;
    add(extent_of(before, left, width_em_(before.face, before.text)));
    add(extent_of(after, left, width_em_(after.face, after.text)));
  }

  void compare(const RectangleItem& before, const RectangleItem& after) {
    const Rect& a = before.bounds;
    const Rect& b = after.bounds;
    if (!slides(before, after)) return replace(a, b);
    const double end = std::max(before.stroke ? before.stroke->width_px : 0, before.corner_px);
    const auto [left, next_left] = std::minmax(a.x, b.x);
    const auto [last_right, right] = std::minmax({a.right(), b.right()});
    add(Rect::around({left, a.y}, {next_left + end, a.bottom()}));
    add(Rect::around({last_right - end, a.y}, {right, a.bottom()}));
  }

  void compare(const PathItem& before, const PathItem& after) {
    if (!grows(before, after)) return replace(before, after);
    const Rect changed = Rect::around(before.points.view()[1], after.points.view()[1]);
    add(changed.grown(after.stroke->width_px / 2));
  }

  void compare(const GroupItem& before, const GroupItem& after) {
    if (!stays(before, after)) return replace(before.bounds, after.bounds);
    Comparison within(*after.list, width_em_);
    within.compare(*before.list, *after.list);
    const Point corner{after.bounds.x, after.bounds.y};
    for (const PixelRect& rect : within.rects()) add(to_rect(rect) + corner);
  }

  /// Where one block passes, the others are painted with it: all rows of all change.
  void compare(const ExposedBlocksItem& before, const ExposedBlocksItem& after) {
    const Rect rows = extent_of(before, width_em_) | extent_of(after, width_em_);
    compare(before.behind, after.behind, rows);
    compare(before.front, after.front, rows);
    if (before.contacts == after.contacts) return;
    for (const ExposedBlocksItem* item : {&before, &after}) {
      if (item->contacts.empty()) continue;
      add(item->contacts.front().right_x(), item->contacts.back().right_x() + 1, rows);
    }
  }

  /// Between the ends of its way, a moving block has the same pixels wherever these ends are.
  void compare(const ExposedBlock& before, const ExposedBlock& after, const Rect& rows) {
    if (before == after) return;
    const Rect a = extent_of(before);
    const Rect b = extent_of(after);
    if (!slides(before, after)) {
      add(a.x, a.right(), rows);
      add(b.x, b.right(), rows);
      return;
    }
    const double from = std::min(a.x, b.x);
    const double to = std::max(a.right(), b.right());
    const double width = before.bounds.width;
    const double end = std::max(before.stroke.width_px, before.corner_px);
    add(from, to - width + end, rows);
    add(from + width - end, to, rows);
  }

  /// All shapes are looked at in the same moments.
  void compare(const MovingShapesItem& before, const MovingShapesItem& after) {
    const auto& a = before.shapes;
    const auto& b = after.shapes;
    const bool are_alike = before.shares == after.shares;
    for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i) {
      if (are_alike && i < a.size() && i < b.size() && a[i] == b[i]) continue;
      if (i < a.size()) add(extent_of(a[i]));
      if (i < b.size()) add(extent_of(b[i]));
    }
  }

  void add(const DrawItem& item) { add(extent_of(item, width_em_)); }
  void add(const PathItem& path) {
    for (const Rect& extent : extents_of(path)) add(extent);
  }
  void add(double left, double right, const Rect& rows) {
    add(Rect::around({left, rows.y}, {right, rows.bottom()}));
  }
  void add(const Rect& extent) {
    if (rects_.size() == 1 && rects_.front() == frame_) return;
    const PixelRect rect = pixels_of(extent.grown(kRounding_px), frame_);
    if (rect.is_empty()) return;
    if (rect == frame_) rects_.clear();
    rects_.push_back(rect);
  }

  PixelRect frame_;
  const MeasureText& width_em_;
  std::vector<PixelRect> rects_;  // may overlap
};

}  // namespace

void add_changes(const DrawList& before, const DrawList& after, const MeasureText& width_em,
                 Region& region) {
  Comparison comparison(after, width_em);
  comparison.compare(before, after);
  for (const PixelRect& rect : comparison.rects()) region.add(rect);
}

}  // namespace piblocks
