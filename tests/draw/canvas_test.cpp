#include "draw/canvas.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "draw/extent.hpp"

namespace piblocks {
namespace {

constexpr Color kWhite = {255, 255, 255};
constexpr Color kGreen = {10, 200, 30};

std::uint32_t pixel(const Canvas& canvas, int x, int y) {
  std::uint32_t value = 0;
  std::memcpy(&value, canvas.view().row(y) + 4 * x, 4);
  return value & 0xFFFFFF;
}

DrawList with_rectangle(const Rect& bounds) {
  return {40, 30, kWhite, {RectangleItem{ItemId::blue_block, bounds, kGreen, std::nullopt}}};
}

std::string as_text(const std::vector<std::uint8_t>& bytes) { return {bytes.begin(), bytes.end()}; }

TEST(Extent, FindsWhatIsNotFiniteInGroups) {
  for (const double x : {1.0, std::nan(""), HUGE_VAL}) {
    const auto inner = std::make_shared<const DrawList>(with_rectangle({x, 0, 1, 1}));
    const auto outer = std::make_shared<const DrawList>(
        DrawList{40, 30, kWhite, {GroupItem{ItemId::loupe, {0, 0, 9, 9}, inner}}});
    const std::vector<DrawItem> items{GroupItem{ItemId::loupe, {0, 0, 40, 30}, outer}};
    EXPECT_EQ(are_finite(items), x == 1) << x;
  }
}

TEST(Canvas, FillsExactlyTheRectangle) {
  Canvas canvas(40, 30);
  canvas.paint(with_rectangle({10, 5, 20, 10}));
  EXPECT_EQ(pixel(canvas, 10, 5), 0x0AC81Eu);
  EXPECT_EQ(pixel(canvas, 29, 14), 0x0AC81Eu);
  EXPECT_EQ(pixel(canvas, 9, 5), 0xFFFFFFu);
  EXPECT_EQ(pixel(canvas, 30, 14), 0xFFFFFFu);
  EXPECT_EQ(pixel(canvas, 29, 15), 0xFFFFFFu);
}

TEST(Canvas, CoversPartialPixelsInProportion) {
  Canvas canvas(40, 30);
  canvas.paint(with_rectangle({10.25, 5, 20, 10}));
  EXPECT_NEAR(pixel(canvas, 10, 7) & 0xFF, 255 - 0.75 * (255 - 30), 2);
  EXPECT_NEAR(pixel(canvas, 30, 7) & 0xFF, 255 - 0.25 * (255 - 30), 2);
}

TEST(Canvas, AStrokeStaysInside) {
  Canvas canvas(40, 30);
  canvas.paint(
      {40,
       30,
       kWhite,
       {RectangleItem{ItemId::wall, {10, 5, 20, 10}, std::nullopt, Stroke{kGreen, 2, 0}}}});
  EXPECT_EQ(pixel(canvas, 9, 10), 0xFFFFFFu);
  EXPECT_EQ(pixel(canvas, 10, 10), 0x0AC81Eu);
  EXPECT_EQ(pixel(canvas, 11, 10), 0x0AC81Eu);
  EXPECT_EQ(pixel(canvas, 12, 10), 0xFFFFFFu);
}

TEST(Canvas, WhatReachesFarOutOfTheFrameIsSeenInIt) {
  constexpr Stroke kLine{kGreen, 2, 0};
  for (const double far : {1e4, 5e6, 1.3e7, 2e7, 1e9, 1e15}) {
    Canvas canvas(40, 30);
    canvas.paint({40,
                  30,
                  kWhite,
                  {RectangleItem{ItemId::blue_block, {20, 15, far, far}, kGreen, std::nullopt},
                   RectangleItem{ItemId::red_block, {-far, -far, far + 5, far + 6}, kGreen, kLine},
                   PathItem{ItemId::ruler, std::vector<Point>{{-far, 10}, {far, 10}}, false,
                            std::nullopt, kLine}}});
    EXPECT_EQ(pixel(canvas, 38, 28), 0x0AC81Eu) << far;
    EXPECT_EQ(pixel(canvas, 2, 3), 0x0AC81Eu) << far;
    EXPECT_EQ(pixel(canvas, 30, 10), 0x0AC81Eu) << far;
    EXPECT_EQ(pixel(canvas, 12, 20), 0xFFFFFFu) << far;
  }
}

TEST(Canvas, DashesMeetInEveryCorner) {
  Canvas canvas(40, 30);
  canvas.paint({40,
                30,
                kWhite,
                {RectangleItem{ItemId::wall, {2, 3, 31, 23}, std::nullopt, Stroke{kGreen, 1, 3}}}});
  for (const auto& [x, y] : {std::pair{2, 3}, {32, 3}, {2, 25}, {32, 25}}) {
    EXPECT_EQ(pixel(canvas, x, y), 0x0AC81Eu) << x << ',' << y;
  }
}

TEST(Canvas, APictureDoesNotDependOnTheOneBefore) {
  const DrawList text{40, 30, kWhite, {TextItem{ItemId::count, {2, 20}, "31", 18, kGreen}}};
  Canvas fresh(40, 30);
  fresh.paint(text);
  Canvas used(40, 30);
  used.paint(with_rectangle({3, 3, 30, 20}));
  used.paint(text);
  for (int y = 0; y < 30; ++y) {
    EXPECT_EQ(std::memcmp(fresh.view().row(y), used.view().row(y), 40 * 4), 0) << "row " << y;
  }
}

std::uint32_t word(const Canvas& canvas, int x, int y) {
  std::uint32_t value = 0;
  std::memcpy(&value, canvas.view().row(y) + 4 * x, 4);
  return value;
}

/// A plate of its own in each list, with the same disc in all.
DrawList with_plate(const Rect& bounds, const Point& origin) {
  const DiscItem disc{ItemId::blue_block, {20.5, 15.25}, 9, kGreen, std::nullopt};
  const auto plate = std::make_shared<const Plate>(Plate{{disc}});
  return {60, 40, kWhite, {PlateItem{ItemId::panels, bounds, plate, origin}}};
}

TEST(Canvas, PlatesOfEqualItemsMayHaveOtherPixels) {
  Canvas canvas(60, 40);
  for (const Rect& bounds :
       {Rect{10, 5, 16, 20}, {10, 5, 20, 12}, {10, 5, 20, 20}, {14, 5, 20, 20}}) {
    for (const Point& origin : {Point{0, 0}, Point{4, 0}, Point{0, 3}}) {
      for (const double right : {0.0, 7.0, 7.0}) {
        const DrawList list = with_plate({bounds.x + right, bounds.y, bounds.width, bounds.height},
                                         {origin.x + right, origin.y});
        Canvas fresh(60, 40);
        fresh.paint(list);
        canvas.paint(list);
        const std::size_t size = std::size_t(canvas.view().stride_bytes) * 40;
        EXPECT_EQ(std::memcmp(canvas.view().row(0), fresh.view().row(0), size), 0)
            << bounds.width << ' ' << bounds.x << ' ' << origin.x << ' ' << origin.y;
      }
    }
  }
}

TEST(Canvas, WithoutABackgroundHasAlphaAndColoursMultipliedByIt) {
  DrawList list = with_rectangle({10.25, 5, 20, 10});
  list.background.reset();
  Canvas canvas(40, 30, Background::transparent);
  EXPECT_TRUE(canvas.view().has_alpha);
  EXPECT_FALSE(Canvas(40, 30).view().has_alpha);
  canvas.paint(list);
  EXPECT_EQ(word(canvas, 20, 7), 0xFF0AC81Eu);
  EXPECT_EQ(word(canvas, 5, 7), 0u);
  EXPECT_NEAR(word(canvas, 10, 7) >> 24, 0.75 * 255, 2);
  EXPECT_NEAR(word(canvas, 10, 7) >> 8 & 0xFF, 0.75 * 200, 2);
  list.items.clear();
  canvas.paint(list);
  EXPECT_EQ(word(canvas, 20, 7), 0u) << "what was there before is gone";
}

TEST(Canvas, WithoutABackgroundLooksTheSameOnWhite) {
  DrawList list = with_rectangle({3.4, 5.7, 20.3, 10.1});
  list.items.emplace_back(TextItem{ItemId::count, {2, 20}, "31", 18, {20, 40, 220}});
  Canvas opaque(40, 30);
  opaque.paint(list);
  list.background.reset();
  Canvas transparent(40, 30, Background::transparent);
  transparent.paint(list);
  for (int y = 0; y < 30; ++y) {
    for (int x = 0; x < 40; ++x) {
      const std::uint32_t over = word(transparent, x, y);
      for (const int shift : {0, 8, 16}) {
        const int shown =
            static_cast<int>(over >> shift & 0xFF) + 255 - static_cast<int>(over >> 24);
        EXPECT_NEAR(shown, static_cast<int>(pixel(opaque, x, y) >> shift & 0xFF), 2)
            << x << ',' << y;
        EXPECT_LE(over >> shift & 0xFF, over >> 24) << x << ',' << y;
      }
    }
  }
}

TEST(VectorFiles, HaveNoGroundWithoutABackground) {
  const DrawList nothing{40, 30, std::nullopt, {}};
  const DrawList white{40, 30, kWhite, {}};
  EXPECT_EQ(as_text(draw_svg(nothing)).find("fill"), std::string::npos);
  EXPECT_NE(as_text(draw_svg(white)).find("fill"), std::string::npos);
  EXPECT_LT(draw_pdf(nothing).size(), draw_pdf(white).size());
}

TEST(VectorFiles, AreCompleteAndRepeatable) {
  const DrawList list{40,
                      30,
                      kWhite,
                      {RectangleItem{ItemId::wall, {1, 1, 9, 9}, kGreen, std::nullopt},
                       TextItem{ItemId::count, {2, 20}, "314", 9, kGreen}}};
  const std::string svg = as_text(draw_svg(list));
  EXPECT_NE(svg.find("width=\"40px\""), std::string::npos) << svg.substr(0, 300);
  EXPECT_TRUE(svg.ends_with("</svg>\n"));
  EXPECT_EQ(svg, as_text(draw_svg(list)));
  DrawList with_image = list;
  with_image.items.emplace_back(
      ImageItem{ItemId::logo,
                {5, 5, 20, 20},
                std::make_shared<const Image>(Image{3, 2, std::vector<std::uint32_t>(6)})});
  EXPECT_EQ(as_text(draw_svg(with_image)), as_text(draw_svg(with_image)));
  const std::string pdf = as_text(draw_pdf(list));
  EXPECT_TRUE(pdf.starts_with("%PDF-"));
  EXPECT_TRUE(pdf.ends_with("%%EOF\n"));
  EXPECT_EQ(pdf, as_text(draw_pdf(list)));
}

}  // namespace
}  // namespace piblocks
