// Scenes of two blocks and their pictures.
// In: settings as on the command line. Out: draw lists.
#pragma once

#include <piblocks/script.hpp>

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "draw/composition.hpp"
#include "draw/found_items.hpp"
#include "draw/layout.hpp"
#include "draw/look.hpp"
#include "support/state_after.hpp"

namespace piblocks {

inline constexpr std::array kThemeNames{"article", "lecture", "lecture-light", "chalkboard",
                                        "dark",    "print",   "colorblind"};

inline const Palette kLecturePalette = palette_of(Theme::lecture);

/// The size of a picture, and its diagrams.
struct PanelShape {
  const char* size;
  const char* panels;
};

using Setting = std::pair<const char*, std::string>;
using Settings = std::vector<Setting>;

inline Settings operator+(Settings settings, const Settings& more) {
  settings.insert(settings.end(), more.begin(), more.end());
  return settings;
}

/// In the article's theme, unless a setting names another one.
inline Scene scene_with(const Settings& settings) {
  ScriptBuilder builder;
  builder.set("test", "view.theme", "article");
  for (const auto& [key, text] : settings) builder.set("test", key, text);
  return builder.build_scene();
}

inline Scene scene_with(int digits, const Settings& settings) {
  return scene_with(Settings{{"digits", std::to_string(digits)}} + settings);
}

inline View view_of_size(int width_px, int height_px) {
  View view;
  view.theme = Theme::article;
  view.width_px = width_px;
  view.height_px = height_px;
  return view;
}

struct Pictures {
  explicit Pictures(Scene of)
      : scene(std::move(of)), log(make_pair_log(scene.system)), composition(scene, *log) {}
  Pictures(int digits, const Settings& settings) : Pictures(scene_with(digits, settings)) {}

  DrawList at(const Rational& time, const Rational& slowdown = 1) const {
    return composition.frame({.state = log->state_at(time),
                              .time = time,
                              .slowdown = slowdown,
                              .gaps = log->gaps_at(time)});
  }
  DrawList after(const Integer& index) const {
    return composition.frame({bodies_after(*log, index)});
  }
  Rational turn() const { return *turn_of(log->blocks()); }

  Scene scene;
  std::unique_ptr<PairLog> log;
  Composition composition;
};

/// What overlays are made from, of two blocks and a wall.
struct Drawing {
  explicit Drawing(const Scene& scene)
      : log(make_pair_log(scene.system)),
        colors(colors_of(scene, &log->blocks())),
        palette(palette_of(scene.view, log->blocks(), colors)),
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

/// "red 1.25 + blue 3.75 = 5" and the like: the number after a word.
inline double number_after(std::string text, const std::string& word) {
  std::erase(text, ',');
  return std::stod(text.substr(text.find(word) + word.size()));
}

inline bool has_text(const DrawList& list, const std::string& wanted) {
  const auto texts = items_of<TextItem>(list.items);
  return std::ranges::find(texts, wanted, &TextItem::text) != texts.end();
}

}  // namespace piblocks
