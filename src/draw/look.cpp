#include "draw/look.hpp"

#include <array>

namespace piblocks {
namespace {

constexpr Color kWhite = {255, 255, 255};
constexpr Color kBlack = {0, 0, 0};

constexpr Palette kArticle = {
    .background = kWhite,
    .wall = kBlack,
    .blue = {{38, 84, 204}, {22, 52, 134}, kWhite, {38, 84, 204}, 0, "blue"},
    .red = {{214, 48, 40}, {138, 24, 20}, kWhite, {214, 48, 40}, 0, "red"},
    .text = {16, 16, 16},
    .muted = {96, 96, 96},
    .accent = {168, 72, 0},
    .grid = {196, 196, 196},
    .shade = {226, 232, 246},
};

constexpr Palette kChalkboard = {
    .background = {32, 56, 46},
    .wall = {236, 238, 228},
    .blue = {{126, 178, 226}, {226, 240, 250}, {16, 34, 46}, {150, 198, 240}, 0, "blue"},
    .red = {{230, 134, 116}, {252, 230, 222}, {52, 18, 12}, {240, 148, 130}, 0, "red"},
    .text = {244, 245, 236},
    .muted = {188, 204, 192},
    .accent = {248, 222, 126},
    .grid = {92, 118, 104},
    .shade = {54, 82, 74},
};

constexpr Palette kDark = {
    .background = {17, 18, 22},
    .wall = {222, 224, 230},
    .blue = {{88, 146, 246}, {182, 210, 255}, {8, 16, 36}, {108, 162, 255}, 0, "blue"},
    .red = {{240, 94, 84}, {255, 192, 184}, {40, 8, 6}, {246, 110, 100}, 0, "red"},
    .text = {240, 241, 245},
    .muted = {166, 170, 182},
    .accent = {255, 206, 92},
    .grid = {72, 76, 88},
    .shade = {36, 42, 58},
};

constexpr Palette kPrint = {
    .background = kWhite,
    .wall = kBlack,
    .blue = {kWhite, kBlack, kBlack, kBlack, 0, "left", "left block"},
    .red = {{208, 208, 208}, kBlack, kBlack, {128, 128, 128}, 4, "right", "right block"},
    .text = kBlack,
    .muted = {72, 72, 72},
    .accent = kBlack,
    .grid = {150, 150, 150},
    .shade = {228, 228, 228},
};

// Blue and vermilion of Okabe and Ito, "Color Universal Design" (2008).
constexpr Palette kColorblind = {
    .background = kWhite,
    .wall = kBlack,
    .blue = {{0, 114, 178}, {0, 58, 92}, kWhite, {0, 114, 178}, 0, "left", "left block"},
    .red = {{230, 130, 50}, {110, 50, 0}, kBlack, {213, 94, 0}, 4, "right", "right block"},
    .text = {16, 16, 16},
    .muted = {84, 84, 84},
    .accent = {0, 96, 72},
    .grid = {190, 190, 190},
    .shade = {222, 234, 242},
};

}  // namespace

Palette palette_of(Theme theme) {
  // In the order of Theme.
  constexpr std::array kPalettes = {kArticle, kChalkboard, kDark, kPrint, kColorblind};
  return kPalettes.at(static_cast<std::size_t>(theme));
}

std::optional<Color> background_of(const View& view) {
  if (view.background == Background::transparent) return std::nullopt;
  return palette_of(view.theme).background;
}

}  // namespace piblocks
