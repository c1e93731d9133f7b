#include "draw/sheet.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <string>

namespace piblocks {
namespace {

constexpr Color kGreen = {10, 200, 30};

/// So many pictures, green all over and beyond.
std::vector<CaptionedPicture> green(int count, int width_px, int height_px) {
  const RectangleItem large{ItemId::wall, {-500, -500, 9000, 9000}, kGreen, std::nullopt};
  return {static_cast<std::size_t>(count),
          {DrawList{width_px, height_px, Color{0, 0, 0}, {large}}, "time 1, count 2"}};
}

TEST(Sheet, PicturesKeepTheirShapeAndDoNotOverlap) {
  for (const int count : {1, 2, 3, 12, 13, 200}) {
    for (const auto& [width, height] : {std::pair{1920, 1080}, {1080, 1920}, {4000, 10}}) {
      const Sheet sheet = arrange(green(count, width, height), 842, 595);
      ASSERT_EQ(sheet.pictures.size(), std::size_t(count));
      for (const PlacedPicture& a : sheet.pictures) {
        EXPECT_NEAR(a.place.width / a.place.height, double(width) / height, 1e-6 * width);
        EXPECT_GE(a.place.x, 0.04 * 595);
        EXPECT_GE(a.place.y, 0.04 * 595);
        EXPECT_LE(a.place.x + a.place.width, 842 - 0.04 * 595);
        EXPECT_LE(a.place.y + a.place.height, 595 - 0.04 * 595);
        for (const PlacedPicture& b : sheet.pictures) {
          if (&a == &b) continue;
          EXPECT_TRUE(
              a.place.x + a.place.width < b.place.x || b.place.x + b.place.width < a.place.x ||
              a.place.y + a.place.height < b.place.y || b.place.y + b.place.height < a.place.y);
        }
      }
    }
  }
}

TEST(Sheet, FillsThePageAsFarAsTheShapesAllow) {
  const Sheet one = arrange(green(1, 842, 595), 842, 595);
  EXPECT_GT(one.pictures.front().place.width, 0.85 * 842);
  const Sheet four = arrange(green(4, 842, 595), 842, 595);
  EXPECT_GT(four.pictures.front().place.width, 0.4 * 842);
}

TEST(Sheet, CutsPicturesOffAtTheirEdge) {
  const Sheet sheet = arrange(green(4, 160, 90), 800, 600);
  const Image image = draw_pixels(sheet);
  const auto at = [&](double x, double y) {
    return image.words[std::size_t(y) * 800 + std::size_t(x)] & 0xFFFFFF;
  };
  for (const PlacedPicture& picture : sheet.pictures) {
    const Rectangle& place = picture.place;
    EXPECT_EQ(at(place.x + place.width / 2, place.y + place.height / 2), 0x0AC81Eu);
    EXPECT_EQ(at(place.x - 4, place.y + place.height / 2), 0xFFFFFFu);
    EXPECT_EQ(at(place.x + place.width / 2, place.y - 4), 0xFFFFFFu);
  }
}

/// A block that moves by a tenth of the picture's width, and one that stays.
DrawList exposed(int width_px, int height_px) {
  const double unit = width_px / 10.0;
  ExposedBlock moving{{5 * unit, unit, 2 * unit, 2 * unit}, kGreen, {kGreen, 1, 0}, {}, {}};
  for (int i = 0; i <= 10; ++i) moving.stops.push_back({(5 + i / 10.0) * unit, 1 / 11.0});
  const ExposedBlock still{{unit, unit, 2 * unit, 2 * unit}, kGreen, {kGreen, 1, 0}, {}, {}};
  return {width_px, height_px, Color{0, 0, 0}, {ExposedItem{ItemId::red_block, moving, still, {}}}};
}

TEST(Sheet, ShowsExposedBlocksInTheirPlaceAtAnyScale) {
  for (const int width_px : {60, 400, 1600, 5000}) {
    const Sheet sheet = arrange({{exposed(width_px, width_px / 2), "a"}}, 400, 300);
    const Image image = draw_pixels(sheet);
    const Rectangle& place = sheet.pictures.front().place;
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
  const Sheet sheet = arrange(green(3, 160, 90), 842, 595);
  EXPECT_EQ(draw_pdf(sheet), draw_pdf(sheet));
  EXPECT_EQ(draw_svg(sheet), draw_svg(sheet));
  EXPECT_TRUE(std::string(reinterpret_cast<const char*>(draw_pdf(sheet).data()), 5) == "%PDF-");
}

}  // namespace
}  // namespace piblocks
