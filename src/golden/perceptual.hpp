// How different two pixels look, and whether the smoothing of an edge explains it.
// In: two pictures of one size. Out: a verdict on any of their pixels. This is what --threshold of
// odiff and of pixelmatch up to release 7 means; later ones measure in another colour space.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace piblocks {

/// A sample of a word of four, alpha in the highest bits. @param place  0 is the lowest
template <typename Word>
Word sample_of(Word word, std::size_t place) {
  constexpr std::size_t kBits = sizeof(Word) * 2;
  return (word >> (place * kBits)) & ((Word{1} << kBits) - 1);
}

/// Brightness and the two differences of colours of the NTSC standard.
struct Yiq {
  double y;
  double i;
  double q;
};

/// @param levels  red, green, blue and alpha, 0 to 255; transparent pixels are seen on white.
inline Yiq yiq_of(const std::array<double, 4>& levels) {
  const auto on_white = [&](std::size_t i) { return 255 + (levels[i] - 255) * levels[3] / 255; };
  const double r = on_white(0);
  const double g = on_white(1);
  const double b = on_white(2);
  return {r * 0.29889531 + g * 0.58662247 + b * 0.11448223,
          r * 0.59597799 - g * 0.27417610 - b * 0.32180189,
          r * 0.21147017 - g * 0.52261711 + b * 0.31114694};
}

/// Kotsarenko and Ramos, "Measuring perceived color difference using YIQ NTSC transmission color
/// space in mobile applications" (2010): the weighted square of the distance, at most 35215.
inline double perceived_difference(const Yiq& a, const Yiq& b) {
  const double y = a.y - b.y;
  const double i = a.i - b.i;
  const double q = a.q - b.q;
  return 0.5053 * y * y + 0.299 * i * i + 0.1957 * q * q;
}

/// @tparam Rows  row(y) is a row of words: alpha in the highest bits, then red, green and blue
template <typename Rows>
class Perceptual {
 public:
  Perceptual(const Rows& reference, const Rows& actual, double threshold, bool ignores_antialiasing)
      : reference_(reference),
        actual_(actual),
        most_(35215 * threshold * threshold),
        ignores_antialiasing_(ignores_antialiasing) {}

  /// Whether a pixel looks different, and is an ignored smoothed edge in neither picture.
  bool is_off(int x, int y) const {
    const Yiq a = yiq_of(levels_at(reference_, x, y));
    const Yiq b = yiq_of(levels_at(actual_, x, y));
    if (perceived_difference(a, b) <= most_) return false;
    return !ignores_antialiasing_ ||
           (!is_smoothed(reference_, actual_, x, y) && !is_smoothed(actual_, reference_, x, y));
  }

 private:
  struct Place {
    int x;
    int y;
  };

  static std::array<double, 4> levels_at(const Rows& rows, int x, int y) {
    const auto word = rows.row(y)[x];
    const auto level = [&](std::size_t place) {
      return 255 * static_cast<double>(sample_of(word, place)) / rows.max_level;
    };
    return {level(2), level(1), level(0), level(3)};
  }
  /// Calls visit(place) for the places around one, as far as they are in the picture. Column by
  /// column, as pixelmatch does: of equally dark or bright neighbours the first one counts.
  template <typename Visit>
  static void visit_around(const Rows& rows, Place centre, const Visit& visit) {
    for (int x = std::max(centre.x - 1, 0); x <= std::min(centre.x + 1, rows.width_px - 1); ++x) {
      for (int y = std::max(centre.y - 1, 0); y <= std::min(centre.y + 1, rows.height_px - 1);
           ++y) {
        if (x != centre.x || y != centre.y) visit(Place{x, y});
      }
    }
  }
  /// An edge of the picture counts as one equal neighbour.
  static int edge_of(const Rows& rows, Place at) {
    const bool is_inside =
        at.x > 0 && at.y > 0 && at.x < rows.width_px - 1 && at.y < rows.height_px - 1;
    return is_inside ? 0 : 1;
  }
  /// Whether the pixel lies in an area: three neighbours or more are equal to it.
  static bool is_in_area(const Rows& rows, Place at) {
    int equal = edge_of(rows, at);
    const auto word = rows.row(at.y)[at.x];
    visit_around(rows, at, [&](Place near) { equal += rows.row(near.y)[near.x] == word ? 1 : 0; });
    return equal > 2;
  }
  /// V. Vyšniauskas, "Anti-aliased pixel and intensity slope detector" (2009): at most two
  /// neighbours are equally bright, some are darker and some brighter, and the darkest or the
  /// brightest of them lies in an area of both pictures.
  static bool is_smoothed(const Rows& rows, const Rows& other, int x, int y) {
    const double brightness = yiq_of(levels_at(rows, x, y)).y;
    int equal = edge_of(rows, {x, y});
    double darkest = 0;
    double brightest = 0;
    Place dark{};
    Place bright{};
    visit_around(rows, {x, y}, [&](Place near) {
      const double change = yiq_of(levels_at(rows, near.x, near.y)).y - brightness;
      equal += change == 0 ? 1 : 0;
      if (change < darkest) {
        darkest = change;
        dark = near;
      }
      if (change > brightest) {
        brightest = change;
        bright = near;
      }
    });
    if (equal > 2 || darkest == 0 || brightest == 0) return false;
    return (is_in_area(rows, dark) && is_in_area(other, dark)) ||
           (is_in_area(rows, bright) && is_in_area(other, bright));
  }

  const Rows& reference_;
  const Rows& actual_;
  double most_;
  bool ignores_antialiasing_;
};

}  // namespace piblocks
