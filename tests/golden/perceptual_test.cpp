// What looks alike (Tolerance::threshold), against sums and rules that are written anew here.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <piblocks/compare.hpp>
#include <piblocks/error.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "golden/small_images.hpp"
#include "support/traced_random.hpp"

namespace piblocks {
namespace {

constexpr std::uint32_t kBlack = 0xff000000;
constexpr std::uint32_t kGrey = 0xff808080;
constexpr std::uint32_t kWhite = 0xffffffff;
constexpr double kLargest = 35215;

using Colour = std::array<double, 3>;

/// Red, green and blue of a pixel on white.
Colour on_white(std::uint32_t word) {
  const double alpha = (word >> 24) / 255.0;
  Colour colour;
  for (std::size_t i = 0; i < 3; ++i) {
    const double level = (word >> (16 - 8 * i)) & 0xff;
    colour.at(i) = alpha * level + (1 - alpha) * 255;
  }
  return colour;
}

double weighted(const Colour& colour, const Colour& weights) {
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) sum += colour.at(i) * weights.at(i);
  return sum;
}

// Of NTSC, as pixelmatch 7 and odiff have them.
constexpr Colour kY = {0.29889531, 0.58662247, 0.11448223};
constexpr Colour kI = {0.59597799, -0.27417610, -0.32180189};
constexpr Colour kQ = {0.21147017, -0.52261711, 0.31114694};

/// Kotsarenko and Ramos (2010).
double delta_of(std::uint32_t one, std::uint32_t other) {
  const Colour a = on_white(one);
  const Colour b = on_white(other);
  const Colour change = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
  return 0.5053 * std::pow(weighted(change, kY), 2) + 0.299 * std::pow(weighted(change, kI), 2) +
         0.1957 * std::pow(weighted(change, kQ), 2);
}

Tolerance looks_alike(double threshold, bool counts_antialiasing = true) {
  return {.threshold = threshold, .counts_antialiasing = counts_antialiasing};
}

std::int64_t off(const Image& a, const Image& b, const Tolerance& tolerance) {
  return compared(a, b, tolerance).off_pixels;
}

TEST(Perceptual, AcceptsFromTheThresholdThatTheFormulasGive) {
  TracedRandom random(61);
  for (std::int64_t i = many(3000); i > 0; --i) {
    const Image a = random_image(random, 1, 1);
    const Image b = random_image(random, 1, 1);
    const double threshold = std::sqrt(delta_of(a.words[0], b.words[0]) / kLargest);
    SCOPED_TRACE(fmt::format("{:08x} {:08x}", a.words[0], b.words[0]));
    ASSERT_LT(threshold, 1);
    EXPECT_EQ(off(a, b, looks_alike(threshold * (1 + 1e-9) + 1e-12)), 0);
    if (threshold > 1e-6) {
      EXPECT_EQ(off(a, b, looks_alike(threshold * (1 - 1e-9))), 1);
    }
  }
}

/// Samples of more bits are measured by the same formulas, in fractions of levels.
TEST(Perceptual, MeasuresDeepSamplesAsFinely) {
  const auto deep = [](int max_level, int level) {
    const auto samples = std::uint64_t(level) * 0x0000000100010001;
    return DeepImage{1, 1, max_level, {std::uint64_t(max_level) << 48 | samples}};
  };
  for (const int max_level : {1023, 4095, 65535}) {
    for (const int step : {1, 7, max_level / 3, max_level}) {
      const double threshold = std::sqrt(0.5053 / kLargest) * 255 * step / max_level;
      const auto is_off = [&](double t) {
        return compare(deep(max_level, 0), deep(max_level, step), looks_alike(t)).off_pixels;
      };
      EXPECT_EQ(is_off(threshold * 1.00001), 0) << max_level << ' ' << step;
      EXPECT_EQ(is_off(threshold * 0.99999), 1) << max_level << ' ' << step;
    }
  }
}

TEST(Perceptual, AThresholdOf1AcceptsEverything) {
  TracedRandom random(62);
  for (std::int64_t i = many(300); i > 0; --i) {
    const int width = random_side(random);
    const int height = random_side(random);
    const Difference found = compared(random_image(random, width, height),
                                      random_image(random, width, height), looks_alike(1));
    EXPECT_EQ(found.off_pixels, 0);
    EXPECT_TRUE(found.is_accepted);
  }
  for (const std::uint32_t one : {0U, 0x0000ffU, 0x00ff00U, 0xff0000U, 0xffff00U, 0x00ffffU}) {
    const Image a = flat(1, 1, kBlack | one);
    EXPECT_EQ(off(a, flat(1, 1, kBlack | (0xffffff - one)), looks_alike(1)), 0) << one;
  }
}

TEST(Perceptual, AThresholdOf0AcceptsOnlyWhatCannotBeSeenOnWhite) {
  TracedRandom random(63);
  for (std::int64_t i = many(3000); i > 0; --i) {
    const Image a = random_image(random, 1, 1);
    const Image b = random_image(random, 1, 1);
    const bool is_visible = on_white(a.words[0]) != on_white(b.words[0]);
    EXPECT_EQ(off(a, b, looks_alike(0)), is_visible ? 1 : 0) << a.words[0] << ' ' << b.words[0];
  }
  for (const std::uint32_t white : {0x00000000U, 0x00ff8040U, 0x00ffffffU, 0x80ffffffU}) {
    EXPECT_EQ(off(flat(1, 1, kWhite), flat(1, 1, white), looks_alike(0)), 0);
    EXPECT_EQ(off(flat(1, 1, kWhite), flat(1, 1, white ^ 0x01000001), looks_alike(0)), 1) << white;
  }
}

/// The smallest threshold is no tolerance for what can be seen.
TEST(Perceptual, SeesEveryStepOfEveryChannel) {
  for (const std::uint32_t step : {0x000001U, 0x000100U, 0x010000U}) {
    EXPECT_EQ(off(flat(1, 1, kGrey), flat(1, 1, kGrey + step), looks_alike(0)), 1);
    EXPECT_EQ(off(flat(1, 1, kGrey), flat(1, 1, kGrey + step), looks_alike(0.01)), 0);
  }
}

TEST(Perceptual, IgnoresMaxDelta) {
  const Image a = flat(1, 1, kBlack);
  const Image b = flat(1, 1, kWhite);
  Tolerance tolerance = looks_alike(0.1);
  tolerance.max_delta = 255;
  EXPECT_EQ(off(a, b, tolerance), 1);
  tolerance = looks_alike(1);
  tolerance.hard_delta = 254;
  EXPECT_FALSE(compared(a, b, tolerance).is_accepted) << "the hard limit holds, whatever is seen";
}

TEST(Perceptual, RefusesThresholdsOutOfRange) {
  const Image a = flat(1, 1, kBlack);
  for (const double threshold : {-0.001, 1.001, std::nan("")}) {
    EXPECT_THROW(compared(a, a, looks_alike(threshold)), UsageError) << threshold;
  }
}

/// Vyšniauskas (2009) in the way of pixelmatch: all that is near a pixel is listed first.
class SmoothingOracle {
 public:
  SmoothingOracle(const Image& one, const Image& other) : one_(one), other_(other) {}

  bool is_smoothed(int x, int y) const {
    const double centre = weighted(on_white(at(one_, x, y)), kY);
    std::vector<std::pair<double, Place>> near;
    for (const Place& place : around(x, y)) {
      near.emplace_back(weighted(on_white(at(one_, place.x, place.y)), kY) - centre, place);
    }
    const auto equal = std::ranges::count_if(near, [](const auto& n) { return is_zero(n.first); });
    if (equal + (is_at_edge(x, y) ? 1 : 0) > 2) return false;
    const auto by_change = [](const auto& a, const auto& b) { return a.first < b.first - kTiny; };
    const auto darkest = std::min_element(near.begin(), near.end(), by_change);
    const auto brightest = std::max_element(near.begin(), near.end(), by_change);
    if (near.empty() || darkest->first > -kTiny || brightest->first < kTiny) return false;
    return is_in_areas(darkest->second) || is_in_areas(brightest->second);
  }

 private:
  struct Place {
    int x;
    int y;
  };
  static constexpr double kTiny = 1e-9;

  static bool is_zero(double change) { return std::abs(change) < kTiny; }
  bool is_at_edge(int x, int y) const {
    return x == 0 || y == 0 || x == one_.width_px - 1 || y == one_.height_px - 1;
  }
  std::vector<Place> around(int x, int y) const {
    std::vector<Place> places;
    for (int i = 0; i < 9; ++i) {  // column by column
      const Place place{x - 1 + i / 3, y - 1 + i % 3};
      const bool is_inside =
          place.x >= 0 && place.y >= 0 && place.x < one_.width_px && place.y < one_.height_px;
      if (i != 4 && is_inside) places.push_back(place);
    }
    return places;
  }
  bool is_in_areas(const Place& at) const { return is_in_area(one_, at) && is_in_area(other_, at); }
  bool is_in_area(const Image& image, const Place& place) const {
    int equal = is_at_edge(place.x, place.y) ? 1 : 0;
    for (const Place& near : around(place.x, place.y)) {
      equal += at(image, near.x, near.y) == at(image, place.x, place.y) ? 1 : 0;
    }
    return equal >= 3;
  }

  const Image& one_;
  const Image& other_;
};

TEST(Perceptual, AcceptsTheSmoothedEdgesThatTheRulesName) {
  TracedRandom random(64);
  std::int64_t smoothed = 0;
  std::int64_t counted = 0;
  const std::vector<std::uint32_t> words = {kBlack, kBlack, kBlack, kWhite,     kWhite,
                                            kWhite, kGrey,  kGrey,  0x80000000, 0xff40c020};
  for (std::int64_t i = many(2000); i > 0; --i) {
    const int width = random_side(random);
    const int height = random_side(random);
    const Image a = random_image(random, width, height, words);
    Image b = a;
    for (int changes = 0; changes < 6; ++changes) {
      const auto x = int(random.integer(0, width - 1));
      const auto y = int(random.integer(0, height - 1));
      at(b, x, y) = words.at(std::size_t(random.integer(0, 9)));
    }
    const SmoothingOracle in_a(a, b);
    const SmoothingOracle in_b(b, a);
    std::int64_t expected = 0;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        if (delta_of(at(a, x, y), at(b, x, y)) <= kLargest * 0.01) continue;
        const bool is_smoothed = in_a.is_smoothed(x, y) || in_b.is_smoothed(x, y);
        ++(is_smoothed ? smoothed : expected);
      }
    }
    counted += expected;
    ASSERT_EQ(off(a, b, looks_alike(0.1, false)), expected) << width << 'x' << height;
  }
  EXPECT_GT(smoothed, 100);
  EXPECT_GT(counted, 100);
}

/// Black on the left and white on the right, from column 4 of 9 on.
Image hard_edge() {
  Image image = flat(9, 9, kBlack);
  for (int y = 0; y < 9; ++y) {
    for (int x = 5; x < 9; ++x) at(image, x, y) = kWhite;
  }
  return image;
}

/// Pixels of the hard edge that are off if these places are grey.
std::int64_t off_with_greys(const std::vector<std::pair<int, int>>& places) {
  Image greys = hard_edge();
  for (const auto& [x, y] : places) at(greys, x, y) = kGrey;
  const auto count = std::int64_t(places.size());
  EXPECT_EQ(off(hard_edge(), greys, looks_alike(0.1)), count);
  const std::int64_t found = off(hard_edge(), greys, looks_alike(0.1, false));
  EXPECT_EQ(off(greys, hard_edge(), looks_alike(0.1, false)), found);
  return found;
}

TEST(Perceptual, GreyBetweenBlackAndWhiteIsASmoothedEdge) {
  EXPECT_EQ(off_with_greys({{4, 4}}), 0);
  EXPECT_EQ(off_with_greys({{4, 3}, {4, 4}, {4, 5}}), 0) << "two equal neighbours";
  EXPECT_EQ(off_with_greys({{4, 0}}), 0) << "the border of the picture is one equal neighbour";
}

TEST(Perceptual, GreyElsewhereIsNoSmoothedEdge) {
  EXPECT_EQ(off_with_greys({{1, 4}}), 1) << "none of the neighbours is brighter";
  EXPECT_EQ(off_with_greys({{7, 4}}), 1) << "none of the neighbours is darker";
  EXPECT_EQ(off_with_greys({{3, 4}, {4, 4}, {3, 5}, {4, 5}}), 4) << "three equal neighbours";
  Image spotted = flat(9, 9, kGrey);  // no area is black or white
  at(spotted, 3, 3) = kBlack;
  at(spotted, 5, 5) = kWhite;
  Image moved = spotted;
  at(moved, 4, 4) = 0xff404040;
  EXPECT_EQ(off(spotted, moved, looks_alike(0.1, false)), 1);
}

/// Both neighbours are black. That of the first column lies in an area, that of the first row not.
TEST(Perceptual, OfEquallyDarkNeighboursTheFirstOfTheColumnsCounts) {
  const auto picture = [](bool is_turned) {
    Image image = flat(9, 9, 0xffd0d0d0);
    for (int i = 0; i < 9 * 9; ++i) {  // no areas but the one that is made below
      const int x = i % 9;
      const int y = i / 9;
      at(image, x, y) = 0xff000000 | std::uint32_t(0x900000 + (x << 12) + (y << 4));
    }
    for (const auto& [x, y] : {std::pair(3, 5), {2, 5}, {2, 6}, {3, 6}, {4, 3}}) {
      at(image, is_turned ? y : x, is_turned ? x : y) = kBlack;
    }
    return image;
  };
  const auto is_off = [&](bool is_turned) {
    Image changed = picture(is_turned);
    at(changed, 4, 4) = 0xff202020;
    return off(picture(is_turned), changed, looks_alike(0.1, false));
  };
  EXPECT_EQ(is_off(false), 0);
  EXPECT_EQ(is_off(true), 1);
}

TEST(Perceptual, VerdictsAreTheSameBothWays) {
  TracedRandom random(65);
  for (std::int64_t i = many(500); i > 0; --i) {
    const Image a = random_image(random, random_side(random), random_side(random),
                                 {kBlack, kWhite, kGrey, 0x40000000, random_word(random)});
    const Image b = changed(random, a, random.integer(0, 9));
    const Tolerance tolerance = looks_alike(random.uniform(0, 0.5), random.integer(0, 1) == 0);
    expect_same(compared(a, b, tolerance), compared(b, a, tolerance));
  }
}

TEST(Perceptual, AHigherThresholdAcceptsNoLess) {
  TracedRandom random(66);
  for (std::int64_t i = many(200); i > 0; --i) {
    const Image a = random_image(random, random_side(random), random_side(random));
    const Image b = changed(random, a, 20);
    std::int64_t last = off(a, b, looks_alike(0));
    for (const double threshold : {0.01, 0.05, 0.1, 0.3, 0.6, 1.0}) {
      const std::int64_t now = off(a, b, looks_alike(threshold));
      EXPECT_LE(now, last);
      EXPECT_LE(off(a, b, looks_alike(threshold, false)), now);
      last = now;
    }
    EXPECT_EQ(last, 0);
  }
}

}  // namespace
}  // namespace piblocks
