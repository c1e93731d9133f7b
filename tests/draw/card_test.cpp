#include <gtest/gtest.h>
#include <piblocks/error.hpp>

#include <variant>

#include "draw/composed_pictures.hpp"
#include "draw/look.hpp"
#include "draw/montage.hpp"

namespace piblocks {
namespace {

const std::vector<std::string> kLines = {
    "Counting π", "with two blocks and a wall", "all of them elastic", "3", "4", "5", "6", "7"};

TEST(Card, LinesAreCentredInOrderAndInsideTheFrame) {
  const Font font;
  for (const auto& [width, height] :
       {std::pair{1920, 1080}, {1080, 1920}, {400, 300}, {300, 300}, {2000, 320}}) {
    for (std::size_t count = 1; count <= kLines.size(); ++count) {
      const DrawList list = compose_card({kLines.begin(), kLines.begin() + std::ptrdiff_t(count)},
                                         view_of_size(width, height));
      ASSERT_EQ(list.items.size(), count);
      double above = 0;
      for (const DrawItem& item : list.items) {
        const auto& line = std::get<TextItem>(item);
        const double length = font.width_em(line.text) * line.size_px;
        EXPECT_GT(line.origin.x, 0);
        EXPECT_NEAR(line.origin.x + length / 2, width / 2.0, 1e-6);
        EXPECT_GT(line.origin.y - 0.73 * line.size_px, above) << "lines overlap";
        above = line.origin.y + 0.24 * line.size_px;
      }
      EXPECT_LT(above, height);
      const auto& first = std::get<TextItem>(list.items.front());
      const double top = first.origin.y - 0.73 * first.size_px;
      const double bottom = height - std::get<TextItem>(list.items.back()).origin.y;
      EXPECT_NEAR(top, bottom, 1.5) << "the block of lines is not in the middle";
    }
  }
}

TEST(Card, HasTheThemesColours) {
  View view = view_of_size(640, 360);
  view.theme = Theme::chalkboard;
  const DrawList list = compose_card({"a", "b"}, view);
  const Palette palette = palette_of(Theme::chalkboard);
  EXPECT_EQ(list.background, palette.background);
  EXPECT_EQ(std::get<TextItem>(list.items[0]).color, palette.text);
  EXPECT_EQ(std::get<TextItem>(list.items[1]).color, palette.muted);
}

TEST(Card, ALongLineShrinksAndThenIsRefused) {
  const View view = view_of_size(640, 360);
  const auto size = [&](std::size_t length) {
    return std::get<TextItem>(compose_card({std::string(length, 'm')}, view).items.front()).size_px;
  };
  EXPECT_LT(size(20), size(5));
  EXPECT_THROW(size(80), UsageError);
  EXPECT_THROW(compose_card({"a", std::string(200, 'm')}, view), UsageError);
  EXPECT_THROW(compose_card({"\xF0\x9F\xA7\xB1 no such glyph"}, view), UsageError);
}

}  // namespace
}  // namespace piblocks
