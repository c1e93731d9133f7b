#include "draw/look.hpp"

#include <array>

namespace piblocks {
namespace {

constexpr Color kWhite = {255, 255, 255};
constexpr Color kBlack = {0, 0, 0};

constexpr Palette kArticle = {
    .background = kWhite,
    .wall = kBlack,
    .blue = {{38, 84, 204}, {22, 52, 134}, kWhite, {38, 84, 204}, {38, 84, 204}, 0, "blue"},
    .red = {{214, 48, 40}, {138, 24, 20}, kWhite, {214, 48, 40}, {206, 42, 34}, 0, "red"},
    .text = {16, 16, 16},
    .muted = {96, 96, 96},
    .accent = {168, 72, 0},
    .done = {20, 122, 70},
    .grid = {146, 146, 146},
    .shade = {170, 180, 204},
};

constexpr Color kInk = {242, 243, 245};
constexpr Color kLightBlue = {90, 169, 255};
constexpr Color kLightRed = {255, 107, 94};
constexpr Palette kLecture = {
    .background = {15, 18, 22},
    .wall = kInk,
    .blue = {kLightBlue, kLightBlue, {8, 16, 30}, kLightBlue, kLightBlue, 0, "blue"},
    .red = {kLightRed, kLightRed, {34, 8, 4}, kLightRed, kLightRed, 0, "red"},
    .text = kInk,
    .muted = {154, 163, 176},
    .accent = {255, 209, 102},
    .done = {87, 211, 140},
    .grid = {88, 100, 117},
    .shade = {66, 75, 89},
};

constexpr Color kDeepBlue = {47, 134, 230};
constexpr Color kDeepRed = {229, 72, 59};
constexpr Palette kLectureLight = {
    .background = {251, 250, 247},
    .wall = {20, 24, 31},
    .blue = {kDeepBlue, kDeepBlue, {4, 12, 26}, kDeepBlue, {31, 111, 204}, 0, "blue"},
    .red = {kDeepRed, kDeepRed, {30, 4, 0}, kDeepRed, {201, 52, 40}, 0, "red"},
    .text = {20, 24, 31},
    .muted = {89, 98, 111},
    .accent = {172, 90, 0},
    .done = {27, 127, 75},
    .grid = {134, 142, 154},
    .shade = {164, 174, 186},
};

constexpr Palette kChalkboard = {
    .background = {32, 56, 46},
    .wall = {236, 238, 228},
    .blue = {{126, 178, 226},
             {226, 240, 250},
             {16, 34, 46},
             {150, 198, 240},
             {150, 198, 240},
             0,
             "blue"},
    .red = {{230, 134, 116},
            {252, 230, 222},
            {52, 18, 12},
            {240, 148, 130},
            {240, 148, 130},
            0,
            "red"},
    .text = {244, 245, 236},
    .muted = {188, 204, 192},
    .accent = {248, 222, 126},
    .done = {150, 226, 150},
    .grid = {104, 132, 117},
    .shade = {78, 106, 96},
};

constexpr Palette kDark = {
    .background = {17, 18, 22},
    .wall = {222, 224, 230},
    .blue =
        {{88, 146, 246}, {182, 210, 255}, {8, 16, 36}, {108, 162, 255}, {108, 162, 255}, 0, "blue"},
    .red = {{240, 94, 84}, {255, 192, 184}, {40, 8, 6}, {246, 110, 100}, {246, 110, 100}, 0, "red"},
    .text = {240, 241, 245},
    .muted = {166, 170, 182},
    .accent = {255, 206, 92},
    .done = {112, 214, 140},
    .grid = {92, 97, 110},
    .shade = {66, 73, 92},
};

constexpr Palette kPrint = {
    .background = kWhite,
    .wall = kBlack,
    .blue = {{180, 180, 180}, kBlack, kBlack, kBlack, kBlack, 0, "left", "left block"},
    .red =
        {{112, 112, 112}, kBlack, kWhite, {112, 112, 112}, {84, 84, 84}, 4, "right", "right block"},
    .text = kBlack,
    .muted = {72, 72, 72},
    .accent = kBlack,
    .done = kBlack,
    .grid = {144, 144, 144},
    .shade = {180, 180, 180},
};

// Blue and vermilion of Okabe and Ito, "Color Universal Design" (2008).
constexpr Palette kColorblind = {
    .background = kWhite,
    .wall = kBlack,
    .blue =
        {{0, 114, 178}, {0, 58, 92}, kWhite, {0, 114, 178}, {0, 114, 178}, 0, "left", "left block"},
    .red = {{230, 130, 50},
            {110, 50, 0},
            kBlack,
            {213, 94, 0},
            {180, 72, 0},
            4,
            "right",
            "right block"},
    .text = {16, 16, 16},
    .muted = {84, 84, 84},
    .accent = {0, 96, 72},
    .done = {0, 96, 72},
    .grid = {144, 144, 144},
    .shade = {160, 184, 200},
};

}  // namespace

Palette palette_of(Theme theme) {
  // In the order of Theme.
  constexpr std::array kPalettes = {kArticle, kLecture, kLectureLight, kChalkboard,
                                    kDark,    kPrint,   kColorblind};
  return kPalettes.at(static_cast<std::size_t>(theme));
}

Palette palette_of(Theme theme, const BlockSystem& system) {
  Palette palette = palette_of(theme);
  const bool has_colors_as_names = palette.blue.name == palette.blue.full_name;
  if (has_colors_as_names || system.blue.mass == system.red.mass) return palette;
  const bool is_red_large = system.red.mass > system.blue.mass;
  BlockColors& large = is_red_large ? palette.red : palette.blue;
  BlockColors& small = is_red_large ? palette.blue : palette.red;
  large.name = "large";
  large.full_name = "large block";
  small.name = "small";
  small.full_name = "small block";
  return palette;
}

std::optional<Color> background_of(const View& view) {
  if (view.background == Background::transparent) return std::nullopt;
  return palette_of(view.theme).background;
}

}  // namespace piblocks
