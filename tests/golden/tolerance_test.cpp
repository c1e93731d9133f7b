// What a tolerance and masks leave of a difference: properties that hold for all pictures.
#include <gtest/gtest.h>
#include <piblocks/compare.hpp>
#include <piblocks/error.hpp>

#include <algorithm>

#include "golden/mask_picture.hpp"
#include "golden/small_images.hpp"
#include "support/traced_random.hpp"

namespace piblocks {
namespace {

struct Pair {
  Image a;
  Image b;
};

Pair random_pair(Random& random) {
  const Image a = random_image(random, random_side(random), random_side(random));
  return {a, changed(random, a, random.integer(0, 12))};
}

/// Exact or perceptual, without a bound that refuses.
Tolerance random_tolerance(Random& random) {
  Tolerance tolerance{.max_delta = Rational(long(random.integer(0, 100)))};
  if (random.integer(0, 1) == 0) tolerance.threshold = random.uniform(0, 0.4);
  tolerance.counts_antialiasing = random.integer(0, 1) == 0;
  tolerance.ignores_transparent = random.integer(0, 1) == 0;
  return tolerance;
}

/// Parts of a picture, some beyond its borders.
std::vector<PixelRect> random_masks(Random& random, const Image& image) {
  std::vector<PixelRect> masks;
  for (std::int64_t i = random.integer(0, 3); i > 0; --i) {
    masks.push_back({int(random.integer(-2, image.width_px)),
                     int(random.integer(-2, image.height_px)), int(random.integer(1, 6)),
                     int(random.integer(1, 6))});
  }
  return masks;
}

bool is_masked(const std::vector<PixelRect>& masks, int x, int y) {
  return std::ranges::any_of(masks, [&](const PixelRect& r) {
    return x >= r.x_px && x < r.right_px() && y >= r.y_px && y < r.bottom_px();
  });
}

bool cover_all(const std::vector<PixelRect>& masks, const Image& image) {
  for (int i = 0; i < image.width_px * image.height_px; ++i) {
    if (!is_masked(masks, i % image.width_px, i / image.width_px)) return false;
  }
  return true;
}

TEST(Share, IsABoundOnThePixelsThatAreOff) {
  for (const auto& [width, height] : {std::pair(10, 10), {7, 3}, {1, 1}, {3, 1}}) {
    const int pixels = width * height;
    const Image a = flat(width, height, 0xff000000);
    Image b = a;
    for (int off = 0; off < pixels; ++off) {
      if (off > 0) b.words[std::size_t(off - 1)] = 0xff00ff00;
      const Rational share = Rational(off, pixels);
      const auto accepts = [&](const Rational& most) {
        return compared(a, b, {.max_pixels = pixels, .max_share = most}).is_accepted;
      };
      EXPECT_TRUE(accepts(share)) << off << " of " << pixels;
      EXPECT_TRUE(accepts(share + Rational(1, 1000000)));
      if (off > 0) {
        EXPECT_FALSE(accepts(share - Rational(1, 1000000))) << off << " of " << pixels;
        EXPECT_FALSE(accepts(Rational(off - 1, pixels))) << off << " of " << pixels;
        EXPECT_FALSE(compared(a, b, {.max_pixels = off - 1, .max_share = share}).is_accepted);
      }
    }
  }
}

TEST(Share, CountsWhatIsOffAndNotWhatDiffers) {
  const Image a = flat(10, 10, 0xff000000);
  Image b = flat(10, 10, 0xff000003);
  at(b, 5, 5) = 0xff0000ff;
  const Rational hundredth(1, 100);
  EXPECT_FALSE(compared(a, b, {.max_pixels = 100, .max_share = hundredth}).is_accepted);
  EXPECT_TRUE(
      compared(a, b, {.max_delta = 3, .max_pixels = 100, .max_share = hundredth}).is_accepted);
  EXPECT_THROW(compared(a, b, {.max_share = Rational(-1, 100)}), UsageError);
  EXPECT_THROW(compared(a, b, {.max_share = Rational(101, 100)}), UsageError);
}

TEST(Transparent, PixelsOfAnyColourAreEqual) {
  TracedRandom random(71);
  for (std::int64_t i = many(300); i > 0; --i) {
    const Pair pair = random_pair(random);
    Tolerance tolerance = random_tolerance(random);
    tolerance.threshold.reset();  // what smooths edges has a colour of its own
    tolerance.ignores_transparent = true;
    Image repainted = pair.b;
    for (std::size_t word = 0; word < repainted.words.size(); ++word) {
      const bool is_clear = (pair.a.words[word] | pair.b.words[word]) >> 24 == 0;
      if (is_clear) repainted.words[word] = pair.a.words[word];
    }
    const Difference found = compared(pair.a, pair.b, tolerance);
    tolerance.ignores_transparent = false;
    expect_same(found, compared(pair.a, repainted, tolerance));
    EXPECT_EQ(pixel_deltas(pair.a, pair.b, {}, true), pixel_deltas(pair.a, repainted));
  }
}

TEST(Transparent, OnOneSideOnlyIsADifference) {
  const Image clear = flat(2, 2, 0x00112233);
  const Tolerance tolerance{.ignores_transparent = true};
  EXPECT_TRUE(compared(clear, flat(2, 2, 0x00ffffff), tolerance).is_equal());
  EXPECT_FALSE(compared(clear, flat(2, 2, 0x00ffffff)).is_equal());
  EXPECT_FALSE(compared(clear, flat(2, 2, 0x01112233), tolerance).is_equal());
  EXPECT_FALSE(compared(flat(2, 2, 0xff112233), clear, tolerance).is_equal());
  const DeepImage deep{1, 1, 65535, {0x0000111122223333}};
  const DeepImage other{1, 1, 65535, {0x0000ffff22223333}};
  const DeepImage opaque{1, 1, 65535, {0x0001ffff22223333}};
  EXPECT_TRUE(compare(deep, other, tolerance).is_equal());
  EXPECT_FALSE(compare(deep, opaque, tolerance).is_equal());
  EXPECT_EQ(pixel_deltas(deep, other, {}, true), (std::vector<std::uint8_t>{0}));
  EXPECT_EQ(pixel_deltas(deep, other), (std::vector<std::uint8_t>{238}));
}

TEST(Masks, RemoveTheDifferencesInThemAndNoOthers) {
  TracedRandom random(72);
  int masked = 0;
  for (std::int64_t i = many(1000); i > 0; --i) {
    const Pair pair = random_pair(random);
    const Tolerance tolerance = random_tolerance(random);
    const std::vector<PixelRect> masks = random_masks(random, pair.a);
    if (cover_all(masks, pair.a)) {
      EXPECT_THROW(compared(pair.a, pair.b, tolerance, masks), UsageError);
      continue;
    }
    const Difference whole = compared(pair.a, pair.b, tolerance);
    const Difference found = compared(pair.a, pair.b, tolerance, masks);
    EXPECT_EQ(found.different_pixels + found.masked_pixels, whole.different_pixels);
    EXPECT_LE(found.off_pixels, whole.off_pixels);
    EXPECT_LE(found.largest_delta, whole.largest_delta);
    EXPECT_LE(found.densest_off, whole.densest_off);
    EXPECT_TRUE(found.is_accepted || !whole.is_accepted);
    if (!found.is_equal()) {
      EXPECT_FALSE(is_masked(masks, found.first.x_px, found.first.y_px));
    }
    masked += found.masked_pixels > 0 ? 1 : 0;
  }
  EXPECT_GT(masked, 100);
}

/// Smoothed edges are recognised by what is behind a mask, too.
TEST(Masks, OfBothHalvesLeaveTogetherWhatThereIsWithoutAny) {
  TracedRandom random(73);
  for (std::int64_t i = many(500); i > 0; --i) {
    const Pair pair = random_pair(random);
    const int width = pair.a.width_px;
    if (width < 2) continue;
    const int left = int(random.integer(1, width - 1));
    const Tolerance tolerance = random_tolerance(random);
    const auto off = [&](const std::vector<PixelRect>& masks) {
      return compared(pair.a, pair.b, tolerance, masks).off_pixels;
    };
    EXPECT_EQ(off({{0, 0, left, 99}}) + off({{left, 0, width, 99}}), off({}));
  }
}

TEST(Masks, AsPicturesHideWhatIsNeitherBlackNorTransparent) {
  TracedRandom random(74);
  for (std::int64_t i = many(300); i > 0; --i) {
    const Image mask =
        random_image(random, random_side(random), random_side(random),
                     {0xff000000, 0x00ffffff, 0x80000000, 0, 0xffffffff, 0xff000001, 0x01ff0000});
    const std::vector<PixelRect> rects = rects_of_mask(mask);
    std::int64_t area = 0;
    for (const PixelRect& r : rects) area += std::int64_t{r.width_px} * r.height_px;
    std::int64_t hidden = 0;
    for (int y = 0; y < mask.height_px; ++y) {
      for (int x = 0; x < mask.width_px; ++x) {
        const std::uint32_t word = at(mask, x, y);
        const bool is_hidden = word == 0xffffffff || word == 0xff000001 || word == 0x01ff0000;
        EXPECT_EQ(is_masked(rects, x, y), is_hidden) << x << ' ' << y;
        hidden += is_hidden ? 1 : 0;
      }
    }
    EXPECT_EQ(area, hidden) << "no pixel is in two of them";
  }
  EXPECT_EQ(rects_of_mask(flat(30, 20, 0xffffffff)).size(), 1U);
}

TEST(Deltas, AgreeWithTheDifference) {
  TracedRandom random(75);
  for (std::int64_t i = many(500); i > 0; --i) {
    const Pair pair = random_pair(random);
    const Tolerance tolerance = random_tolerance(random);
    const std::vector<PixelRect> masks = random_masks(random, pair.a);
    if (cover_all(masks, pair.a)) continue;
    const Difference found = compared(pair.a, pair.b, tolerance, masks);
    const auto deltas = pixel_deltas(pair.a, pair.b, masks, tolerance.ignores_transparent);
    const auto is_different = [](int delta) { return delta != 0; };
    EXPECT_EQ(std::ranges::count_if(deltas, is_different), found.different_pixels);
    EXPECT_EQ(*std::ranges::max_element(deltas), found.largest_delta);
    const auto first = std::ranges::find_if(deltas, is_different) - deltas.begin();
    if (!found.is_equal()) {
      EXPECT_EQ(first, std::int64_t{found.first.y_px} * pair.a.width_px + found.first.x_px);
    }
    if (tolerance.threshold) continue;
    const std::int64_t most = tolerance.max_delta.get_num().get_si();
    const auto off = std::ranges::count_if(deltas, [&](int delta) { return delta > most; });
    EXPECT_EQ(off, found.off_pixels);
  }
}

TEST(Symmetry, VerdictsAreTheSameBothWays) {
  TracedRandom random(76);
  for (std::int64_t i = many(500); i > 0; --i) {
    const Pair pair = random_pair(random);
    const Tolerance tolerance = random_tolerance(random);
    const std::vector<PixelRect> masks = random_masks(random, pair.a);
    if (cover_all(masks, pair.a)) continue;
    expect_same(compared(pair.a, pair.b, tolerance, masks),
                compared(pair.b, pair.a, tolerance, masks));
  }
}

}  // namespace
}  // namespace piblocks
