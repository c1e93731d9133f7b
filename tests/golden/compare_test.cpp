// compare() against a comparison that looks at every window by itself.
#include <gtest/gtest.h>
#include <piblocks/compare.hpp>
#include <piblocks/error.hpp>
#include <piblocks/instant.hpp>

#include <cstdlib>

#include "draw/composed_pictures.hpp"
#include "golden/small_images.hpp"
#include "support/traced_random.hpp"

namespace piblocks {
namespace {

TEST(Compare, EqualImagesAreEqual) {
  const Image image = flat(7, 5, 0xff123456);
  const Difference difference = compared(image, image);
  EXPECT_TRUE(difference.is_equal());
  EXPECT_TRUE(difference.is_accepted);
  EXPECT_EQ(difference.densest_off, 0);
}

TEST(Compare, NamesThePlaceOfTheLeastChange) {
  for (int channel = 0; channel < 4; ++channel) {
    const Image reference = flat(40, 30, 0xff808080);
    Image actual = reference;
    constexpr std::array kShifts = {16, 8, 0, 24};
    at(actual, 33, 21) -= 1U << kShifts.at(std::size_t(channel));
    const Difference difference = compared(reference, actual);
    EXPECT_EQ(difference.different_pixels, 1);
    EXPECT_EQ(difference.off_pixels, 1);
    EXPECT_EQ(difference.largest_delta, 1);
    EXPECT_EQ(difference.first, (SamplePlace{33, 21, channel}));
    EXPECT_EQ(difference.densest_off, 1);
    EXPECT_EQ(difference.densest, (PixelRect{18, 6, 16, 16}));
    EXPECT_FALSE(difference.is_accepted);
  }
}

TEST(Compare, EveryBoundHasToHold) {
  const Image reference = flat(50, 50, 0xff646464);
  Image actual = reference;
  for (int x = 0; x < 10; ++x) at(actual, x, 3) += 3;  // blue by 3
  at(actual, 49, 49) += 9 << 16;                       // red by 9
  const auto accepts = [&](const Tolerance& tolerance) {
    return compared(reference, actual, tolerance).is_accepted;
  };
  EXPECT_FALSE(accepts({}));
  EXPECT_FALSE(accepts({.max_delta = 8}));
  EXPECT_TRUE(accepts({.max_delta = 9}));
  EXPECT_FALSE(accepts({.max_delta = 2, .max_pixels = 10}));
  EXPECT_TRUE(accepts({.max_delta = 2, .max_pixels = 11}));
  EXPECT_TRUE(accepts({.max_delta = 3, .max_pixels = 1}));
  EXPECT_FALSE(accepts({.max_delta = 3, .max_pixels = 1, .hard_delta = 8}));
  EXPECT_TRUE(accepts({.max_delta = 3, .max_pixels = 1, .hard_delta = 9}));
  EXPECT_FALSE(accepts({.max_delta = 2, .max_pixels = 99, .window = Window{8, 7}}));
  EXPECT_TRUE(accepts({.max_delta = 2, .max_pixels = 99, .window = Window{8, 8}}));
  EXPECT_FALSE(accepts({.max_delta = 2, .max_pixels = 10, .window = Window{8, 8}}));
}

TEST(Compare, DoesNotLookBehindMasks) {
  const Image reference = flat(20, 20, 0xff000000);
  Image actual = reference;
  at(actual, 4, 4) = 0xffffffff;
  at(actual, 10, 12) = 0xff000001;
  EXPECT_EQ(compared(reference, actual, {}, {{4, 4, 1, 1}}).first, (SamplePlace{10, 12, 2}));
  EXPECT_TRUE(compared(reference, actual, {}, {{0, 0, 5, 5}, {10, 0, 1, 20}}).is_equal());
  EXPECT_THROW(compared(reference, actual, {}, {{0, 0, 16384, 16384}}), UsageError);
  EXPECT_THROW(compared(reference, actual, {}, {{0, 0, 7, 20}, {7, 0, 13, 20}}), UsageError);
  EXPECT_EQ(compared(reference, actual, {}, {{0, 0, 5, 5}}).masked_pixels, 1);
  EXPECT_FALSE(compared(reference, actual, {}, {{5, 4, 5, 16}}).is_equal());
}

TEST(Compare, RefusesWhatMakesNoSense) {
  const Image a = flat(3, 4, 0);
  EXPECT_THROW(compared(a, flat(4, 3, 0)), UsageError);
  EXPECT_THROW(compared(a, a, {.max_delta = 256}), UsageError);
  EXPECT_THROW(compared(a, a, {.max_pixels = -1}), UsageError);
  EXPECT_THROW(compared(a, a, {.hard_delta = -1}), UsageError);
  EXPECT_THROW(compared(a, a, {.window = Window{0, 0}}), UsageError);
}

/// Pixels that are off in a window, one by one.
std::int64_t off_in(const Image& a, const Image& b, const PixelRect& window, int max_delta) {
  std::int64_t count = 0;
  for (int y = window.y_px; y < window.bottom_px(); ++y) {
    for (int x = window.x_px; x < window.right_px(); ++x) {
      const std::size_t i = std::size_t(y) * std::size_t(a.width_px) + std::size_t(x);
      bool is_off = false;
      for (const int shift : {0, 8, 16, 24}) {
        const auto level = [&](const Image& image) {
          return static_cast<int>((image.words[i] >> shift) & 0xff);
        };
        is_off |= std::abs(level(a) - level(b)) > max_delta;
      }
      count += is_off ? 1 : 0;
    }
  }
  return count;
}

TEST(Compare, FindsTheDensestWindow) {
  TracedRandom random(21);
  for (int i = 0; i < 300; ++i) {
    Image a = flat(static_cast<int>(random.integer(1, 24)), static_cast<int>(random.integer(1, 24)),
                   0xff404040);
    Image b = a;
    for (auto changes = random.integer(0, 30); changes > 0; --changes) {
      const auto x = static_cast<int>(random.integer(0, a.width_px - 1));
      const auto y = static_cast<int>(random.integer(0, a.height_px - 1));
      at(b, x, y) += static_cast<std::uint32_t>(random.integer(0, 9)) << 8;
    }
    const int side = static_cast<int>(random.integer(1, 30));
    const int max_delta = static_cast<int>(random.integer(0, 4));
    const Difference found = compared(a, b, {.max_delta = max_delta, .window = Window{side, 0}});
    const int width = std::min(side, a.width_px);
    const int height = std::min(side, a.height_px);
    std::int64_t most = 0;
    for (int y = 0; y + height <= a.height_px; ++y) {
      for (int x = 0; x + width <= a.width_px; ++x) {
        most = std::max(most, off_in(a, b, {x, y, width, height}, max_delta));
      }
    }
    ASSERT_EQ(found.densest_off, most);
    ASSERT_EQ(off_in(a, b, found.densest, max_delta), most);
    ASSERT_EQ(found.off_pixels, off_in(a, b, {0, 0, a.width_px, a.height_px}, max_delta));
  }
}

DeepImage deep(int max_level, const std::vector<std::uint64_t>& words) {
  return {static_cast<int>(words.size()), 1, max_level, words};
}

TEST(Compare, ADeltaOf255IsTheFullRangeAtAnyDepth) {
  for (const int max_level : {1023, 4095, 65535}) {
    const auto full = static_cast<std::uint64_t>(max_level);
    for (const std::uint64_t levels : {std::uint64_t{1}, full / 255, full / 2, full}) {
      const DeepImage a = deep(max_level, {0, 0});
      const DeepImage b = deep(max_level, {0, levels << 32});
      const Difference found = compare(a, b);
      EXPECT_EQ(found.different_pixels, 1);
      EXPECT_EQ(found.largest_delta, static_cast<int>(levels));
      EXPECT_EQ(found.max_level, max_level);
      EXPECT_EQ(found.first, (SamplePlace{1, 0, 0}));
      EXPECT_FALSE(found.is_accepted);
      const Rational delta = Rational(static_cast<long>(levels)) * 255 / max_level;
      EXPECT_TRUE(compare(a, b, {.max_delta = delta}).is_accepted);
      EXPECT_FALSE(compare(a, b, {.max_delta = delta * Rational(999, 1000)}).is_accepted);
      EXPECT_FALSE(
          compare(a, b, {.max_pixels = 9, .hard_delta = delta * Rational(999, 1000)}).is_accepted);
      EXPECT_EQ(pixel_deltas(a, b).at(1), ceil(delta).get_si());
      EXPECT_EQ(pixel_deltas(a, b).at(0), 0);
    }
  }
}

TEST(Compare, AnyDeltaLeavesAMarkOutsideTheMasks) {
  const DeepImage a = deep(65535, {5, 5, 5});
  const DeepImage b = deep(65535, {5, 6, 6});
  EXPECT_EQ(pixel_deltas(a, b), (std::vector<std::uint8_t>{0, 1, 1}));
  const std::vector<PixelRect> masks = {{2, 0, 1, 1}};
  EXPECT_EQ(pixel_deltas(a, b, masks), (std::vector<std::uint8_t>{0, 1, 0}));
}

TEST(Compare, RefusesImagesOfDifferentDepths) {
  EXPECT_THROW(compare(deep(1023, {0}), deep(65535, {0})), UsageError);
}

TEST(Compare, OneDigitOfACounterCannotHideInAFrameOf4K) {
  Scene scene;
  scene.view.theme = Theme::article;
  scene.view.width_px = 3840;
  scene.view.height_px = 2160;
  const Pictures pictures(scene);
  State state = pictures.log->state_at(time_of(Instant::last(), *pictures.log));
  const auto image = [&] {
    return Image{3840, 2160, painted(pictures.composition.frame({state}))};
  };
  const Image right = image();
  for (const int wrong : {313, 315, 304, 374, 214}) {
    state.count = wrong;
    const Image other = image();
    const Difference exact = compared(right, other);
    EXPECT_FALSE(exact.is_accepted) << wrong;
    // A thousandth of the frame may be anything; no place of 16x16 may be wrong in half of it.
    const Difference tolerant =
        compared(right, other, {.max_delta = 64, .max_pixels = 8294, .window = Window{16, 128}});
    EXPECT_LE(tolerant.off_pixels, 8294) << wrong;
    EXPECT_FALSE(tolerant.is_accepted) << wrong;
    // The count is in the upper half, right of its label.
    EXPECT_LT(tolerant.densest.y_px, 1080);
    EXPECT_GT(tolerant.densest.x_px, 1920);
  }
}

}  // namespace
}  // namespace piblocks
