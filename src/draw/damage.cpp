#include "draw/damage.hpp"

#include <algorithm>
#include <cmath>
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
    const int x = to_pixel(std::floor(extent.left - kFixedPoint), width_px_);
    const int y = to_pixel(std::floor(extent.top - kFixedPoint), height_px_);
    const int end_x = to_pixel(std::ceil(extent.right + kFixedPoint), width_px_);
    const int end_y = to_pixel(std::ceil(extent.bottom + kFixedPoint), height_px_);
    if (x < end_x && y < end_y) rects_.push_back({x, y, end_x - x, end_y - y});
  }
  void add_frame() { rects_ = {{0, 0, width_px_, height_px_}}; }

  std::vector<PixelRect> take() { return std::move(rects_); }

 private:
  /// Also for what is far outside of the frame, or not a number.
  static int to_pixel(double position, int end) {
    return static_cast<int>(std::min(std::max(0.0, position), double(end)));
  }

  int width_px_;
  int height_px_;
  std::vector<PixelRect> rects_;
};

/// Whether a rectangle that is only moved sideways has the same pixels but for its ends.
bool slides(const RectangleItem& before, const RectangleItem& after) {
  const bool dashed = before.stroke && before.stroke->dash_px > 0;
  return !dashed && before.fill == after.fill && before.stroke == after.stroke &&
         before.bounds.y == after.bounds.y && before.bounds.height == after.bounds.height;
}

void compare(const RectangleItem& before, const RectangleItem& after, Damage& damage) {
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

bool have_same_items(const DrawList& before, const DrawList& after) {
  return before.width_px == after.width_px && before.height_px == after.height_px &&
         before.background == after.background &&
         std::ranges::equal(before.items, after.items, [](const DrawItem& a, const DrawItem& b) {
           return a.index() == b.index() && id_of(a) == id_of(b);
         });
}

}  // namespace

bool reaches(const DrawItem& item, const PixelRect& rect) {
  // A line is taken as endless rather than measured.
  constexpr double kEndless_em = 1e6;
  const auto* const text = std::get_if<TextItem>(&item);
  const Extent extent = text != nullptr ? extent_of(*text, 0, kEndless_em)
                                        : extent_of(std::get<RectangleItem>(item).bounds);
  return extent.left - kFixedPoint < rect.x_px + rect.width_px &&
         extent.right + kFixedPoint > rect.x_px &&
         extent.top - kFixedPoint < rect.y_px + rect.height_px &&
         extent.bottom + kFixedPoint > rect.y_px;
}

std::vector<PixelRect> damage(const DrawList& before, const DrawList& after,
                              const MeasureText& width_em) {
  Damage result(after);
  if (!have_same_items(before, after)) {
    result.add_frame();
    return result.take();
  }
  for (std::size_t i = 0; i < after.items.size(); ++i) {
    const DrawItem& a = before.items[i];
    const DrawItem& b = after.items[i];
    if (a == b) continue;
    if (const auto* rectangle = std::get_if<RectangleItem>(&a)) {
      compare(*rectangle, std::get<RectangleItem>(b), result);
    } else if (const auto* text = std::get_if<TextItem>(&a)) {
      compare(*text, std::get<TextItem>(b), width_em, result);
    }
  }
  return result.take();
}

}  // namespace piblocks
