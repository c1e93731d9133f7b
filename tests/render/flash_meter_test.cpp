// Pictures that flash by themselves, against the thresholds as WCAG words them.
#include "render/flash_meter.hpp"

#include <gtest/gtest.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <functional>
#include <string>

#include "support/article_scene.hpp"
#include "support/contains.hpp"
#include "support/message_of.hpp"

namespace piblocks {
namespace {

constexpr double kFramesPerSecond = 60;
constexpr std::uint32_t kBlack = 0xff000000;
constexpr std::uint32_t kWhite = 0xffffffff;

/// As large as the screen that the thresholds are given for.
Image black_screen() { return {1024, 768, std::vector<std::uint32_t>(1024 * 768, kBlack)}; }

void fill(Image& image, const PixelRect& rect, std::uint32_t word) {
  for (int y = rect.y_px; y < rect.bottom_px(); ++y) {
    std::fill_n(image.words.begin() + y * 1024 + rect.x_px, rect.width_px, word);
  }
}

/// A rectangle that has a colour for every frame of two seconds.
std::optional<Flashing> flashing(const PixelRect& rect,
                                 const std::function<std::uint32_t(int)>& word_of, int most = 3) {
  FlashMeter meter(1024, 768, kFramesPerSecond, most);
  Image screen = black_screen();
  std::uint32_t shown = kBlack;
  std::optional<Flashing> worst;
  for (int frame = 0; frame < 120; ++frame) {
    const std::uint32_t word = word_of(frame);
    fill(screen, rect, word);
    const bool is_same = frame > 0 && word == shown;
    const auto found = meter.take(screen.view(), is_same ? std::span<const PixelRect>()
                                                         : std::span<const PixelRect>(&rect, 1));
    if (found && (!worst || found->share > worst->share)) worst = found;
    shown = word;
  }
  return worst;
}

/// So many changes between two colours, evenly within a second, then rest.
std::function<std::uint32_t(int)> changes(int count, std::uint32_t first, std::uint32_t second) {
  return [=](int frame) {
    const int done = std::min(count, frame * count / 60);
    return done % 2 == 0 ? first : second;
  };
}

constexpr std::uint32_t gray(std::uint32_t sample) { return 0xff000000 | sample * 0x010101; }

constexpr PixelRect kLarge{300, 200, 400, 300};

TEST(FlashMeterTest, ThreeFlashesAreHarmlessAndHalfAFlashMoreIsNot) {
  EXPECT_FALSE(flashing(kLarge, changes(0, kWhite, kBlack)));
  EXPECT_FALSE(flashing(kLarge, changes(6, kBlack, kWhite)));
  const auto found = flashing(kLarge, changes(7, kBlack, kWhite));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->frame, 60);
  EXPECT_GT(found->share, 0.99);
}

TEST(FlashMeterTest, AllowsAsManyAsItIsTold) {
  for (const int most : {1, 2, 5, 14}) {
    EXPECT_FALSE(flashing(kLarge, changes(2 * most, kBlack, kWhite), most)) << most;
    EXPECT_TRUE(flashing(kLarge, changes(2 * most + 1, kBlack, kWhite), most)) << most;
  }
}

TEST(FlashMeterTest, ChangesOfMoreThanASecondAgoDoNotCount) {
  // Seven changes, 11 frames apart: 66 frames from the first to the last.
  EXPECT_FALSE(flashing(kLarge, [](int frame) { return frame / 11 % 2 ? kWhite : kBlack; }));
  EXPECT_TRUE(flashing(kLarge, [](int frame) { return frame / 10 % 2 ? kWhite : kBlack; }));
}

TEST(FlashMeterTest, NeedsATenthOfTheLightOfWhite) {
  // Relative luminances 0.0999 and 0.1022 above black; 0.2159 and 0.3095 (0.0936 apart), 0.3231.
  EXPECT_FALSE(flashing(kLarge, changes(20, kBlack, gray(89))));
  EXPECT_TRUE(flashing(kLarge, changes(20, kBlack, gray(90))));
  EXPECT_FALSE(flashing(kLarge, changes(20, gray(128), gray(151))));
  EXPECT_TRUE(flashing(kLarge, changes(20, gray(128), gray(154))));
}

TEST(FlashMeterTest, BrightStatesDoNotFlash) {
  // Relative luminances 0.807 and 0.791.
  EXPECT_FALSE(flashing(kLarge, changes(20, gray(232), kWhite)));
  EXPECT_TRUE(flashing(kLarge, changes(20, gray(230), kWhite)));
}

TEST(FlashMeterTest, SaturatedRedFlashesAtTheSameLight) {
  // Relative luminance 0.2126 and 0.2122.
  EXPECT_TRUE(flashing(kLarge, changes(20, 0xffff0000, gray(127))));
  // The same with a red that is not saturated: R / (R + G + B) is 0.74.
  EXPECT_FALSE(flashing(kLarge, changes(20, 0xffff7070, gray(156))));
}

TEST(FlashMeterTest, SlowChangesAddUp) {
  // Up and down in ramps of eight frames, none of whose steps is a tenth.
  const auto ramp = [](int frame) {
    const int at = frame % 16;
    return gray(static_cast<std::uint32_t>(40 + 10 * (at < 8 ? at : 16 - at)));
  };
  EXPECT_TRUE(flashing(kLarge, ramp));
}

TEST(FlashMeterTest, AQuarterOfTenDegreesIsHarmless) {
  // 341 x 256 / 4 is the area of a square of 147.7 pixels.
  EXPECT_FALSE(flashing({400, 300, 140, 140}, changes(20, kBlack, kWhite)));
  const auto found = flashing({400, 300, 156, 156}, changes(20, kBlack, kWhite));
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->share, 156.0 * 156 / (341 * 256), 0.02);
  EXPECT_TRUE(flashing({0, 0, 156, 156}, changes(20, kBlack, kWhite)));
  EXPECT_TRUE(flashing({1024 - 156, 768 - 156, 156, 156}, changes(20, kBlack, kWhite)));
}

TEST(FlashMeterTest, PlacesFarApartAreNotSeenTogether) {
  FlashMeter meter(1024, 768, kFramesPerSecond, 3);
  Image screen = black_screen();
  const std::array<PixelRect, 2> places = {{{10, 10, 130, 130}, {880, 600, 130, 130}}};
  for (int frame = 0; frame < 60; ++frame) {
    for (const PixelRect& place : places) fill(screen, place, frame / 3 % 2 ? kWhite : kBlack);
    EXPECT_FALSE(meter.take(screen.view(), places)) << frame;
  }
}

Scene scene_of(int digits, double shown_length) {
  Scene scene = testing_support::article_scene(digits, 320, 180);
  scene.view.x = {scene.system.walls[0].point[0] - Rational(1, 2),
                  scene.system.walls[0].point[0] + Rational(shown_length)};
  return scene;
}

TEST(FlashCheckTest, LetsTheArticlesFilmsPass) {
  for (int digits = 1; digits <= 6; ++digits) {
    EXPECT_NO_THROW(check_flashes(Film(scene_of(digits, 7)), 3, {})) << digits;
  }
}

TEST(FlashCheckTest, RefusesBouncesThatFillTheFrameAndSaysWhatHelps) {
  Scene close = scene_of(3, 2);
  const std::string said =
      testing_support::message_of<UsageError>([&] { check_flashes(Film(close), 3, {}); });
  EXPECT_TRUE(testing_support::contains(said, "--shutter 1"));
  EXPECT_TRUE(testing_support::contains(said, "--slow-motion"));
  close.time.speed = Rational(1, 50);
  EXPECT_NO_THROW(check_flashes(Film(close), 3, {}));
}

TEST(FlashCheckTest, CanBeStopped) {
  std::stop_source source;
  source.request_stop();
  EXPECT_THROW(check_flashes(Film(scene_of(2, 7)), 3, source.get_token()), Interrupted);
}

}  // namespace
}  // namespace piblocks
