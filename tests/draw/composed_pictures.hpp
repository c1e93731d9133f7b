// Scenes, their pictures and the texts in them.
// In: settings as on the command line. Out: draw lists, and boxes around texts.
#pragma once

#include <piblocks/script.hpp>

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "draw/composition.hpp"
#include "draw/font.hpp"
#include "draw/layout.hpp"

namespace piblocks {

inline constexpr std::array kThemeNames{"article", "lecture", "lecture-light", "chalkboard",
                                        "dark",    "print",   "colorblind"};

using Setting = std::pair<const char*, std::string>;

inline Scene scene_with(int digits, const std::vector<Setting>& settings) {
  ScriptBuilder builder;
  builder.set("test", "digits", std::to_string(digits));
  for (const auto& [key, text] : settings) builder.set("test", key, text);
  return builder.build_scene();
}

struct Pictures {
  explicit Pictures(const Scene& scene)
      : log(make_pair_log(scene.system)), composition(scene, *log) {}

  DrawList at(const Rational& time, const Rational& slowdown = 1) const {
    return composition.frame({.state = log->state_at(time),
                              .time = time,
                              .slowdown = slowdown,
                              .gaps = log->gaps_at(time)});
  }

  std::unique_ptr<PairLog> log;
  Composition composition;
};

/// What overlays are made from, of two blocks and a wall.
struct Drawing {
  explicit Drawing(const Scene& scene)
      : log(make_pair_log(scene.system)),
        colors(colors_of(scene, &log->blocks())),
        palette(palette_of(scene.view.theme, log->blocks(), colors)),
        sizes(scene.view),
        context{
            {scene, *log, palette, colors, fonts, fonts.of(text_face_of(scene.view.theme)), sizes},
            layout} {}

  std::unique_ptr<PairLog> log;
  std::vector<BlockColors> colors;
  Palette palette;
  Fonts fonts;
  Layout layout;
  Sizes sizes;
  DrawingContext context;
};

struct Box {
  double left;
  double top;
  double right;
  double bottom;
  std::string what;
};

/// Of a text's capitals and figures, with what hangs below the line.
inline Box box_of(const TextItem& text, const Fonts& fonts) {
  return {text.origin.x, text.origin.y - 0.76 * text.size_px,
          text.origin.x + fonts.of(text.face).width_em(text.text) * text.size_px,
          text.origin.y + 0.2 * text.size_px, text.text};
}

inline void add_texts(const std::vector<DrawItem>& items, const Fonts& fonts,
                      std::vector<Box>& boxes) {
  for (const DrawItem& item : items) {
    if (const auto* text = std::get_if<TextItem>(&item)) boxes.push_back(box_of(*text, fonts));
    if (const auto* plate = std::get_if<PlateItem>(&item)) {
      add_texts(plate->plate->items, fonts, boxes);
    }
  }
}

inline std::vector<Box> texts_of(const DrawList& list) {
  std::vector<Box> boxes;
  add_texts(list.items, Fonts(), boxes);
  return boxes;
}

inline bool overlap(const Box& a, const Box& b) {
  constexpr double kTouch_px = 0.5;
  return a.left < b.right - kTouch_px && b.left < a.right - kTouch_px &&
         a.top < b.bottom - kTouch_px && b.top < a.bottom - kTouch_px;
}

inline std::string text_of(const DrawList& list, ItemId id) {
  for (const DrawItem& item : list.items) {
    const auto* text = std::get_if<TextItem>(&item);
    if (text != nullptr && text->id == id) return text->text;
  }
  return {};
}

inline bool has_text(const DrawList& list, const std::string& wanted) {
  return std::ranges::any_of(list.items, [&](const DrawItem& item) {
    const auto* text = std::get_if<TextItem>(&item);
    return text != nullptr && text->text == wanted;
  });
}

}  // namespace piblocks
