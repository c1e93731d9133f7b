#include "draw/canvas.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "draw/extent.hpp"
#include "draw/found_items.hpp"
#include "support/pdf_pages.hpp"

namespace piblocks {
namespace {

void expect_colors(const Canvas& canvas, std::uint32_t color,
                   const std::vector<std::pair<int, int>>& places) {
  for (const auto& [x, y] : places) EXPECT_EQ(color_at(canvas, x, y), color) << x << ", " << y;
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
  expect_colors(canvas, 0x0AC81E, {{10, 5}, {29, 14}});
  expect_colors(canvas, 0xFFFFFF, {{9, 5}, {30, 14}, {29, 15}});
}

TEST(Canvas, CoversPartialPixelsInProportion) {
  Canvas canvas(40, 30);
  canvas.paint(with_rectangle({10.25, 5, 20, 10}));
  EXPECT_NEAR(color_at(canvas, 10, 7) & 0xFF, 255 - 0.75 * (255 - 30), 2);
  EXPECT_NEAR(color_at(canvas, 30, 7) & 0xFF, 255 - 0.25 * (255 - 30), 2);
}

TEST(Canvas, AStrokeStaysInside) {
  Canvas canvas(40, 30);
  canvas.paint(
      {40,
       30,
       kWhite,
       {RectangleItem{ItemId::wall, {10, 5, 20, 10}, std::nullopt, Stroke{kGreen, 2, 0}}}});
  expect_colors(canvas, 0x0AC81E, {{10, 10}, {11, 10}});
  expect_colors(canvas, 0xFFFFFF, {{9, 10}, {12, 10}});
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
    SCOPED_TRACE(far);
    expect_colors(canvas, 0x0AC81E, {{38, 28}, {2, 3}, {30, 10}});
    expect_colors(canvas, 0xFFFFFF, {{12, 20}});
  }
}

TEST(Canvas, DashesMeetInEveryCorner) {
  Canvas canvas(40, 30);
  canvas.paint({40,
                30,
                kWhite,
                {RectangleItem{ItemId::wall, {2, 3, 31, 23}, std::nullopt, Stroke{kGreen, 1, 3}}}});
  expect_colors(canvas, 0x0AC81E, {{2, 3}, {32, 3}, {2, 25}, {32, 25}});
}

TEST(Canvas, APictureDoesNotDependOnTheOneBefore) {
  const DrawList text{40, 30, kWhite, {TextItem{ItemId::count, {2, 20}, "31", 18, kGreen}}};
  Canvas used(40, 30);
  used.paint(with_rectangle({3, 3, 30, 20}));
  used.paint(text);
  EXPECT_EQ(pixels_of(used.view()), painted(text));
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
        canvas.paint(list);
        EXPECT_EQ(pixels_of(canvas.view()), painted(list))
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
  const std::vector<std::uint32_t> words = pixels_of(canvas.view());
  constexpr std::size_t kRow = 7 * 40;
  EXPECT_EQ(words[kRow + 20], 0xFF0AC81Eu);
  EXPECT_EQ(words[kRow + 5], 0u);
  EXPECT_NEAR(words[kRow + 10] >> 24, 0.75 * 255, 2);
  EXPECT_NEAR(words[kRow + 10] >> 8 & 0xFF, 0.75 * 200, 2);
  list.items.clear();
  canvas.paint(list);
  EXPECT_EQ(pixels_of(canvas.view())[kRow + 20], 0u) << "what was there before is gone";
}

TEST(Canvas, WithoutABackgroundLooksTheSameOnWhite) {
  DrawList list = with_rectangle({3.4, 5.7, 20.3, 10.1});
  list.items.emplace_back(TextItem{ItemId::count, {2, 20}, "31", 18, {20, 40, 220}});
  const std::vector<std::uint32_t> opaque = painted(list);
  list.background.reset();
  const std::vector<std::uint32_t> transparent = painted(list);
  for (std::size_t i = 0; i < opaque.size(); ++i) {
    const std::uint32_t over = transparent[i];
    for (const int shift : {0, 8, 16}) {
      const int shown = static_cast<int>(over >> shift & 0xFF) + 255 - static_cast<int>(over >> 24);
      EXPECT_NEAR(shown, static_cast<int>(opaque[i] >> shift & 0xFF), 2) << i;
      EXPECT_LE(over >> shift & 0xFF, over >> 24) << i;
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

TEST(VectorFiles, HaveAPageForEachPictureAndFontsOnce) {
  const auto number = [](int count) {
    return DrawList{
        40, 30, kWhite, {TextItem{ItemId::count, {2, 20}, std::to_string(count), 9, kGreen}}};
  };
  const auto film = [&](int pictures) {
    PdfPages pages(40, 30);
    std::string pdf;
    for (int i = 0; i < pictures; ++i) pdf += as_text(pages.add(number(1000 + i)));
    return pdf + as_text(pages.finish());
  };
  EXPECT_EQ(film(1), as_text(draw_pdf(number(1000))));
  const std::string pdf = film(50);
  EXPECT_EQ(pdf, film(50));
  EXPECT_EQ(testing_support::pages_of_pdf(pdf), 50);
  EXPECT_LT(pdf.size(), 50 * 1000U + film(1).size()) << "each page has its own fonts";
}

}  // namespace
}  // namespace piblocks
