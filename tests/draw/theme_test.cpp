#include <gtest/gtest.h>

#include <array>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "draw/contrast.hpp"
#include "draw/look.hpp"

namespace piblocks {
namespace {

struct Part {
  const char* name;
  Color color;
  Color ground;
  double least;  ///< contrast
};

/// What is seen in pictures, and on what. WCAG 2.1, 1.4.3 for text and 1.4.11 for lines.
std::vector<Part> parts_of(const Palette& palette, const std::vector<BlockColors>& bodies = {}) {
  const Color ground = palette.background;
  std::vector<Part> parts{{"text", palette.text, ground, 4.5},
                          {"muted text", palette.muted, ground, 4.5},
                          {"accent", palette.accent, ground, 4.5},
                          {"done", palette.done, ground, 4.5},
                          {"text on a filled area", palette.text, palette.shade, 4.5},
                          {"wall and floor", palette.wall, ground, 3},
                          {"grid", palette.grid, ground, 3},
                          {"filled area", palette.shade, ground, 2}};
  std::vector<const BlockColors*> blocks{&palette.blue, &palette.red};
  for (const BlockColors& body : bodies) blocks.push_back(&body);
  for (const BlockColors* block : blocks) {
    parts.push_back({"text on a block", block->text, block->fill, 4.5});
    parts.push_back({"text about a block", block->label, ground, 4.5});
    parts.push_back({"a block's path", block->line, ground, 3});
    parts.push_back({"a block's edge", block->edge, ground, 3});
    parts.push_back({"a block", block->fill, ground, 2});
    if (block->bars > 0) parts.push_back({"bars", block->edge, block->fill, 3});
  }
  return parts;
}

TEST(Theme, EverythingStandsOutFromItsGround) {
  for (const Theme theme : kThemes) {
    for (const auto& [name, color, ground, least] : parts_of(palette_of(theme))) {
      EXPECT_GE(contrast(color, ground), least) << name << " of " << exact_text(theme);
      EXPECT_EQ(color.alpha, 255) << name;
    }
  }
}

Scene scene_of(std::size_t bodies, Theme theme) {
  Scene scene;
  scene.system = {1, std::vector<Body>(bodies), {}};
  scene.styles.resize(bodies);
  scene.view.theme = theme;
  return scene;
}

/// Bodies have further colours, or any that a scene gives them.
TEST(Theme, BodiesStandOutFromTheirGround) {
  std::mt19937 random(1);
  for (const Theme theme : kThemes) {
    Scene scene = scene_of(12, theme);
    const auto expect_contrasts = [&] {
      for (const Part& part : parts_of(palette_of(theme), colors_of(scene, nullptr))) {
        // Filled areas with an edge may be pale, and bars are of the theme's colours alone.
        const std::string name = part.name;
        if (name == "a block" || (name == "bars" && scene.styles[0].color)) continue;
        EXPECT_GE(contrast(part.color, part.ground), part.least)
            << name << " of " << exact_text(theme);
      }
    };
    expect_contrasts();
    for (BodyStyle& style : scene.styles) {
      const auto level = [&] { return static_cast<std::uint8_t>(random() % 256); };
      style.color = {level(), level(), level()};
    }
    expect_contrasts();
  }
}

/// By mass: the lightest is blue and the heaviest red, wherever they are in the file.
TEST(Theme, TheLightBodyIsBlueAndTheHeavyOneRed) {
  const auto fills = [](const std::vector<std::optional<Rational>>& masses, const char* name = "") {
    Scene scene = scene_of(masses.size(), Theme::lecture);
    for (std::size_t i = 0; i < masses.size(); ++i) scene.system.bodies[i].mass = masses[i];
    scene.system.bodies[0].name = name;
    std::vector<Color> found;
    for (const BlockColors& colors : colors_of(scene, nullptr)) found.push_back(colors.fill);
    return found;
  };
  const Palette palette = palette_of(Theme::lecture);
  const Color blue = palette.blue.fill;
  const Color red = palette.red.fill;
  EXPECT_EQ(fills({10, 1}), (std::vector{red, blue}));
  EXPECT_EQ(fills({10, 1}, "blue"), (std::vector{blue, blue})) << "its key has a name";
  const std::vector<Color> row = fills({1, 2, 4, 8, 4, 2, 1});
  EXPECT_EQ((std::vector{row[0], row[3], row[6]}), (std::vector{blue, red, blue}));
  EXPECT_EQ((std::vector{row[1], row[2]}), (std::vector{row[5], row[4]})) << "equal masses";
  EXPECT_NE(row[1], row[2]);
  EXPECT_EQ(fills({std::nullopt, 1, std::nullopt, 1})[1], blue)
      << "equal masses have theirs in turn";
  EXPECT_EQ(fills({std::nullopt, 1, std::nullopt, 1})[3], red);
  std::vector<std::optional<Rational>> many(20, Rational(1));
  EXPECT_EQ(std::ranges::count(fills(many), blue), 20);
  many[7] = 50;
  EXPECT_EQ(fills(many)[7], red);
  EXPECT_EQ(std::ranges::count(fills(many), blue), 19);
}

TEST(Theme, BlocksDifferFromEachOther) {
  for (const Theme theme : kThemes) {
    const Palette palette = palette_of(theme);
    EXPECT_NE(palette.blue.fill, palette.red.fill) << exact_text(theme);
    EXPECT_NE(palette.blue.line, palette.red.line) << exact_text(theme);
  }
}

TEST(Theme, PatternsTellBlocksApartWhereColoursMayNot) {
  for (const Theme theme : {Theme::print, Theme::colorblind}) {
    const Palette palette = palette_of(theme);
    EXPECT_NE(palette.red.bars, palette.blue.bars) << exact_text(theme);
    const Scene scene = scene_of(12, theme);
    const std::vector<BlockColors> colors = colors_of(scene, nullptr);
    for (std::size_t i = 1; i < colors.size(); ++i) EXPECT_NE(colors[i].bars, colors[i - 1].bars);
  }
}

/// In degrees, as in HSV; nothing if the colour is nearly grey.
std::optional<double> hue_of(const Color& color) {
  const double high = std::max({color.red, color.green, color.blue});
  const double low = std::min({color.red, color.green, color.blue});
  if (high - low < 0.3 * high) return std::nullopt;
  const auto sixth = [&](double a, double b) { return 60 * (a - b) / (high - low); };
  if (high == color.red) return sixth(color.green, color.blue);
  if (high == color.green) return 120 + sixth(color.blue, color.red);
  return 240 + sixth(color.red, color.green);
}

TEST(Theme, BlocksAreCalledByColoursThatTheyHave) {
  for (const Theme theme : kThemes) {
    SCOPED_TRACE(exact_text(theme));
    const Palette palette = palette_of(theme);
    const auto red = hue_of(palette.red.fill);
    const auto blue = hue_of(palette.blue.fill);
    const bool are_red_and_blue = red && std::abs(*red) < 15 && blue && std::abs(*blue - 220) < 25;
    EXPECT_EQ(palette.red.name, std::string(are_red_and_blue ? "red" : "right"));
    EXPECT_EQ(palette.blue.name, std::string(are_red_and_blue ? "blue" : "left"));
  }
}

TEST(Theme, BlocksWithoutColoursAreCalledBySize) {
  const auto name_of_red = [](Theme theme, const TwoBlocks& blocks, BodyStyle style = {}) {
    Scene scene;
    scene.system = system_of(blocks);
    scene.styles[0] = style;
    scene.view.theme = theme;
    return std::string(palette_of(theme, blocks, colors_of(scene, &blocks)).red.full_name);
  };
  System system = article_system(2);
  EXPECT_EQ(name_of_red(Theme::print, *two_blocks_of(system)), "large block");
  std::swap(system.bodies[0].mass, system.bodies[1].mass);
  EXPECT_EQ(name_of_red(Theme::colorblind, *two_blocks_of(system)), "small block");
  EXPECT_EQ(name_of_red(Theme::lecture, *two_blocks_of(system)), "red");
  TwoBlocks equal = *two_blocks_of(article_system(1));
  EXPECT_EQ(name_of_red(Theme::colorblind, equal), "right block");
  equal.side = -1;
  EXPECT_EQ(name_of_red(Theme::colorblind, equal), "left block");
  EXPECT_EQ(name_of_red(Theme::lecture, equal), "red");
  const BodyStyle green{std::array<std::uint8_t, 3>{0, 200, 0}, {}};
  EXPECT_EQ(name_of_red(Theme::lecture, equal, green), "left block");
}

TEST(Theme, PrintIsGrey) {
  const Palette palette = palette_of(Theme::print);
  for (const Color& color :
       {palette.background, palette.wall, palette.text, palette.muted, palette.accent, palette.done,
        palette.grid, palette.shade, palette.blue.fill, palette.blue.edge, palette.blue.text,
        palette.blue.line, palette.red.fill, palette.red.edge, palette.red.text,
        palette.red.line}) {
    EXPECT_TRUE(color.red == color.green && color.green == color.blue);
  }
}

}  // namespace
}  // namespace piblocks
