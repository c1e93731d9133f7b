#include <gtest/gtest.h>
#include <piblocks/error.hpp>
#include <piblocks/render.hpp>
#include <piblocks/script.hpp>

#include <algorithm>
#include <limits>
#include <utility>

#include "draw/canvas.hpp"
#include "draw/composition.hpp"
#include "scene/schedule.hpp"
#include "support/property.hpp"

namespace piblocks {
namespace {

using Bytes = std::vector<std::uint8_t>;

Scene scene_of(const char* size) {
  ScriptBuilder builder;
  builder.set("test", "view.size", size);
  builder.set("test", "view.fps", "20");
  return builder.build_scene();
}

Bytes bytes_of(const ImageView& image) {
  Bytes bytes;
  for (int y = 0; y < image.height_px; ++y) {
    bytes.insert(bytes.end(), image.row(y), image.row(y) + std::ptrdiff_t{4} * image.width_px);
  }
  return bytes;
}

/// Frames painted whole, each on a canvas of its own.
class FullPaint {
 public:
  explicit FullPaint(const Scene& scene)
      : scene_(scene),
        log_(make_pair_log(scene.system)),
        schedule_(make_schedule(scene, *log_)),
        composition_(scene, *log_) {}

  std::int64_t frame_count() const { return film_frames(schedule_); }
  Bytes frame(std::int64_t number) const {
    Canvas canvas(scene_.view.width_px, scene_.view.height_px);
    canvas.paint(composition_.frame({log_->state_at(schedule_.time_of(number))}));
    return bytes_of(canvas.view());
  }

 private:
  Scene scene_;
  std::unique_ptr<PairLog> log_;
  Schedule schedule_;
  Composition composition_;
};

TEST(FrameRenderer, EveryFrameIsThatOfAFullPaint) {
  const Scene scene = scene_of("321x95");
  FrameRenderer renderer(scene);
  const FullPaint expected(scene);
  ASSERT_EQ(renderer.frame_count(), expected.frame_count());
  ASSERT_GT(renderer.frame_count(), 100);
  for (std::int64_t k = 0; k < renderer.frame_count(); ++k) {
    ASSERT_TRUE(bytes_of(renderer.frame(k)) == expected.frame(k)) << k;
  }
}

TEST(FrameRenderer, AnyOrderGivesTheSameFrames) {
  const Scene scene = scene_of("320x180");
  FrameRenderer renderer(scene);
  const FullPaint expected(scene);
  Random random(1);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 200; ++i) {
    const std::int64_t k = random.integer(0, renderer.frame_count() - 1);
    ASSERT_TRUE(bytes_of(renderer.frame(k)) == expected.frame(k)) << k;
    ASSERT_TRUE(bytes_of(renderer.frame(k)) == expected.frame(k)) << k << " again";
  }
}

TEST(FrameRenderer, RefusesNumbersOutOfRangeAndGoesOn) {
  const Scene scene = scene_of("64x32");
  FrameRenderer renderer(scene);
  const Bytes last = bytes_of(renderer.frame(renderer.frame_count() - 1));
  constexpr auto kLowest = std::numeric_limits<std::int64_t>::min();
  constexpr auto kHighest = std::numeric_limits<std::int64_t>::max();
  for (const std::int64_t number : {std::int64_t{-1}, renderer.frame_count(), kLowest, kHighest}) {
    EXPECT_THROW(renderer.frame(number), UsageError) << number;
  }
  EXPECT_EQ(bytes_of(renderer.frame(renderer.frame_count() - 1)), last);
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
  EXPECT_EQ(bytes_of(copied), bytes_of(renderer.frame(7)));
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
  const Bytes expected = bytes_of(first.frame(50));
  FrameRenderer second = std::move(first);
  EXPECT_EQ(bytes_of(second.frame(50)), expected);
}

}  // namespace
}  // namespace piblocks
