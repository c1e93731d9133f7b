#include "draw/bodies/body_look.hpp"

#include <array>
#include <cmath>

namespace piblocks {
namespace {

/// More bodies than this have one colour, unless the scene says otherwise.
constexpr std::size_t kMostColored = 12;

/// Relative luminance (WCAG 2.1), with a power of 2 in place of the sRGB curve.
double luminance(const Color& color) {
  const auto linear = [](int level) { return double(level * level) / (255.0 * 255.0); };
  return 0.2126 * linear(color.red) + 0.7152 * linear(color.green) + 0.0722 * linear(color.blue);
}

Color darker(const Color& color) {
  const auto part = [](int level) { return static_cast<std::uint8_t>(level * 5 / 8); };
  return {part(color.red), part(color.green), part(color.blue)};
}

Color lighter(const Color& color) {
  const auto part = [](int level) { return static_cast<std::uint8_t>(level + (255 - level) / 2); };
  return {part(color.red), part(color.green), part(color.blue)};
}

/// Beside blue and red: green, orange, purple, and a blue green (Okabe and Ito, "Color Universal
/// Design", 2008, with a darker and a lighter form for light and dark backgrounds).
constexpr std::array<Color, 4> kOnLight = {
    {{0, 138, 100}, {204, 121, 0}, {150, 84, 160}, {0, 120, 140}}};
constexpr std::array<Color, 4> kOnDark = {
    {{86, 204, 150}, {245, 178, 70}, {206, 150, 220}, {92, 200, 214}}};
constexpr std::array<Color, 4> kGreys = {
    {{210, 210, 210}, {84, 84, 84}, {150, 150, 150}, {232, 232, 232}}};

Color fill_of(const DrawingContext& context, std::size_t body) {
  const Palette& palette = context.palette;
  const Bodies& bodies = context.bodies;
  if (const auto& color = bodies.styles[body].color) {
    const auto& [red, green, blue] = *color;
    return {red, green, blue};
  }
  if (!bodies.system.bodies[body].mass) return palette.muted;
  const std::size_t count = bodies.system.bodies.size();
  const std::size_t turn = count > kMostColored ? 0 : body % (2 + kOnLight.size());
  if (turn == 0) return palette.blue.fill;
  if (turn == 1) return palette.red.fill;
  if (context.scene.view.theme == Theme::print) return kGreys.at(turn - 2);
  const bool is_dark = luminance(palette.background) < 0.2;
  return (is_dark ? kOnDark : kOnLight).at(turn - 2);
}

}  // namespace

BodyColors body_colors(const DrawingContext& context, std::size_t body) {
  const Palette& palette = context.palette;
  const Color fill = fill_of(context, body);
  const bool is_dark = luminance(palette.background) < 0.2;
  const bool is_fill_dark = luminance(fill) < 0.25;
  const Color edge = context.scene.view.theme == Theme::print ? palette.wall
                     : is_dark                                ? lighter(fill)
                                                              : darker(fill);
  return {fill, edge, is_fill_dark ? Color{255, 255, 255} : Color{12, 14, 18}};
}

}  // namespace piblocks
