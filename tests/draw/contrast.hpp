// How well a colour is seen on another, and told from it.
// In: two colours. Out: their contrast as WCAG 2.1 defines it; their difference, as CIE 1976 does.
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

/// Light of red, green and blue, as IEC 61966-2-1 defines it.
using Lights = std::array<double, 3>;
inline Lights lights_of(const Color& color) {
  const auto linear = [](std::uint8_t sample) {
    const double value = sample / 255.0;
    return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
  };
  return {linear(color.red), linear(color.green), linear(color.blue)};
}

inline double sum_of_products(const Lights& a, const Lights& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// WCAG 2.1, "relative luminance".
inline double luminance(const Color& color) {
  return sum_of_products(lights_of(color), {0.2126, 0.7152, 0.0722});
}

/// WCAG 2.1, "contrast ratio".
inline double contrast(const Color& a, const Color& b) {
  const double x = luminance(a) + 0.05;
  const double y = luminance(b) + 0.05;
  return std::max(x, y) / std::min(x, y);
}

/// What eyes without one kind of cones see, as a matrix of lights: G. Machado, M. Oliveira,
/// L. Fernandes, "A Physiologically-based Model for Simulation of Color Vision Deficiency" (2009),
/// severity 1.
using Vision = std::array<Lights, 3>;
inline constexpr Vision kUsualVision{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
inline constexpr Vision kProtanopia{{{0.152286, 1.052583, -0.204868},
                                     {0.114503, 0.786281, 0.099216},
                                     {-0.003882, -0.048116, 1.051998}}};
inline constexpr Vision kDeuteranopia{{{0.367322, 0.860646, -0.227968},
                                       {0.280085, 0.672501, 0.047413},
                                       {-0.011820, 0.042940, 0.968881}}};
inline constexpr Vision kTritanopia{{{1.255528, -0.076749, -0.178779},
                                     {-0.078411, 0.930809, 0.147602},
                                     {0.004733, 0.691367, 0.303900}}};

/// CIELAB with the white of sRGB.
inline std::array<double, 3> lab_of(const Color& color, const Vision& vision) {
  const Lights all = lights_of(color);
  Lights seen{};
  for (std::size_t i = 0; i < 3; ++i) {
    seen.at(i) = std::clamp(sum_of_products(vision.at(i), all), 0.0, 1.0);
  }
  const auto curve = [&](const Lights& row, double white) {
    const double part = sum_of_products(row, seen) / white;
    return part > 216.0 / 24389 ? std::cbrt(part) : (24389.0 / 27 * part + 16) / 116;
  };
  const double x = curve({0.4124564, 0.3575761, 0.1804375}, 0.95047);
  const double y = curve({0.2126729, 0.7151522, 0.0721750}, 1);
  const double z = curve({0.0193339, 0.1191920, 0.9503041}, 1.08883);
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

/// CIE 1976. 2.3 is the least that is noticed where colours lie side by side.
inline double difference(const Color& a, const Color& b, const Vision& vision = kUsualVision) {
  const auto p = lab_of(a, vision);
  const auto q = lab_of(b, vision);
  return std::sqrt(std::pow(p[0] - q[0], 2) + std::pow(p[1] - q[1], 2) + std::pow(p[2] - q[2], 2));
}

}  // namespace piblocks
