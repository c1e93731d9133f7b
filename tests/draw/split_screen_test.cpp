#include <gtest/gtest.h>
#include <piblocks/error.hpp>

#include <cstring>

#include "draw/canvas.hpp"
#include "draw/montage.hpp"

#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/lsan_interface.h>
#endif

namespace piblocks {
namespace {

constexpr Color kWhite = {255, 255, 255};
constexpr Color kGreen = {10, 200, 30};

std::uint32_t pixel(const Canvas& canvas, int x, int y) {
  std::uint32_t value = 0;
  std::memcpy(&value, canvas.view().row(y) + 4 * x, 4);
  return value & 0xFFFFFF;
}

View view_of_size(int width_px, int height_px) {
  View view;
  view.width_px = width_px;
  view.height_px = height_px;
  return view;
}

bool overlap(const PixelRect& a, const PixelRect& b) {
  return a.x_px < b.x_px + b.width_px && b.x_px < a.x_px + a.width_px &&
         a.y_px < b.y_px + b.height_px && b.y_px < a.y_px + a.height_px;
}

TEST(SplitScreen, CellsAreEqualApartAndInsideTheFrame) {
  for (const auto& [width, height] :
       {std::pair{1920, 1080}, {1080, 1920}, {301, 300}, {300, 300}, {64, 16}}) {
    for (std::size_t count = 2; count <= 4; ++count) {
      const SplitScreen split(view_of_size(width, height), count);
      const auto& cells = split.cells();
      ASSERT_EQ(cells.size(), count);
      for (std::size_t i = 0; i < count; ++i) {
        EXPECT_GE(cells[i].x_px, 0);
        EXPECT_GE(cells[i].y_px, 0);
        EXPECT_LE(cells[i].x_px + cells[i].width_px, width);
        EXPECT_LE(cells[i].y_px + cells[i].height_px, height);
        EXPECT_EQ(cells[i].width_px, cells[0].width_px);
        EXPECT_EQ(cells[i].height_px, cells[0].height_px);
        for (std::size_t k = 0; k < i; ++k) EXPECT_FALSE(overlap(cells[i], cells[k]));
      }
      EXPECT_EQ(cells[0].y_px == cells[1].y_px, width > height) << "side by side in a wide frame";
    }
  }
  EXPECT_THROW(SplitScreen(view_of_size(20, 16), 3), UsageError);
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
    const bool is_green = pixel(canvas, x, 20) == 0x0AC81E;
    const bool in_left = x >= 80 && x < left.width_px;
    const bool in_right = x >= right.x_px && x < right.x_px + 20;
    EXPECT_EQ(is_green, in_left || in_right) << x;
  }
}

TEST(SplitScreen, ACellShowsWhatItsPictureWouldBeAlone) {
  const SplitScreen split(view_of_size(200, 60), 2);
  DrawList list{split.cells()[0].width_px, 60, kWhite, {}};
  list.items.emplace_back(TextItem{ItemId::count, {10.3, 40.7}, "314", 21.3, kGreen});
  list.items.emplace_back(DiskItem{ItemId::panels, {70.3, 30.2}, 17.7, kGreen, Stroke{}});
  Canvas alone(list.width_px, 60);
  alone.paint(list);
  Canvas both(200, 60);
  both.paint(split.compose({list, list}));
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < list.width_px; ++x) {
      ASSERT_EQ(pixel(both, x, y), pixel(alone, x, y)) << x << ", " << y;
    }
  }
}

TEST(CrossFade, ShowsTheMeanHalfWay) {
  const RectangleItem block{ItemId::red_block, {10.25, 5.5, 20, 10}, kGreen, std::nullopt};
  const TextItem text{ItemId::count, {5, 25}, "314", 20, {200, 30, 10}};
  const DrawList from{40, 30, kWhite, {block}};
  const DrawList to{40, 30, Color{20, 40, 60}, {text}};
  Canvas first(40, 30);
  first.paint(from);
  Canvas second(40, 30);
  second.paint(to);
  for (const double opacity : {0.0, 0.25, 0.5, 1.0}) {
    Canvas both(40, 30);
    both.paint(cross_fade(from, to, opacity));
    for (int y = 0; y < 30; ++y) {
      for (int x = 0; x < 40; ++x) {
        for (const int shift : {0, 8, 16}) {
          const auto sample = [&](const Canvas& canvas) {
            return double((pixel(canvas, x, y) >> shift) & 0xFF);
          };
          ASSERT_NEAR(sample(both), (1 - opacity) * sample(first) + opacity * sample(second), 1.01)
              << x << ", " << y << " at " << opacity;
        }
      }
    }
  }
}

/// Of pictures that can be seen through each pixel, alpha included, is the mean: what only the
/// first has goes, little by little.
TEST(CrossFade, OfTransparentPicturesIsTheirMean) {
  const RectangleItem block{ItemId::red_block, {10.25, 5.5, 20, 10}, kGreen, std::nullopt};
  const TextItem text{ItemId::count, {5, 25}, "314", 20, {200, 30, 10}};
  const DrawList from{40, 30, std::nullopt, {block}};
  const DrawList to{40, 30, std::nullopt, {text}};
  const auto painted = [](const DrawList& list) {
    Canvas canvas(40, 30, Background::transparent);
    canvas.paint(list);
    std::vector<std::uint8_t> bytes;
    for (int y = 0; y < 30; ++y) {
      bytes.insert(bytes.end(), canvas.view().row(y), canvas.view().row(y) + 160);
    }
    return bytes;
  };
  const auto first = painted(from);
  const auto second = painted(to);
  for (const double opacity : {0.25, 0.5, 1.0}) {
    const auto both = painted(cross_fade(from, to, opacity));
    for (std::size_t i = 0; i < both.size(); ++i) {
      ASSERT_NEAR(both[i], (1 - opacity) * first[i] + opacity * second[i], 1.51) << i;
    }
  }
}

/// Cairo 1.16 never frees a group that was painted into an SVG file.
#ifdef __SANITIZE_ADDRESS__
using CairoMayLeak = __lsan::ScopedDisabler;
#else
struct CairoMayLeak {};
#endif

TEST(CrossFade, AsAVectorFileIsTheSameEveryTime) {
  [[maybe_unused]] const CairoMayLeak allowance;
  const DrawList from{40, 30, kWhite, {TextItem{ItemId::count, {5, 25}, "314", 20, kGreen}}};
  const DrawList both = cross_fade(from, {40, 30, kGreen, {}}, 0.5);
  const std::vector<std::uint8_t> svg = draw_svg(both);
  draw_svg(from);
  EXPECT_EQ(draw_svg(both), svg);
  const std::string text(svg.begin(), svg.end());
  EXPECT_EQ(text.find("surface"), std::string::npos) << text;
  EXPECT_NE(text.find("id=\"picture2\""), std::string::npos) << text;
  EXPECT_EQ(draw_pdf(both), draw_pdf(both));
}

}  // namespace
}  // namespace piblocks
