#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "draw/found_items.hpp"
#include "draw/montage.hpp"

namespace piblocks {
namespace {

/// So many pictures, green all over and beyond.
std::vector<CaptionedPicture> green(int count, int width_px, int height_px,
                                    const std::string& caption = "t = 3.49785") {
  const RectangleItem large{ItemId::wall, {-500, -500, 9000, 9000}, kGreen, std::nullopt};
  return {static_cast<std::size_t>(count),
          {DrawList{width_px, height_px, Color{0, 0, 0}, {large}}, caption}};
}

std::vector<Rect> places_on(const DrawList& page) {
  std::vector<Rect> places;
  for (const GroupItem& group : items_of<GroupItem>(page.items)) places.push_back(group.bounds);
  return places;
}

TEST(Sheet, PicturesKeepTheirShapeAndDoNotOverlap) {
  for (const int count : {1, 2, 3, 12, 13, 200}) {
    for (const auto& [width, height] : {std::pair{1920, 1080}, {1080, 1920}, {4000, 10}}) {
      const auto places = places_on(arrange(green(count, width, height), 842, 595));
      ASSERT_EQ(places.size(), std::size_t(count));
      const Rect page = Rect{0, 0, 842, 595}.grown(-0.04 * 595);
      for (const Rect& a : places) {
        EXPECT_NEAR(a.width / a.height, double(width) / height, 1e-6 * width);
        EXPECT_TRUE(page.holds(a));
        for (const Rect& b : places) EXPECT_TRUE(&a == &b || !a.grown(1e-9).meets(b));
      }
    }
  }
}

std::vector<TextItem> captions_on(const DrawList& page) { return items_of<TextItem>(page.items); }

/// Captions have their size, are inside of the margins, below their pictures and apart.
void expect_legible(const std::vector<TextItem>& captions, const std::vector<Rect>& places,
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
    const Rect& place = places[i];
    EXPECT_NEAR(caption.origin.x + width / 2, place.x + place.width / 2, 1e-6);
    EXPECT_GT(caption.origin.y - 0.8 * caption.size_px, place.bottom());
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
  for (const Rect& place : places_on(page)) {
    EXPECT_EQ(at(place.x + place.width / 2, place.y + place.height / 2), 0x0AC81Eu);
    EXPECT_EQ(at(place.x - 4, place.y + place.height / 2), 0xFFFFFFu);
    EXPECT_EQ(at(place.x + place.width / 2, place.y - 4), 0xFFFFFFu);
  }
}

/// Pixels of the picture are not those of the page: what moves is shown at the picture's instant.
TEST(Sheet, ShowsWhatMovesSharpAtAnyScale) {
  for (const int width_px : {60, 400, 1600, 5000}) {
    const double unit = width_px / 10.0;
    const auto block = [&](double x) {
      return ExposedBlock{{x * unit, unit, unit, unit}, kGreen, {kGreen, 1, 0}, {}, {}};
    };
    ExposedBlock dwelling = block(3);
    dwelling.dwells = {{3 * unit, 0.5}, {4 * unit, 0.5}};
    const std::vector<Point> places{{7 * unit, unit}, {6 * unit, unit}};
    const DrawList list{width_px,
                        width_px / 2,
                        Color{0, 0, 0},
                        {ExposedBlocksItem{ItemId::red_block, block(1), dwelling, {}},
                         MovingShapesItem{ItemId::blue_block, {0.5, 0.5}, {{block(7), places}}}}};
    const DrawList page = arrange({{list, "a"}}, 400, 300);
    const Image image = draw_pixels(page);
    const Rect place = places_on(page).front();
    for (int x = 0; x < 10; ++x) {
      const auto column = std::size_t(place.x + (x + 0.5) / 10 * place.width);
      const auto row = std::size_t(place.y + 1.5 / 5 * place.height);
      const bool is_block = x == 1 || x == 3 || x == 7;
      EXPECT_EQ(image.words[row * 400 + column] & 0xFFFFFF, is_block ? 0x0AC81Eu : 0u)
          << x << " of " << width_px;
    }
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
