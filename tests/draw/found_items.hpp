// What is found in pictures: items by what they show, the room that texts take, pixels.
// In: draw lists. Out: their items, what is wrong with their texts, what is painted of them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <functional>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "draw/canvas.hpp"
#include "draw/draw_list.hpp"
#include "draw/font.hpp"

namespace piblocks {

inline constexpr Color kWhite = {255, 255, 255};
inline constexpr Color kGreen = {10, 200, 30};

inline ItemId id_of(const DrawItem& item) {
  return std::visit([](const auto& any) { return any.id; }, item);
}

inline bool shows(ItemId item, ItemId thing) {
  return static_cast<std::uint32_t>(item) >> 16 == static_cast<std::uint32_t>(thing) >> 16;
}

/// From back to front.
inline bool have_rising_ids(const DrawList& list) {
  return std::ranges::adjacent_find(list.items, std::ranges::greater_equal(), id_of) ==
         list.items.end();
}

/// All items of a kind.
template <typename Item>
std::vector<Item> items_of(const std::vector<DrawItem>& items) {
  std::vector<Item> found;
  for (const DrawItem& item : items) {
    if (const auto* one = std::get_if<Item>(&item)) found.push_back(*one);
  }
  return found;
}

/// Those that show one thing.
template <typename Item>
std::vector<Item> items_of(const std::vector<DrawItem>& items, ItemId thing) {
  std::vector<Item> found = items_of<Item>(items);
  std::erase_if(found, [&](const Item& item) { return !shows(item.id, thing); });
  return found;
}

/// Null if there is none.
template <typename Item>
const Item* find_item(const DrawList& list, ItemId id) {
  for (const DrawItem& item : list.items) {
    const auto* one = std::get_if<Item>(&item);
    if (one != nullptr && one->id == id) return one;
  }
  return nullptr;
}

/// @throws std::logic_error if there is none
template <typename Item>
const Item& item_of(const DrawList& list, ItemId id) {
  const Item* found = find_item<Item>(list, id);
  return found != nullptr ? *found : throw std::logic_error("no such item");
}

/// The room that the article's dashed wall takes.
inline Rect wall_of(const DrawList& list) {
  const auto& line = item_of<PathItem>(list, ItemId::wall);
  Rect room = line.points.bounds();
  room.x -= line.stroke->width_px / 2;
  room.width += line.stroke->width_px;
  return room;
}

inline std::string text_of(const DrawList& list, ItemId id) {
  const auto* text = find_item<TextItem>(list, id);
  return text != nullptr ? text->text : std::string();
}

/// What diagrams show, with the items of their plates.
struct Shown {
  explicit Shown(const DrawList& list) { add(list.items, false); }

  void add(const std::vector<DrawItem>& items, bool is_inside) {
    for (const DrawItem& item : items) {
      if (!is_inside && (id_of(item) < ItemId::panels || id_of(item) >= ItemId::card)) continue;
      if (const auto* plate = std::get_if<PlateItem>(&item)) {
        plates.push_back(*plate);
        add(plate->plate->items, true);
      }
      if (const auto* path = std::get_if<PathItem>(&item)) paths.push_back(*path);
      if (const auto* disc = std::get_if<DiscItem>(&item)) discs.push_back(*disc);
      if (const auto* text = std::get_if<TextItem>(&item)) texts.push_back(*text);
      if (const auto* bar = std::get_if<RectangleItem>(&item); bar != nullptr && !is_inside) {
        bars.push_back(*bar);
      }
    }
  }
  bool has_text(const std::string& wanted) const {
    return std::ranges::find(texts, wanted, &TextItem::text) != texts.end();
  }
  /// All that is written, from item to item.
  std::string words(const char* after_each = "") const {
    std::string all;
    for (const TextItem& text : texts) all += text.text + after_each;
    return all;
  }
  std::vector<PathItem> lines_of(const Color& color) const {
    std::vector<PathItem> found;
    for (const PathItem& path : paths) {
      if (path.stroke && path.stroke->color == color) found.push_back(path);
    }
    return found;
  }

  std::vector<PlateItem> plates;
  std::vector<PathItem> paths;
  std::vector<DiscItem> discs;
  std::vector<TextItem> texts;
  std::vector<RectangleItem> bars;  ///< that may move
};

/// A place that something takes.
struct Box : Rect {
  std::string what;
};

/// Of a text's capitals and figures, with what hangs below the line.
inline Box box_of(const TextItem& text, const Fonts& fonts) {
  return {{text.origin.x, text.origin.y - 0.76 * text.size_px,
           fonts.of(text.face).width_em(text.text) * text.size_px, 0.98 * text.size_px},
          text.text};
}

inline void add_boxes(const std::vector<DrawItem>& items, const Fonts& fonts,
                      std::vector<Box>& boxes) {
  for (const DrawItem& item : items) {
    if (const auto* text = std::get_if<TextItem>(&item)) boxes.push_back(box_of(*text, fonts));
    if (const auto* plate = std::get_if<PlateItem>(&item)) {
      add_boxes(plate->plate->items, fonts, boxes);
    }
  }
}

/// Around all texts, also those of diagrams.
inline std::vector<Box> boxes_of(const DrawList& list) {
  std::vector<Box> boxes;
  add_boxes(list.items, Fonts(), boxes);
  return boxes;
}

inline std::vector<Box> boxes_of(const std::vector<TextItem>& texts, const Fonts& fonts) {
  std::vector<Box> boxes;
  for (const TextItem& text : texts) boxes.push_back(box_of(text, fonts));
  return boxes;
}

inline bool overlap(const Rect& a, const Rect& b) {
  constexpr double kTouch_px = 0.5;
  return a.grown(-kTouch_px / 2).meets(b.grown(-kTouch_px / 2));
}

inline Rect whole_of(const DrawList& list) {
  return {0, 0, double(list.width_px), double(list.height_px)};
}

/// What is wrong with texts that shall be inside of a place and apart; "" if nothing is.
inline std::string text_problem(const std::vector<Box>& texts, const Rect& place) {
  for (std::size_t i = 0; i < texts.size(); ++i) {
    if (!place.holds(texts[i])) return "'" + texts[i].what + "' leaves its place";
    for (std::size_t k = 0; k < i; ++k) {
      if (overlap(texts[i], texts[k])) {
        return "'" + texts[i].what + "' meets '" + texts[k].what + "'";
      }
    }
  }
  return {};
}

/// Row by row.
inline std::vector<std::uint32_t> pixels_of(const ImageView& image) {
  const auto width = static_cast<std::size_t>(image.width_px);
  std::vector<std::uint32_t> words(width * static_cast<std::size_t>(image.height_px));
  for (int y = 0; y < image.height_px; ++y) {
    std::memcpy(words.data() + width * static_cast<std::size_t>(y), image.row(y), 4 * width);
  }
  return words;
}

/// On a canvas of its own.
inline std::vector<std::uint32_t> painted(const DrawList& list) {
  Canvas canvas(list.width_px, list.height_px,
                list.background ? Background::opaque : Background::transparent);
  canvas.paint(list);
  return pixels_of(canvas.view());
}

/// Red, green and blue of a pixel; the upper byte is 0.
inline std::uint32_t color_at(const Canvas& canvas, int x, int y) {
  std::uint32_t word = 0;
  std::memcpy(&word, canvas.view().row(y) + 4 * x, 4);
  return word & 0xFFFFFF;
}

}  // namespace piblocks
