// Exposed frames against the mean of many instants, and what must hold of them at any rate.
#include <gtest/gtest.h>
#include <piblocks/encode.hpp>
#include <piblocks/render.hpp>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <set>
#include <string>
#include <vector>

#include "draw/composed_pictures.hpp"
#include "mean_light.hpp"
#include "render/film.hpp"
#include "support/article_scene.hpp"
#include "support/temporary_folder.hpp"

namespace piblocks {
namespace {

Scene scene_with_shutter(int digits, FrameSize size, const Rational& shutter) {
  Scene scene = testing_support::article_scene(digits, size.width_px, size.height_px);
  scene.view.shutter = shutter;
  return scene;
}

/// Rows in which the blocks look different: above them, their upper lines, their middle, and so on.
std::vector<int> rows_of(const Scene& scene) {
  const DrawList list = Pictures(scene).at(0);
  std::set<int> rows;
  for (const ItemId block : {ItemId::red_block, ItemId::blue_block}) {
    const Rect& bounds = item_of<RectangleItem>(list, block).bounds;
    const int top = static_cast<int>(std::floor(bounds.y));
    const int bottom = static_cast<int>(std::ceil(bounds.bottom()));
    rows.insert((top + bottom) / 2);
    for (int i = -1; i < 5; ++i) rows.insert({top + i, bottom - i});
  }
  return {rows.begin(), rows.end()};
}

/// @param most  steps of 255; half of one is the rounding of the sample.
void expect_mean_of_instants(const Scene& scene, std::initializer_list<std::int64_t> frames,
                             double most = 2.5) {
  FrameRenderer renderer(scene);
  const auto samples = [rows = rows_of(scene)](const ImageView& picture) {
    return samples_of(picture, rows);
  };
  for (const std::int64_t frame : frames) {
    EXPECT_LE(difference_of(samples(renderer.frame(frame)), mean_of_instants(scene, frame, samples))
                  .worst,
              most)
        << "frame " << frame << " of " << scene.view.width_px << " pixels";
  }
}

TEST(Shutter, FramesAreMeansOfInstants) {
  for (const int digits : {1, 3, 6, 20}) {
    SCOPED_TRACE(digits);
    // The first collision is in frame 90, the turn at 210.
    expect_mean_of_instants(scene_with_shutter(digits, {960, 540}, Rational(1, 2)), {90, 150, 210});
    expect_mean_of_instants(scene_with_shutter(digits, {320, 180}, 1), {90, 208, 209, 210, 230});
  }
}

TEST(Shutter, FramesOfAnySpeedAreMeansOfInstants) {
  for (const int digits : {2, 5}) {
    SCOPED_TRACE(digits);
    Scene scene = scene_with_shutter(digits, {333, 217}, Rational(3, 4));
    scene.time.speed = Rational(1, 3);
    expect_mean_of_instants(scene, {450, 629, 630});
    scene.time.speed = 10;
    expect_mean_of_instants(scene, {8, 20, 21});
    scene.time.speed = Rational(1, 500);
    expect_mean_of_instants(scene, {45'000, 104'990, 105'000});
  }
}

/// Corners are a few pixels wide at this size, so that rows at the ends of blocks differ.
TEST(Shutter, FramesOfRoundBlocksAreMeansOfInstants) {
  Scene scene = scene_with_shutter(3, {1280, 720}, Rational(1, 2));
  scene.view.theme = Theme::lecture;
  scene.show.overlays.emplace();  // masses are those of the frame's instant
  scene.show.hits = false;
  scene.show.loupe = Loupe{.is_on = false};
  const DrawList list = Pictures(scene).at(0);
  EXPECT_NEAR(item_of<RectangleItem>(list, ItemId::red_block).corner_px, 0.004 * 720, 1e-9);
  expect_mean_of_instants(scene, {90, 150, 210}, 5);
}

/// Time that stands, runs slower and runs back within one exposure.
TEST(Shutter, FramesAcrossStretchesAreMeansOfInstants) {
  Scene scene = scene_with_shutter(3, {640, 360}, 1);
  scene.view.frame_rate = 10;
  scene.time.to = Rational(5);
  scene.pacing.freezes = {{parse_instant("3.43"), Rational(1, 10)}};
  scene.pacing.slow_motion = {parse_slow_motion("3.5:3.52:5")};
  scene.pacing.loop = true;
  expect_mean_of_instants(scene, {33, 34, 35, 36, 37, 49, 50, 51, 60});
}

/// Other widths and masses: edges that are not on whole pixels in any direction.
TEST(Shutter, FramesOfOddBlocksAreMeansOfInstants) {
  Scene scene = scene_with_shutter(3, {500, 300}, Rational(1, 2));
  scene.system.bodies[0].size = Rational(5, 7);
  scene.system.bodies[1].size = Rational(13, 11);
  scene.system.bodies[0].velocity[0] = Rational(-1, 3);
  expect_mean_of_instants(scene, {0, 100, 190, 200, 210, 220});
  scene.system.bodies[1].size = Rational(1, 13);  // hardly more than its line
  expect_mean_of_instants(scene, {0, 100, 200, 210});
}

/// Bars across the blocks, and bounds that are not of whole pixels.
TEST(Shutter, FramesOfEveryThemeAreMeansOfInstants) {
  for (const Theme theme : {Theme::dark, Theme::print}) {
    Scene scene = scene_with_shutter(3, {330, 190}, Rational(1, 2));
    scene.view.theme = theme;
    scene.show.hits = false;  // marks are those of the frame's instant
    expect_mean_of_instants(scene, {90, 150, 210});
    scene.view.width_px = 100;  // too few pixels a unit to be rounded
    scene.view.height_px = 70;
    // A step of light is some steps of a sample where two dark lines meet.
    expect_mean_of_instants(scene, {90, 150, 210}, 3.5);
  }
}

TEST(Shutter, ClosedShowsTheInstant) {
  const Scene scene = scene_with_shutter(3, {320, 180}, 0);
  const Film film(scene);
  for (const std::int64_t frame : {0, 90, 210}) {
    EXPECT_TRUE(items_of<ExposedBlocksItem>(film.frame(frame).items).empty());
  }
}

TEST(Shutter, WhatStandsStillIsTheInstant) {
  Scene open = scene_with_shutter(3, {333, 217}, 1);
  open.pacing.freezes = {{parse_instant("3.47"), 1}};
  open.pacing.hold_end_s = 1;
  Scene closed = open;
  closed.view.shutter = 0;
  FrameRenderer exposed(open);
  FrameRenderer instants(closed);
  const std::int64_t last = exposed.frame_count() - 1;
  for (const std::int64_t frame : {std::int64_t{210}, std::int64_t{240}, last - 30, last}) {
    EXPECT_TRUE(pixels_of(exposed.frame(frame)) == pixels_of(instants.frame(frame))) << frame;
  }
}

TEST(Shutter, BlueAtRestIsAsInTheInstant) {
  Scene open = scene_with_shutter(3, {333, 217}, 1);
  Scene closed = open;
  closed.view.shutter = 0;
  const Rect blue = item_of<RectangleItem>(Film(closed).frame(0), ItemId::blue_block).bounds;
  const int left = static_cast<int>(blue.x) - 2;
  const int right = static_cast<int>(blue.right()) + 2;
  FrameRenderer exposed(open);
  FrameRenderer instants(closed);
  for (const std::int64_t frame : {0, 20, 60}) {
    const ImageView a = exposed.frame(frame);
    const ImageView b = instants.frame(frame);
    for (int y = 0; y < a.height_px; ++y) {
      EXPECT_TRUE(std::equal(a.row(y) + 4 * left, a.row(y) + 4 * right, b.row(y) + 4 * left));
    }
  }
}

TEST(Shutter, UpdatesAreWhatPaintingGives) {
  for (const FrameSize size : {FrameSize{320, 180}, FrameSize{97, 61}}) {
    for (const int digits : {1, 3, 8}) {
      Scene scene = scene_with_shutter(digits, size, Rational(1, 2));
      scene.pacing.freezes = {{parse_instant("3.45"), Rational(1, 10)}};
      const Film film(scene);
      Canvas canvas(size.width_px, size.height_px);
      for (std::int64_t frame = 80; frame < film.frame_count(); frame += frame == 100 ? 95 : 1) {
        canvas.update(film.frame(frame));
        if (frame > 250) break;
        ASSERT_TRUE(pixels_of(canvas.view()) == painted(film.frame(frame))) << "frame " << frame;
      }
    }
  }
}

TEST(Shutter, OnlyEndsOfWhatMovesAreRepainted) {
  const Film film(scene_with_shutter(3, {1920, 1080}, Rational(1, 2)));
  Canvas canvas(1920, 1080);
  canvas.update(film.frame(10));
  std::int64_t changed = 0;
  for (const PixelRect& rect : canvas.update(film.frame(11))) {
    changed += std::int64_t{rect.width_px} * rect.height_px;
  }
  // Both ends of red, its line of 3 pixels, and some 4 pixels of way from frame to frame.
  EXPECT_LE(changed, 2 * 140 * 12);
  EXPECT_GT(changed, 0);
}

TEST(Shutter, OfAStillIsThatOfTheFrameAtItsInstant) {
  const testing_support::TemporaryFolder folder;
  Scene scene = scene_with_shutter(3, {320, 180}, Rational(1, 2));
  scene.time.speed = Rational(1, 2);
  FrameRenderer renderer(scene);
  const std::string file = folder / "still.png";
  for (const auto& [instant, frame] : {std::pair{Rational(3, 2), 180}, {Rational(7, 2), 420}}) {
    render_still(scene, instant, file);
    const std::vector<std::uint8_t> bytes = encode_png(renderer.frame(frame));
    EXPECT_TRUE(testing_support::file_contents(file) == std::string(bytes.begin(), bytes.end()))
        << instant;
  }
}

TEST(Shutter, OfAStillThatNoFrameShowsRunsOnAtTheScenesSpeed) {
  const testing_support::TemporaryFolder folder;
  Scene scene = scene_with_shutter(3, {320, 180}, Rational(1, 2));
  Scene longer = scene;
  longer.time.to = Rational(30);
  render_still(scene, Rational(20), folder / "outside.png");
  render_still(longer, Rational(20), folder / "inside.png");
  EXPECT_TRUE(testing_support::file_contents(folder / "outside.png") ==
              testing_support::file_contents(folder / "inside.png"));
}

TEST(Shutter, OfASceneWithoutCollisionsNeedsNoEnd) {
  const testing_support::TemporaryFolder folder;
  Scene scene = scene_with_shutter(3, {320, 180}, 1);
  scene.system.bodies[1].velocity[0] = 1;
  EXPECT_NO_THROW(render_still(scene, Rational(1), folder / "still.png"));
}

}  // namespace
}  // namespace piblocks
