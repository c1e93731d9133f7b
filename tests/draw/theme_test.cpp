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

std::vector<Color> grounds() {
  constexpr int kStep = 17;
  std::vector<Color> all;
  for (int red = 0; red < 256; red += kStep) {
    for (int green = 0; green < 256; green += kStep) {
      for (int blue = 0; blue < 256; blue += kStep) {
        all.push_back({std::uint8_t(red), std::uint8_t(green), std::uint8_t(blue)});
      }
    }
  }
  return all;
}

RgbColor rgb(const Color& color) { return {color.red, color.green, color.blue}; }

/// Black or white has a contrast of 4.58 at least to any ground, so that text always can.
TEST(Theme, EverythingStandsOutFromAnyGround) {
  for (const Theme theme : kThemes) {
    for (const Color& ground : grounds()) {
      SCOPED_TRACE(exact_text(theme) + " on " + exact_text(rgb(ground)));
      const Palette palette = palette_of(theme, {.background = rgb(ground)});
      ASSERT_EQ(palette.background, ground);
      for (const auto& [name, color, below, least] : parts_of(palette)) {
        // Bars stand out from the block as well as they can: the block stands out from the ground.
        const bool is_bars = std::string_view(name) == "bars";
        ASSERT_GE(contrast(color, below), is_bars ? 2 : least) << name;
      }
      // Those of print are greys, and told by their bars.
      ASSERT_TRUE(palette.blue.fill != palette.red.fill || palette.red.bars > 0);
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

TEST(Theme, AColourOfItsOwnChangesNoOther) {
  Scene scene = scene_of(3, Theme::lecture);
  for (std::size_t turn = 0; turn < 6; ++turn) {
    const std::size_t own = turn / 2;
    for (std::size_t i = 0; i < 3; ++i) scene.system.bodies[i].mass = turn % 2 * i + 1;
    const std::vector<BlockColors> before = colors_of(scene, nullptr);
    Scene other = scene;
    other.system.bodies.insert(
        other.system.bodies.begin() + std::ptrdiff_t(own),
        {.mass = own == 1 ? Rational(3, 2) : Rational(1000), .position = {9}});
    other.styles.insert(other.styles.begin() + std::ptrdiff_t(own), BodyStyle{{{140, 140, 140}}});
    std::vector<BlockColors> after = colors_of(other, nullptr);
    after.erase(after.begin() + std::ptrdiff_t(own));
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(after[i].fill, before[i].fill) << own << i;
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
    return palette_of(scene.view, blocks, colors_of(scene, &blocks)).red.full_name();
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

TEST(Theme, OwnColoursStay) {
  const Colors own{.background = RgbColor{253, 246, 227},
                   .ink = RgbColor{7, 54, 66},
                   .accent = RgbColor{253, 246, 200},  // hardly seen
                   .muted = RgbColor{88, 110, 117},
                   .done = RgbColor{133, 153, 0},
                   .grid = RgbColor{147, 161, 161}};
  for (const Theme theme : kThemes) {
    const Palette palette = palette_of(theme, own);
    EXPECT_EQ(rgb(palette.background), own.background);
    EXPECT_EQ(rgb(palette.text), own.ink);
    EXPECT_EQ(rgb(palette.wall), own.ink);
    EXPECT_EQ(rgb(palette.accent), own.accent);
    EXPECT_EQ(rgb(palette.muted), own.muted);
    EXPECT_EQ(rgb(palette.done), own.done);
    EXPECT_EQ(rgb(palette.grid), own.grid);
  }
}

TEST(Theme, AnAccentAloneChangesNothingElse) {
  const Palette usual = palette_of(Theme::lecture);
  const Palette own = palette_of(Theme::lecture, {.accent = RgbColor{255, 120, 0}});
  EXPECT_EQ(own.accent, (Color{255, 120, 0}));
  EXPECT_EQ(own.background, usual.background);
  EXPECT_EQ(own.text, usual.text);
  EXPECT_EQ(own.done, usual.done);
  EXPECT_EQ(own.grid, usual.grid);
  EXPECT_EQ(own.red.fill, usual.red.fill);
}

TEST(Theme, AnInkAloneIsMixedWithTheThemesGround) {
  const Color ink{120, 255, 120};
  const Palette palette = palette_of(Theme::lecture, {.ink = rgb(ink)});
  EXPECT_EQ(palette.background, palette_of(Theme::lecture).background);
  for (const Color& mixed : {palette.muted, palette.grid, palette.shade}) {
    EXPECT_GT(mixed.green, mixed.red) << "green as the ink";
    EXPECT_LT(mixed.green, ink.green);
  }
}

std::vector<std::string> notes_of(const Colors& own, const std::optional<RgbColor>& red = {}) {
  Scene scene;
  scene.view.theme = Theme::article;
  scene.view.colors = own;
  scene.styles[1].color = red;
  return contrast_notes(scene);
}

/// Greys on white: contrasts of 4.54 and 4.48 (#767676, #777777), 3.03 and 2.97 (#949494, #969696),
/// 2.01 and 1.98 (#b7b7b7, #b8b8b8), by WCAG's formula.
TEST(ContrastNotes, NameWhatIsHardToSee) {
  const Colors seen{.ink = RgbColor{0x76, 0x76, 0x76}, .grid = RgbColor{0x94, 0x94, 0x94}};
  EXPECT_EQ(notes_of(seen, RgbColor{0xb7, 0xb7, 0xb7}), std::vector<std::string>());
  const Colors unseen{.ink = RgbColor{0x77, 0x77, 0x77}, .grid = RgbColor{0x96, 0x96, 0x96}};
  EXPECT_EQ(notes_of(unseen, RgbColor{0xb8, 0xb8, 0xb8}),
            (std::vector<std::string>{
                "view.colors.ink = #777777: its contrast to the background #ffffff is 4.4; text "
                "needs 4.5",
                "view.colors.grid = #969696: its contrast to the background #ffffff is 2.9; a line "
                "needs 3",
                "red.color = #b8b8b8: its contrast to the background #ffffff is 1.9; a body needs "
                "2"}));
}

TEST(ContrastNotes, AreOfTheBackgroundThatIsThere) {
  const Colors on_navy{.background = RgbColor{11, 37, 69}, .accent = RgbColor{255, 230, 120}};
  EXPECT_TRUE(notes_of(on_navy).empty());
  EXPECT_EQ(notes_of({.accent = RgbColor{255, 230, 120}}).size(), 1U) << "on white";
  Scene scene;
  scene.view.colors.accent = RgbColor{255, 230, 120};
  scene.view.background = Background::transparent;
  EXPECT_TRUE(contrast_notes(scene).empty());
}

TEST(ContrastNotes, AreAtMostADozen) {
  Scene scene = scene_of(40, Theme::article);
  for (std::size_t i = 0; i < 40; ++i) scene.styles[i].color = RgbColor{255, 255, 255};
  const std::vector<std::string> notes = contrast_notes(scene);
  ASSERT_EQ(notes.size(), 12U);
  EXPECT_EQ(notes[11].substr(0, 24), "body 12.color = #ffffff:");
}

/// What must be told from each other: marks and paths in diagrams.
std::array<Color, 4> marks_of(const Palette& palette) {
  return {palette.accent, palette.done, palette.blue.line, palette.red.line};
}

TEST(Theme, MarksDiffer) {
  for (const Theme theme : kThemes) {
    if (theme == Theme::print) continue;  // told by place, pattern and words
    const auto marks = marks_of(palette_of(theme));
    for (std::size_t i = 0; i < marks.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        EXPECT_GT(difference(marks[i], marks[j]), 30) << exact_text(theme) << ' ' << i << ' ' << j;
      }
    }
  }
}

TEST(Theme, MarksDifferForTheColourBlind) {
  const auto marks = marks_of(palette_of(Theme::colorblind));
  for (const Vision& vision : {kProtanopia, kDeuteranopia, kTritanopia}) {
    for (std::size_t i = 0; i < marks.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        EXPECT_GT(difference(marks[i], marks[j], vision), 20) << i << ' ' << j;
      }
    }
  }
}

TEST(Theme, DarkIsNotTheLecture) {
  const auto blackness = [](Theme theme) { return difference(palette_of(theme).background, {}); };
  EXPECT_GT(blackness(Theme::dark), blackness(Theme::lecture) + 10);
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
