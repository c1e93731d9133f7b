#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "draw/canvas.hpp"
#include "draw/font.hpp"
#include "draw/montage.hpp"

namespace piblocks {
namespace {

constexpr Color kGreen = {10, 200, 30};

/// So many pictures, green all over and beyond.
std::vector<CaptionedPicture> green(int count, int width_px, int height_px,
                                    const std::string& caption = "t = 3.49785") {
  const RectangleItem large{ItemId::wall, {-500, -500, 9000, 9000}, kGreen, std::nullopt};
  return {static_cast<std::size_t>(count),
          {DrawList{width_px, height_px, Color{0, 0, 0}, {large}}, caption}};
}

std::vector<Rectangle> places_on(const DrawList& page) {
  std::vector<Rectangle> places;
  for (const DrawItem& item : page.items) {
    if (const auto* group = std::get_if<GroupItem>(&item)) places.push_back(group->bounds);
  }
  return places;
}

TEST(Sheet, PicturesKeepTheirShapeAndDoNotOverlap) {
  for (const int count : {1, 2, 3, 12, 13, 200}) {
    for (const auto& [width, height] : {std::pair{1920, 1080}, {1080, 1920}, {4000, 10}}) {
      const auto places = places_on(arrange(green(count, width, height), 842, 595));
      ASSERT_EQ(places.size(), std::size_t(count));
      for (const Rectangle& a : places) {
        EXPECT_NEAR(a.width / a.height, double(width) / height, 1e-6 * width);
        EXPECT_GE(a.x, 0.04 * 595);
        EXPECT_GE(a.y, 0.04 * 595);
        EXPECT_LE(a.x + a.width, 842 - 0.04 * 595);
        EXPECT_LE(a.y + a.height, 595 - 0.04 * 595);
        for (const Rectangle& b : places) {
          if (&a == &b) continue;
          EXPECT_TRUE(a.x + a.width < b.x || b.x + b.width < a.x || a.y + a.height < b.y ||
                      b.y + b.height < a.y);
        }
      }
    }
  }
}

std::vector<TextItem> captions_on(const DrawList& page) {
  std::vector<TextItem> captions;
  for (const DrawItem& item : page.items) {
    if (const auto* text = std::get_if<TextItem>(&item)) captions.push_back(*text);
  }
  return captions;
}

/// Captions have their size, are inside of the margins, below their pictures and apart.
void expect_legible(const std::vector<TextItem>& captions, const std::vector<Rectangle>& places,
                    double width_px, double height_px) {
  const Font font;
  const double side = std::min(width_px, height_px);
  const double margin = 0.04 * side;
  for (std::size_t i = 0; i < captions.size(); ++i) {
    const TextItem& caption = captions[i];
    const double width = font.width_em(caption.text) * caption.size_px;
    EXPECT_GE(caption.size_px, 0.018 * side);
    EXPECT_GE(caption.origin.x, margin);
    EXPECT_LE(caption.origin.x + width, width_px - margin);
    EXPECT_LE(caption.origin.y + 0.25 * caption.size_px, height_px - margin);
    const Rectangle& place = places[i];
    EXPECT_NEAR(caption.origin.x + width / 2, place.x + place.width / 2, 1e-6);
    EXPECT_GT(caption.origin.y - 0.8 * caption.size_px, place.y + place.height);
    if (i + 1 == captions.size() || captions[i + 1].origin.y != caption.origin.y) continue;
    EXPECT_GT(captions[i + 1].origin.x, caption.origin.x + width);
  }
}

TEST(Sheet, CaptionsAreLegibleOrLeftOut) {
  int with = 0;
  for (const std::string text : {"t = 0", "t = 3.49785", "t = turn − 5.10853×10⁻¹⁹"}) {
    for (const auto& [width, height] : {std::pair{1920, 1080}, {1080, 1920}, {1080, 1080}}) {
      for (const int count : {1, 2, 3, 12, 13, 40, 100, 200}) {
        SCOPED_TRACE(text + ", " + std::to_string(count) + " of " + std::to_string(width));
        for (const auto& [page_width, page_height] : {std::pair{842, 595}, {2339, 1654}}) {
          const DrawList page = arrange(green(count, width, height, text), page_width, page_height);
          const auto places = places_on(page);
          const auto captions = captions_on(page);
          const auto plain =
              places_on(arrange(green(count, width, height, ""), page_width, page_height));
          EXPECT_GE(places.front().width, plain.front().width / 2);
          if (captions.empty()) continue;
          ++with;
          ASSERT_EQ(captions.size(), std::size_t(count));
          expect_legible(captions, places, page_width, page_height);
        }
      }
    }
  }
  EXPECT_GT(with, 100);
  EXPECT_EQ(
      captions_on(arrange(green(12, 1080, 1920, "t = turn − 5.10853×10⁻¹⁹"), 842, 595)).size(),
      12u);
  EXPECT_EQ(captions_on(arrange(green(200, 1920, 1080), 842, 595)).size(), 0u);
  EXPECT_EQ(captions_on(arrange(green(2, 160, 90, std::string(300, '9')), 842, 595)).size(), 0u);
}

TEST(Sheet, PicturesWithoutCaptionsTakeTheirRoom) {
  const double with = places_on(arrange(green(4, 842, 595), 842, 595)).front().width;
  const DrawList page = arrange(green(4, 842, 595, ""), 842, 595);
  EXPECT_GT(places_on(page).front().width, with + 10);
  EXPECT_TRUE(captions_on(page).empty());
}

TEST(Sheet, FillsThePageAsFarAsTheShapesAllow) {
  const DrawList one = arrange(green(1, 842, 595), 842, 595);
  EXPECT_GT(places_on(one).front().width, 0.85 * 842);
  const DrawList four = arrange(green(4, 842, 595), 842, 595);
  EXPECT_GT(places_on(four).front().width, 0.4 * 842);
}

TEST(Sheet, CutsPicturesOffAtTheirEdge) {
  const DrawList page = arrange(green(4, 160, 90), 800, 600);
  const Image image = draw_pixels(page);
  const auto at = [&](double x, double y) {
    return image.words[std::size_t(y) * 800 + std::size_t(x)] & 0xFFFFFF;
  };
  for (const Rectangle& place : places_on(page)) {
    EXPECT_EQ(at(place.x + place.width / 2, place.y + place.height / 2), 0x0AC81Eu);
    EXPECT_EQ(at(place.x - 4, place.y + place.height / 2), 0xFFFFFFu);
    EXPECT_EQ(at(place.x + place.width / 2, place.y - 4), 0xFFFFFFu);
  }
}

/// A block that moves by a tenth of the picture's width, and one that stays.
DrawList exposed(int width_px, int height_px) {
  const double unit = width_px / 10.0;
  ExposedBlock moving{{5 * unit, unit, 2 * unit, 2 * unit}, kGreen, {kGreen, 1, 0}, {}, {}};
  for (int i = 0; i <= 10; ++i) moving.dwells.push_back({(5 + i / 10.0) * unit, 1 / 11.0});
  const ExposedBlock still{{unit, unit, 2 * unit, 2 * unit}, kGreen, {kGreen, 1, 0}, {}, {}};
  return {width_px,
          height_px,
          Color{0, 0, 0},
          {ExposedBlocksItem{ItemId::red_block, {moving, still}, {}}}};
}

TEST(Sheet, ShowsExposedBlocksInTheirPlaceAtAnyScale) {
  for (const int width_px : {60, 400, 1600, 5000}) {
    const DrawList page = arrange({{exposed(width_px, width_px / 2), "a"}}, 400, 300);
    const Image image = draw_pixels(page);
    const Rectangle place = places_on(page).front();
    const auto at = [&](double x, double y) {
      const auto column = std::size_t(place.x + x / 10 * place.width);
      const auto row = std::size_t(place.y + y / 5 * place.height);
      return image.words[row * 400 + column] & 0xFFFFFF;
    };
    EXPECT_EQ(at(2, 2), 0x0AC81Eu) << "the block that stays, of " << width_px;
    EXPECT_EQ(at(6.5, 2), 0x0AC81Eu) << "where the other one always is, of " << width_px;
    EXPECT_EQ(at(4, 2), 0x000000u) << width_px;
    EXPECT_EQ(at(9, 2), 0x000000u) << width_px;
    EXPECT_EQ(at(6.5, 4), 0x000000u) << width_px;
  }
}

TEST(Sheet, VectorFilesAreRepeatable) {
  const DrawList page = arrange(green(3, 160, 90), 842, 595);
  EXPECT_EQ(draw_pdf(page), draw_pdf(page));
  EXPECT_EQ(draw_svg(page), draw_svg(page));
  EXPECT_TRUE(std::string(reinterpret_cast<const char*>(draw_pdf(page).data()), 5) == "%PDF-");
}

}  // namespace
}  // namespace piblocks
