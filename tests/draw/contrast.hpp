// How well a colour is seen on another.
// In: two colours. Out: their contrast as WCAG 2.1 defines it.
#pragma once

#include <piblocks/scene.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "draw/item_parts.hpp"

namespace piblocks {

inline constexpr std::array kThemes{Theme::article,    Theme::lecture, Theme::lecture_light,
                                    Theme::chalkboard, Theme::dark,    Theme::print,
                                    Theme::colorblind};

/// WCAG 2.1, "relative luminance".
inline double luminance(const Color& color) {
  const auto linear = [](std::uint8_t sample) {
    const double value = sample / 255.0;
    return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * linear(color.red) + 0.7152 * linear(color.green) + 0.0722 * linear(color.blue);
}

/// WCAG 2.1, "contrast ratio".
inline double contrast(const Color& a, const Color& b) {
  const double x = luminance(a) + 0.05;
  const double y = luminance(b) + 0.05;
  return std::max(x, y) / std::min(x, y);
}

}  // namespace piblocks
