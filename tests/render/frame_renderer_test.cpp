#include <gtest/gtest.h>
#include <piblocks/error.hpp>
#include <piblocks/render.hpp>

#include <algorithm>
#include <limits>
#include <utility>

#include "draw/composed_pictures.hpp"
#include "scene/schedule.hpp"
#include "support/traced_random.hpp"

namespace piblocks {
namespace {

using Bytes = std::vector<std::uint8_t>;

Scene scene_of(const char* size) { return scene_with({{"view.size", size}, {"view.fps", "20"}}); }

/// Frames painted whole, each on a canvas of its own.
class FullPaint {
 public:
  explicit FullPaint(const Scene& scene)
      : pictures_(scene), schedule_(make_schedule(scene, *pictures_.log)) {}

  std::int64_t frame_count() const { return film_frames(schedule_); }
  std::vector<std::uint32_t> frame(std::int64_t number) const {
    return painted(pictures_.at(schedule_.time_of(number)));
  }

 private:
  Pictures pictures_;
  Schedule schedule_;
};

TEST(FrameRenderer, EveryFrameIsThatOfAFullPaint) {
  const Scene scene = scene_of("321x95");
  FrameRenderer renderer(scene);
  const FullPaint expected(scene);
  ASSERT_EQ(renderer.frame_count(), expected.frame_count());
  ASSERT_GT(renderer.frame_count(), 100);
  for (std::int64_t k = 0; k < renderer.frame_count(); ++k) {
    ASSERT_TRUE(pixels_of(renderer.frame(k)) == expected.frame(k)) << k;
  }
}

TEST(FrameRenderer, AnyOrderGivesTheSameFrames) {
  const Scene scene = scene_of("320x180");
  FrameRenderer renderer(scene);
  const FullPaint expected(scene);
  TracedRandom random(1);
  for (int i = 0; i < 200; ++i) {
    const std::int64_t k = random.integer(0, renderer.frame_count() - 1);
    ASSERT_TRUE(pixels_of(renderer.frame(k)) == expected.frame(k)) << k;
    ASSERT_TRUE(pixels_of(renderer.frame(k)) == expected.frame(k)) << k << " again";
  }
}

TEST(FrameRenderer, RefusesNumbersOutOfRangeAndGoesOn) {
  const Scene scene = scene_of("64x32");
  FrameRenderer renderer(scene);
  const auto last = pixels_of(renderer.frame(renderer.frame_count() - 1));
  constexpr auto kLowest = std::numeric_limits<std::int64_t>::min();
  constexpr auto kHighest = std::numeric_limits<std::int64_t>::max();
  for (const std::int64_t number : {std::int64_t{-1}, renderer.frame_count(), kLowest, kHighest}) {
    EXPECT_THROW(renderer.frame(number), UsageError) << number;
  }
  EXPECT_EQ(pixels_of(renderer.frame(renderer.frame_count() - 1)), last);
}

TEST(FrameRenderer, RefusesASceneThatWasNotChecked) {
  Scene scene = scene_of("64x32");
  scene.view.frame_rate = 0;
  scene.view.width_px = 0;
  try {
    FrameRenderer renderer(scene);
    FAIL() << "accepted";
  } catch (const SceneError& error) {
    EXPECT_EQ(error.problems().size(), 2U) << error.what();
  }
}

TEST(FrameRenderer, CopiesOnlyPixels) {
  const Scene scene = scene_of("63x32");
  FrameRenderer renderer(scene);
  constexpr std::size_t kStride = 63 * 4 + 12;
  constexpr std::uint8_t kUntouched = 0xA5;
  Bytes buffer(kStride * 32 + 5, kUntouched);
  renderer.copy_frame(7, buffer, kStride);
  const ImageView copied{buffer.data(), 63, 32, kStride};
  EXPECT_EQ(pixels_of(copied), pixels_of(renderer.frame(7)));
  for (std::size_t y = 0; y < 32; ++y) {
    const auto gap = buffer.begin() + std::ptrdiff_t(y * kStride + 63 * 4);
    EXPECT_EQ(std::count(gap, gap + 12 - (y == 31 ? 7 : 0), kUntouched), y == 31 ? 5 : 12) << y;
  }
}

TEST(FrameRenderer, CopiesIntoABufferThatEndsWithTheLastRow) {
  const Scene scene = scene_of("64x32");
  FrameRenderer renderer(scene);
  constexpr std::size_t kStride = 512;
  Bytes buffer(kStride * 31 + 64 * 4);
  EXPECT_NO_THROW(renderer.copy_frame(0, buffer, kStride));
}

TEST(FrameRenderer, RefusesABufferOrStrideThatIsTooSmall) {
  const Scene scene = scene_of("64x32");
  FrameRenderer renderer(scene);
  Bytes buffer(64 * 4 * 32, 1);
  const Bytes untouched = buffer;
  constexpr std::ptrdiff_t kFar = std::numeric_limits<std::ptrdiff_t>::max();
  for (const std::ptrdiff_t stride :
       {std::ptrdiff_t{255}, std::ptrdiff_t{0}, std::ptrdiff_t{-256}, std::ptrdiff_t{257}, kFar}) {
    EXPECT_THROW(renderer.copy_frame(0, buffer, stride), UsageError) << stride;
  }
  EXPECT_THROW(renderer.copy_frame(0, std::span(buffer).first(64 * 4 * 32 - 1), 256), UsageError);
  EXPECT_THROW(renderer.copy_frame(0, {}, 256), UsageError);
  EXPECT_THROW(renderer.copy_frame(-1, buffer, 256), UsageError);
  EXPECT_EQ(buffer, untouched);
}

TEST(FrameRenderer, CanBeMoved) {
  FrameRenderer first(scene_of("64x32"));
  const auto expected = pixels_of(first.frame(50));
  FrameRenderer second = std::move(first);
  EXPECT_EQ(pixels_of(second.frame(50)), expected);
}

}  // namespace
}  // namespace piblocks
