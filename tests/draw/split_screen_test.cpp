#include <gtest/gtest.h>
#include <piblocks/error.hpp>
#include <piblocks/two_blocks.hpp>

#include <algorithm>

#include "draw/canvas.hpp"
#include "draw/composed_pictures.hpp"
#include "draw/layout.hpp"
#include "draw/montage.hpp"

#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/lsan_interface.h>
#endif

namespace piblocks {
namespace {

TEST(SplitScreen, CellsAreEqualApartAndInsideTheFrame) {
  for (const auto& [width, height] :
       {std::pair{1920, 1080}, {1080, 1920}, {301, 300}, {300, 300}, {64, 16}}) {
    for (std::size_t count = 2; count <= 4; ++count) {
      const SplitScreen split(view_of_size(width, height), count);
      const auto& cells = split.cells();
      ASSERT_EQ(cells.size(), count);
      for (std::size_t i = 0; i < count; ++i) {
        EXPECT_TRUE(to_rect({0, 0, width, height}).holds(to_rect(cells[i])));
        EXPECT_EQ(cells[i].width_px, cells[0].width_px);
        EXPECT_EQ(cells[i].height_px, cells[0].height_px);
        for (std::size_t k = 0; k < i; ++k) {
          EXPECT_FALSE(to_rect(cells[i]).meets(to_rect(cells[k])));
        }
      }
      EXPECT_EQ(cells[0].y_px == cells[1].y_px, width > height) << "side by side in a wide frame";
    }
  }
  EXPECT_THROW(SplitScreen(view_of_size(20, 16), 3), UsageError);
}

TEST(SplitScreen, RowsKeepTheMarginsOfTheFrame) {
  const SplitScreen split(view_of_size(1280, 720), 3, Split::rows);
  const PixelRect& first = split.cells().front();
  const PixelRect& last = split.cells().back();
  Scene scene;
  scene.view = view_of_size(first.width_px, first.height_px);
  scene.view.short_side_px = 720;
  scene.view.theme = Theme::lecture;
  scene.show.title = "High";
  const Drawing drawing(scene);
  const FramePlan plan = plan_frame(drawing.context, CounterRoom{.count_em = 2, .label_px = 90}, 0);
  const double top = plan.lines.front().origin.y - 0.72 * plan.lines.front().size_px;
  EXPECT_NEAR(first.y_px + top, 0.06 * 720, 1.5);
  EXPECT_NEAR(last.y_px + plan.stage.bottom(), 0.94 * 720, 1.5);
}

/// A title that has no room beside the counter is above it.
TEST(SplitScreen, ALongTitleIsAboveTheCounterOfItsRow) {
  Scene scene;
  scene.view = view_of_size(1080, 336);
  scene.view.short_side_px = 1080;
  scene.view.theme = Theme::lecture;
  scene.show.title = "A hundred times as heavy";
  const Drawing drawing(scene);
  CounterRoom room{.count_em = 2, .label_px = 90};
  const FramePlan plan = plan_frame(drawing.context, room, 0);
  const double below = plan.lines.front().origin.y + 0.25 * plan.lines.front().size_px;
  EXPECT_GE(plan.counter.baseline_px - 0.72 * plan.counter.size_px, below - 1);
  EXPECT_LE(plan.counter.baseline_px, 336);
  room.slow_motion_px = 300;  // its label is there
  EXPECT_THROW(plan_frame(drawing.context, room, 0), UsageError);
}

/// In a row the counter is beside the stage. Its place is known there too: the loupe needs it.
TEST(SplitScreen, ARowHasThePlaceOfItsCounter) {
  Scene scene;
  scene.view = view_of_size(1280, 240);
  scene.view.short_side_px = 720;
  scene.view.theme = Theme::lecture;
  const Drawing drawing(scene);
  const Sizes& sizes = drawing.sizes;
  for (const double pi_px : {0.0, 100.0, 700.0}) {
    for (const double slow_px : {0.0, 120.0, 800.0}) {
      const CounterRoom room{
          .count_em = 2, .label_px = 90, .pi_px = pi_px, .slow_motion_px = slow_px};
      const FramePlan plan = plan_frame(drawing.context, room, 0);
      const double left = plan.counter.pi_row_left_px;
      EXPECT_LE(left, 1280 - sizes.margin - std::max(pi_px, slow_px));
      EXPECT_LE(left, plan.counter.right_px - plan.counter.room_px);
      EXPECT_GT(left, 0);
      EXPECT_GE(plan.header_bottom_px, plan.counter.pi_baseline_px);
      // The counter is no obstacle above the stage, unless its line is wider.
      EXPECT_EQ(left > plan.stage.right() - sizes.margin, pi_px < 300 && slow_px < 300);
    }
  }
}

TEST(SplitScreen, NothingLeavesItsCell) {
  const SplitScreen split(view_of_size(200, 60), 2);
  std::vector<DrawList> pictures;
  for (const PixelRect& cell : split.cells()) {
    DrawList list{cell.width_px, cell.height_px, kWhite, {}};
    // As a block that has left the view, on one side and on the other.
    const double x = pictures.empty() ? 80 : -30;
    list.items.emplace_back(RectangleItem{ItemId::red_block, {x, 10, 50, 20}, kGreen, {}});
    pictures.push_back(list);
  }
  Canvas canvas(200, 60);
  canvas.paint(split.compose(pictures));
  const PixelRect& left = split.cells()[0];
  const PixelRect& right = split.cells()[1];
  for (int x = 0; x < 200; ++x) {
    const bool is_green = color_at(canvas, x, 20) == 0x0AC81E;
    const bool in_left = x >= 80 && x < left.width_px;
    const bool in_right = x >= right.x_px && x < right.x_px + 20;
    EXPECT_EQ(is_green, in_left || in_right) << x;
  }
}

TEST(SplitScreen, ACellShowsWhatItsPictureWouldBeAlone) {
  const SplitScreen split(view_of_size(200, 60), 2);
  DrawList list{split.cells()[0].width_px, 60, kWhite, {}};
  list.items.emplace_back(TextItem{ItemId::count, {10.3, 40.7}, "314", 21.3, kGreen});
  list.items.emplace_back(DiscItem{ItemId::panels, {70.3, 30.2}, 17.7, kGreen, Stroke{}});
  Canvas alone(list.width_px, 60);
  alone.paint(list);
  Canvas both(200, 60);
  both.paint(split.compose({list, list}));
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < list.width_px; ++x) {
      ASSERT_EQ(color_at(both, x, y), color_at(alone, x, y)) << x << ", " << y;
    }
  }
}

DrawList with_block_and_text(std::optional<Color> background) {
  const RectangleItem block{ItemId::red_block, {10.25, 5.5, 20, 10}, kGreen, std::nullopt};
  const TextItem text{ItemId::count, {5, 25}, "314", 20, {200, 30, 10}};
  return {40, 30, background, {block, text}};
}

/// Of a transparent picture alpha is mixed too: what is on it goes, little by little.
TEST(Fade, MixesThePictureWithItsBackground) {
  for (const std::optional<Color>& background : {std::optional(Color{20, 40, 60}), {}}) {
    const DrawList picture = with_block_and_text(background);
    const auto whole = painted(picture);
    const auto ground = painted({40, 30, background, {}});
    EXPECT_EQ(painted(faded(picture, 1)), whole);
    EXPECT_EQ(faded(picture, 0), (DrawList{40, 30, background, {}}));
    for (const double opacity : {0.1, 0.25, 0.5, 0.9}) {
      const auto mixed = painted(faded(picture, opacity));
      for (std::size_t i = 0; i < mixed.size(); ++i) {
        for (int shift = 0; shift < (background ? 24 : 32); shift += 8) {
          const auto level = [&](std::uint32_t word) { return double(word >> shift & 0xFF); };
          ASSERT_NEAR(level(mixed[i]), opacity * level(whole[i]) + (1 - opacity) * level(ground[i]),
                      1.51)
              << i << " at " << opacity;
        }
      }
    }
  }
}

/// Cairo 1.16 never frees a group that was painted into an SVG file.
#ifdef __SANITIZE_ADDRESS__
using CairoMayLeak = __lsan::ScopedDisabler;
#else
struct CairoMayLeak {};
#endif

TEST(Fade, AsAVectorFileIsTheSameEveryTime) {
  [[maybe_unused]] const CairoMayLeak allowance;
  const DrawList picture = with_block_and_text(kWhite);
  const DrawList half = faded(picture, 0.5);
  const std::vector<std::uint8_t> svg = draw_svg(half);
  draw_svg(picture);
  EXPECT_EQ(draw_svg(half), svg);
  const std::string text(svg.begin(), svg.end());
  // The names of Cairo 1.16 and 1.18 have numbers that count through the whole process.
  EXPECT_EQ(text.find("surface"), std::string::npos) << text;
  EXPECT_EQ(text.find("source-"), std::string::npos) << text;
  EXPECT_NE(text.find("id=\"picture\""), std::string::npos) << text;
  EXPECT_EQ(draw_pdf(half), draw_pdf(half));
}

}  // namespace
}  // namespace piblocks
