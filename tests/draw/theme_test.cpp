#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "draw/look.hpp"

namespace piblocks {
namespace {

constexpr std::array kThemes{Theme::article,    Theme::lecture, Theme::lecture_light,
                             Theme::chalkboard, Theme::dark,    Theme::print,
                             Theme::colorblind};

/// WCAG 2.1, "relative luminance".
double luminance(const Color& color) {
  const auto linear = [](std::uint8_t sample) {
    const double value = sample / 255.0;
    return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * linear(color.red) + 0.7152 * linear(color.green) + 0.0722 * linear(color.blue);
}

/// WCAG 2.1, "contrast ratio".
double contrast(const Color& a, const Color& b) {
  const double x = luminance(a) + 0.05;
  const double y = luminance(b) + 0.05;
  return std::max(x, y) / std::min(x, y);
}

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
    const Palette palette = palette_of(theme);
    Scene scene = scene_of(12, theme);
    for (const Part& part : parts_of(palette, colors_of(scene, nullptr))) {
      // Filled areas with an edge may be pale.
      const bool is_pale = std::string(part.name) == "a block";
      if (is_pale) continue;
      EXPECT_GE(contrast(part.color, part.ground), part.least)
          << part.name << " of " << exact_text(theme);
    }
    for (BodyStyle& style : scene.styles) {
      const auto level = [&] { return static_cast<std::uint8_t>(random() % 256); };
      style.color = {level(), level(), level()};
    }
    for (const BlockColors& body : colors_of(scene, nullptr)) {
      EXPECT_GE(contrast(body.text, body.fill), 4.5) << exact_text(theme);
      EXPECT_GE(contrast(body.label, palette.background), 4.5) << exact_text(theme);
      EXPECT_GE(contrast(body.line, palette.background), 3) << exact_text(theme);
      EXPECT_GE(contrast(body.edge, palette.background), 3) << exact_text(theme);
    }
  }
}

TEST(Theme, NeighboursDifferWithoutColours) {
  for (const Theme theme : {Theme::print, Theme::colorblind}) {
    const Scene scene = scene_of(12, theme);
    const std::vector<BlockColors> colors = colors_of(scene, nullptr);
    for (std::size_t i = 1; i < colors.size(); ++i) EXPECT_NE(colors[i].bars, colors[i - 1].bars);
  }
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
