#include "draw/look.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "draw/light.hpp"

namespace piblocks {
namespace {

constexpr Color kWhite = {255, 255, 255};
constexpr Color kBlack = {0, 0, 0};

// Blue and Red of Mathematica.
constexpr Color kPureBlue = {0, 0, 255};
constexpr Color kPureRed = {255, 0, 0};
constexpr Palette kArticle = {
    .background = kWhite,
    .wall = kBlack,
    .blue = {kPureBlue, kPureBlue, kWhite, kPureBlue, kPureBlue},
    .red = {kPureRed, kPureRed, kBlack, kPureRed, {206, 42, 34}},
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
    .blue = {kLightBlue, kLightBlue, {8, 16, 30}, kLightBlue, kLightBlue},
    .red = {kLightRed, kLightRed, {34, 8, 4}, kLightRed, kLightRed},
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
    .blue = {kDeepBlue, kDeepBlue, {4, 12, 26}, kDeepBlue, {31, 111, 204}},
    .red = {kDeepRed, kDeepRed, {30, 4, 0}, kDeepRed, {201, 52, 40}},
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
    .blue = {{126, 178, 226}, {226, 240, 250}, {16, 34, 46}, {150, 198, 240}, {150, 198, 240}},
    .red = {{230, 134, 116}, {252, 230, 222}, {52, 18, 12}, {240, 148, 130}, {240, 148, 130}},
    .text = {244, 245, 236},
    .muted = {188, 204, 192},
    .accent = {248, 222, 126},
    .done = {150, 226, 150},
    .grid = {104, 132, 117},
    .shade = {78, 106, 96},
};

constexpr Palette kDark = {
    .background = {46, 46, 46},
    .wall = {224, 224, 224},
    .blue = {{104, 166, 232}, {190, 218, 248}, {10, 18, 30}, {111, 176, 240}, {111, 176, 240}},
    .red = {{236, 112, 96}, {252, 204, 196}, {40, 8, 6}, {240, 120, 102}, {240, 120, 102}},
    .text = {240, 240, 240},
    .muted = {176, 176, 176},
    .accent = {255, 184, 77},
    .done = {120, 220, 170},
    .grid = {122, 122, 122},
    .shade = {94, 94, 94},
};

constexpr Palette kPrint = {
    .background = kWhite,
    .wall = kBlack,
    .blue = {{180, 180, 180}, kBlack, kBlack, kBlack, kBlack},
    .red = {{112, 112, 112}, kBlack, kWhite, {112, 112, 112}, {84, 84, 84}, 4},
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
    .blue = {{0, 114, 178}, {0, 58, 92}, kWhite, {0, 114, 178}, {0, 114, 178}},
    .red = {{230, 130, 50}, {110, 50, 0}, kBlack, {213, 94, 0}, {180, 72, 0}, 4},
    .text = {16, 16, 16},
    .muted = {84, 84, 84},
    .accent = {108, 0, 216},
    .done = {0, 84, 36},
    .grid = {144, 144, 144},
    .shade = {160, 184, 200},
};

// Least contrasts to the ground: WCAG 2.1, 1.4.3 and 1.4.11, and for filled areas.
constexpr double kTextContrast = 4.5;
constexpr double kLineContrast = 3;
constexpr double kFillContrast = 2;

constexpr std::array<double, 256> light_of_samples() {
  std::array<double, 256> light{};
  for (std::size_t i = 0; i < light.size(); ++i) light[i] = light_of(double(i) / 255);
  return light;
}
constexpr std::array<double, 256> kLight = light_of_samples();

/// WCAG 2.1, "relative luminance".
double luminance(const Color& color) {
  return 0.2126 * kLight[color.red] + 0.7152 * kLight[color.green] + 0.0722 * kLight[color.blue];
}

/// WCAG 2.1, "contrast ratio".
double contrast(const Color& a, const Color& b) {
  const auto [dark, light] = std::minmax({luminance(a), luminance(b)});
  return (light + 0.05) / (dark + 0.05);
}

Color mixed(const Color& from, const Color& to, double share) {
  const auto mix = [&](int a, int b) {
    return static_cast<std::uint8_t>(std::lround(a + share * (b - a)));
  };
  return {mix(from.red, to.red), mix(from.green, to.green), mix(from.blue, to.blue)};
}

/// The first colour on the way from `from` to `to` whose contrast to the ground is at least
/// `least`; `to` if there is none.
Color readable(const Color& from, const Color& to, const Color& ground, double least) {
  constexpr int kSteps = 50;
  for (int i = 0; i < kSteps; ++i) {
    const Color mix = mixed(from, to, double(i) / kSteps);
    if (contrast(mix, ground) >= least) return mix;
  }
  return to;
}

Color black_or_white_on(const Color& ground) {
  return contrast(kWhite, ground) > contrast(kBlack, ground) ? kWhite : kBlack;
}

Color color_of(const RgbColor& color) { return {color[0], color[1], color[2]}; }

/// A filled area that is seen on the ground: on the way to the text, or away from it where only
/// that leaves the text on it enough contrast.
Color shade_on(const Color& ground, const Color& text) {
  const Color nearer = readable(ground, text, ground, kFillContrast);
  if (contrast(text, nearer) >= kTextContrast) return nearer;
  const Color extreme = luminance(text) < luminance(ground) ? kWhite : kBlack;
  const Color farther = readable(ground, extreme, ground, kFillContrast);
  return contrast(farther, ground) >= kFillContrast ? farther : nearer;
}

/// Whether text can be read, also on filled areas.
bool is_readable(const Color& text, const Color& ground) {
  return contrast(text, ground) >= kTextContrast &&
         contrast(text, shade_on(ground, text)) >= kTextContrast;
}

/// The palette on another ground or with another ink: its colours, mixed with as much ink as makes
/// them seen; labels and axes between the two. On a light ground instead of a dark one, or the
/// other way round, the colours are those of a lecture, unless blocks have bars.
Palette adapted(Palette palette, const Colors& own) {
  const Color ground = own.background ? color_of(*own.background) : palette.background;
  const Color extreme = black_or_white_on(ground);
  if (extreme != black_or_white_on(palette.background) && palette.red.bars == 0) {
    palette = extreme == kWhite ? kLecture : kLectureLight;
  }
  palette.background = ground;
  if (own.ink) {
    palette.text = palette.wall = color_of(*own.ink);
  } else if (!is_readable(palette.text, ground)) {
    palette.text = palette.wall = extreme;
  }
  const auto with_contrast = [&](const Color& color, double least) {
    return readable(color, palette.text, ground, least);
  };
  palette.muted = with_contrast(mixed(palette.text, ground, 0.4), kTextContrast);
  palette.grid = with_contrast(mixed(palette.text, ground, 0.6), kLineContrast);
  palette.shade = shade_on(ground, palette.text);
  palette.accent = with_contrast(palette.accent, kTextContrast);
  palette.done = with_contrast(palette.done, kTextContrast);
  for (BlockColors* block : {&palette.blue, &palette.red}) {
    block->fill = with_contrast(block->fill, kFillContrast);
    block->edge = with_contrast(block->edge, kLineContrast);
    if (block->bars > 0 && contrast(block->edge, block->fill) < kLineContrast) {
      block->edge = palette.text;
    }
    if (contrast(block->text, block->fill) < kTextContrast) {
      block->text = black_or_white_on(block->fill);
    }
    block->line = with_contrast(block->line, kLineContrast);
    block->label = with_contrast(block->label, kTextContrast);
  }
  return palette;
}

/// Of more bodies than this all but the heaviest have one colour.
constexpr std::size_t kMostColored = 12;

/// Beside blue and red: green, orange, purple, and a blue green (Okabe and Ito, "Color Universal
/// Design", 2008, with a darker and a lighter form for light and dark backgrounds).
constexpr std::array<Color, 4> kOnLight = {
    {{0, 138, 100}, {204, 121, 0}, {150, 84, 160}, {0, 120, 140}}};
constexpr std::array<Color, 4> kOnDark = {
    {{86, 204, 150}, {245, 178, 70}, {206, 150, 220}, {92, 200, 214}}};
constexpr std::array<Color, 4> kGreys = {
    {{210, 210, 210}, {84, 84, 84}, {150, 150, 150}, {232, 232, 232}}};

/// Bars of bodies in turn, where themes tell bodies by them.
constexpr std::array<int, 6> kBars = {0, 4, 2, 0, 4, 2};

/// What goes with a colour that is not of the palette.
BlockColors colors_from(const Color& fill, Theme theme, const Palette& palette) {
  const bool is_dark = luminance(palette.background) < 0.2;
  // Bars have the edge's colour.
  const double share = is_dark ? 0.5 : palette.red.bars > 0 ? 0.7 : 0.375;
  Color edge = mixed(fill, is_dark ? kWhite : kBlack, share);
  if (theme == Theme::print) edge = palette.wall;
  if (is_lecture(theme) || theme == Theme::article) edge = fill;
  const auto with_contrast = [&](const Color& color, double least) {
    return readable(color, palette.text, palette.background, least);
  };
  return {fill, with_contrast(edge, kLineContrast), black_or_white_on(fill),
          with_contrast(fill, kLineContrast), with_contrast(fill, kTextContrast)};
}

/// Of each body, the place of its colour among blue, red and further ones. See colors_of().
std::vector<std::size_t> color_places(const Scene& scene) {
  const std::vector<Body>& bodies = scene.system.bodies;
  std::vector<Rational> masses;  // each once, from the lightest
  masses.reserve(bodies.size());
  const auto needs_no_place = [&](std::size_t i) {
    return !bodies[i].mass || scene.styles[i].color;
  };
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (!needs_no_place(i)) masses.push_back(*bodies[i].mass);
  }
  const bool are_many = masses.size() > kMostColored;
  std::ranges::sort(masses);
  masses.erase(std::unique(masses.begin(), masses.end()), masses.end());
  std::vector<std::size_t> places(bodies.size());
  std::size_t movable = 0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Body& body = bodies[i];
    if (needs_no_place(i)) continue;
    const auto found = std::ranges::lower_bound(masses, *body.mass);
    const auto rank = static_cast<std::size_t>(found - masses.begin());
    const bool is_heaviest = masses.size() > 1 && rank + 1 == masses.size();
    if (body.name == "blue" || body.name == "red") {
      places[i] = body.name == "red" ? 1 : 0;
    } else if (are_many || is_heaviest) {
      places[i] = is_heaviest ? 1 : 0;
    } else if (masses.size() > 1) {
      places[i] = rank == 0 ? 0 : 2 + (rank - 1) % kOnDark.size();
    } else {
      places[i] = movable++ % (2 + kOnDark.size());
    }
  }
  return places;
}

bool has_color_as_name(const BlockColors& block) {
  const std::string_view name = block.name;
  return name == "blue" || name == "red";
}

/// See colors_of().
void name(BlockColors& blue, BlockColors& red, const TwoBlocks& blocks) {
  if (has_color_as_name(blue) && has_color_as_name(red)) return;
  const Rational& inner = blocks.blue.mass;
  const Rational& outer = blocks.red.mass;
  if (inner == outer) {
    blue.name = blocks.side > 0 ? "left" : "right";
    red.name = blocks.side > 0 ? "right" : "left";
  } else {
    blue.name = inner < outer ? "small" : "large";
    red.name = inner < outer ? "large" : "small";
  }
}

}  // namespace

std::string BlockColors::full_name() const {
  return has_color_as_name(*this) ? name : fmt::format("{} block", name);
}

Palette palette_of(Theme theme, const Colors& own) {
  // In the order of Theme.
  constexpr std::array kPalettes = {kArticle, kLecture, kLectureLight, kChalkboard,
                                    kDark,    kPrint,   kColorblind};
  Palette palette = kPalettes.at(static_cast<std::size_t>(theme));
  if (own.background || own.ink) palette = adapted(palette, own);
  const bool has_bars = palette.red.bars > 0;
  palette.blue.name = has_bars ? "left" : "blue";
  palette.red.name = has_bars ? "right" : "red";
  if (own.accent) palette.accent = color_of(*own.accent);
  if (own.muted) palette.muted = color_of(*own.muted);
  if (own.done) palette.done = color_of(*own.done);
  if (own.grid) palette.grid = color_of(*own.grid);
  return palette;
}

Palette palette_of(const View& view, const TwoBlocks& blocks,
                   const std::vector<BlockColors>& colors) {
  Palette palette = palette_of(view);
  palette.blue = colors[blocks.blue_id];
  palette.red = colors[blocks.red_id];
  return palette;
}

std::vector<BlockColors> colors_of(const Scene& scene, const TwoBlocks* blocks) {
  const Theme theme = scene.view.theme;
  const Palette palette = palette_of(scene.view);
  const std::vector<Body>& all = scene.system.bodies;
  const bool is_dark = luminance(palette.background) < 0.2;
  const bool has_bars = palette.red.bars > 0;
  std::vector<BlockColors> turns = {palette.blue, palette.red};
  for (const Color& more : theme == Theme::print ? kGreys : is_dark ? kOnDark : kOnLight) {
    turns.push_back(colors_from(more, theme, palette));
    if (has_bars) turns.back().bars = kBars.at(turns.size() - 1);
  }
  const BlockColors fixed = colors_from(palette.muted, theme, palette);
  const std::vector<std::size_t> places = color_places(scene);
  std::vector<BlockColors> colors;
  colors.reserve(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (const auto& color = scene.styles[i].color) {
      colors.push_back(colors_from(color_of(*color), theme, palette));
      if (has_bars) colors.back().bars = kBars.at(i % kBars.size());
    } else if (!all[i].mass) {
      colors.push_back(fixed);
    } else {
      colors.push_back(turns[places[i]]);
    }
  }
  if (blocks != nullptr) name(colors[blocks->blue_id], colors[blocks->red_id], *blocks);
  return colors;
}

std::vector<std::string> contrast_notes(const Script& script) {
  constexpr std::size_t kMostNotes = 12;
  const View& view = view_of(script);
  const Color ground = palette_of(view).background;
  std::vector<std::string> notes;
  if (view.background == Background::transparent) return notes;
  const auto check = [&](std::string_view key, const std::optional<RgbColor>& color,
                         const char* what, double least) {
    if (!color || notes.size() == kMostNotes) return;
    const double measured = contrast(color_of(*color), ground);
    if (measured >= least) return;
    std::string note =
        fmt::format("{} = {}: its contrast to the background {} is {:.1f}; {} needs {}", key,
                    exact_text(*color), exact_text(RgbColor{ground.red, ground.green, ground.blue}),
                    std::floor(measured * 10) / 10, what, least);
    if (std::ranges::count(notes, note) == 0) notes.push_back(std::move(note));
  };
  check("view.colors.ink", view.colors.ink, "text", kTextContrast);
  check("view.colors.accent", view.colors.accent, "text", kTextContrast);
  check("view.colors.muted", view.colors.muted, "text", kTextContrast);
  check("view.colors.done", view.colors.done, "text", kTextContrast);
  check("view.colors.grid", view.colors.grid, "a line", kLineContrast);
  for (const Scene* scene : scenes_of(script)) {
    for (std::size_t i = 0; i < scene->styles.size(); ++i) {
      const std::string body = has_short_names(scene->system) ? scene->system.bodies[i].name
                                                              : fmt::format("body {}", i + 1);
      check(body + ".color", scene->styles[i].color, "a body", kFillContrast);
    }
  }
  return notes;
}

std::optional<Color> background_of(const View& view) {
  if (view.background == Background::transparent) return std::nullopt;
  return palette_of(view).background;
}

}  // namespace piblocks
