#include <gtest/gtest.h>
#include <piblocks/two_blocks.hpp>

#include <cmath>

#include "draw/composed_pictures.hpp"
#include "draw/font.hpp"
#include "draw/layout.hpp"
#include "support/article_scene.hpp"

namespace piblocks {
namespace {
using testing_support::article_scene;

Layout lay_out(const Scene& scene, const Integer& longest_count) {
  const Rect whole{0, 0, double(scene.view.width_px), double(scene.view.height_px)};
  return lay_out_article(Drawing(scene).context, longest_count, whole);
}

constexpr auto rectangle = item_of<RectangleItem>;
constexpr auto text_item = item_of<TextItem>;

TEST(Stage, BlocksTouchWhereTheyCollide) {
  const Pictures pictures(article_scene(3, 1920, 1080));
  const DrawList blocks = pictures.after(1);
  EXPECT_NEAR(rectangle(blocks, ItemId::blue_block).bounds.right(),
              rectangle(blocks, ItemId::red_block).bounds.x, 1e-9);
  const DrawList wall = pictures.after(2);
  EXPECT_NEAR(wall_of(wall).right(), rectangle(wall, ItemId::blue_block).bounds.x, 1e-9);
}

TEST(Stage, BlocksStandOnOneBase) {
  const Font font;
  for (const char* width : {"4/5", "1", "3/2", "2"}) {
    Scene scene = article_scene(2, 1920, 1080);
    scene.system.bodies[1].size = parse_rational(width);
    scene.show.overlays = {Overlay::masses};
    const DrawList list = Pictures(scene).after(3);
    const Rect red = rectangle(list, ItemId::red_block).bounds;
    const Rect blue = rectangle(list, ItemId::blue_block).bounds;
    EXPECT_NEAR(red.bottom(), blue.bottom(), 1e-9) << width;
    const auto middle = [](const TextItem& label) {
      return label.origin.y - 0.365 * label.size_px;
    };
    const TextItem& mass = text_item(list, ItemId::masses);
    const bool is_wide = font.width_em(mass.text) * mass.size_px < 0.9 * red.width;
    if (is_wide) {
      EXPECT_NEAR(middle(mass), red.y + red.height / 2, 1e-9) << width;
    } else {
      EXPECT_LT(mass.origin.y, red.y) << "above the block";
    }
    EXPECT_NEAR(middle(text_item(list, nth(ItemId::masses, 1))), blue.y + blue.height / 2, 1e-9);
  }
}

TEST(Stage, TheHatchStaysBehindTheFaceOfTheWall) {
  for (const auto& [width, height] :
       {std::pair{1920, 1080}, {1280, 720}, {640, 360}, {1080, 1920}, {3840, 2160}}) {
    for (const Theme theme : {Theme::lecture, Theme::lecture_light, Theme::print}) {
      Scene scene = article_scene(2, width, height);
      scene.view.theme = theme;
      const DrawList list = Pictures(scene).at(0);
      const std::vector<DrawItem>& wall = std::get<PlateItem>(list.items.front()).plate->items;
      const Rect face = std::get<RectangleItem>(wall.back()).bounds;
      ASSERT_GT(wall.size(), 5U);
      for (std::size_t i = 0; i + 1 < wall.size(); ++i) {
        const auto& line = std::get<PathItem>(wall[i]);
        const Rect bounds = line.points.bounds();
        // The corner of the end of a line of 45 degrees.
        const double corner = bounds.right() + line.stroke->width_px / 2 * std::sqrt(0.5);
        EXPECT_LE(corner, face.right()) << i << " in " << width << 'x' << height;
        EXPECT_GE(bounds.right(), face.x - 1e-9) << "a gap";
      }
    }
  }
}

TEST(Stage, LinesOfBlocksDoNotDependOnWhatIsBesideThem) {
  for (const auto& [width, height] : {std::pair{1920, 1080}, {3840, 2160}, {1280, 720}}) {
    Scene plain = article_scene(2, width, height);
    Scene full = plain;
    full.show.title = "Title";
    full.show.panels = {Panel::time, Panel::velocity};
    const auto line_px = [](const Scene& scene) {
      return rectangle(Pictures(scene).at(0), ItemId::blue_block).stroke->width_px;
    };
    EXPECT_EQ(line_px(plain), line_px(full)) << width << 'x' << height;
  }
}

TEST(Stage, CounterShowsTheExactCountWithSeparators) {
  const Pictures pictures(article_scene(5, 1280, 720));
  EXPECT_EQ(text_of(pictures.at(0), ItemId::count), "0");
  EXPECT_EQ(text_of(pictures.after(1234), ItemId::count), "1,234");
  EXPECT_EQ(text_of(pictures.at(1000), ItemId::count), "31,415");
}

TEST(Stage, NothingOverlapsOrLeavesTheFrameAtAnyAspect) {
  const Font font;
  for (const int digits : {1, 3, 9, 20, 40}) {
    for (const auto& [width, height] : {std::pair{1920, 1080},
                                        {1280, 720},
                                        {3840, 2160},
                                        {1080, 1920},
                                        {1080, 1080},
                                        {1440, 1080},
                                        {1300, 200},
                                        {200, 1300},
                                        {64, 36},
                                        {2, 2}}) {
      const Pictures pictures(article_scene(digits, width, height));
      const DrawList list = pictures.after(pictures.log->last());
      const Rect wall = wall_of(list);
      const TextItem& label = text_item(list, ItemId::label);
      const TextItem& count = text_item(list, ItemId::count);
      const double end = count.origin.x + font.width_em(count.text) * count.size_px;
      EXPECT_GT(wall.width, 0);
      EXPECT_LT(wall.width, wall.height) << "a line";
      EXPECT_GE(wall.x, 0);
      EXPECT_LE(wall.bottom(), height);
      EXPECT_GE(label.origin.x, 0);
      EXPECT_LE(end, width);
      EXPECT_GE(label.origin.y - label.size_px * 0.73, 0);
      EXPECT_LT(label.origin.y, wall.y) << "the label ends above the view";
      EXPECT_NEAR(label.origin.x, width - end, 1e-6) << "the longest line is centred";
    }
  }
}

TEST(Stage, NothingMovesButTheBlocksAndTheCount) {
  const Pictures pictures(article_scene(6, 1920, 1080));
  const DrawList start = pictures.at(0);
  const DrawList later = pictures.at(4);
  EXPECT_EQ(wall_of(start), wall_of(later));
  EXPECT_EQ(text_item(start, ItemId::label), text_item(later, ItemId::label));
  EXPECT_EQ(text_item(start, ItemId::count).origin, text_item(later, ItemId::count).origin);
  EXPECT_NE(rectangle(start, ItemId::blue_block), rectangle(later, ItemId::blue_block));
}

/// Before time 0 a count may have more digits than the last one, here 0, and any instant can be
/// shown, also one that the film does not.
TEST(Stage, ACountBeforeTimeZeroIsWhole) {
  const Font font;
  for (const int digits : {5, 41, 80}) {
    for (const char* from : {"-20", "0"}) {
      Scene scene = article_scene(digits, 640, 360);
      scene.system.bodies[1].velocity[0] = 1;
      scene.time.from = parse_instant(from);
      scene.time.to = parse_instant("1");
      const Pictures pictures(scene);
      const DrawList list = pictures.at(-20);
      const TextItem& count = text_item(list, ItemId::count);
      const TextItem& label = text_item(list, ItemId::label);
      const double end = count.origin.x + font.width_em(count.text) * count.size_px;
      EXPECT_GT(count.text.size(), std::size_t(digits));
      EXPECT_GT(label.origin.x, 0);
      EXPECT_NEAR(count.origin.x, label.origin.x + font.width_em(label.text) * label.size_px, 1e-6);
      EXPECT_NEAR(label.origin.x, 640 - end, 1e-6) << "in the middle";
      if (from == std::string_view("0")) continue;
      EXPECT_EQ(text_item(pictures.at(0), ItemId::label), label) << "nothing moves during the film";
    }
  }
}

TEST(Stage, EverythingScalesWithTheFrame) {
  const Scene small = article_scene(3, 1280, 720);
  const Scene large = article_scene(3, 3840, 2160);
  const Layout a = lay_out(small, 314);
  const Layout b = lay_out(large, 314);
  EXPECT_NEAR(b.scale, 3 * a.scale, 6) << "to even pixels";
  EXPECT_NEAR(b.count_line.text_px, 3 * a.count_line.text_px, 1e-9);
  EXPECT_NEAR(b.line_px, 3 * a.line_px, 1.5) << "to whole pixels";
  const auto count_x = [](const Layout& l) {
    return l.count_line.label.x + l.count_line.label_em * l.count_line.text_px;
  };
  EXPECT_NEAR(count_x(b), 3 * count_x(a), 1e-9);
}

TEST(Stage, EdgesThatDoNotMoveAreSharp) {
  const auto is_whole = [](double px) { return px == std::floor(px); };
  for (const auto& [width, height] :
       {std::pair{1920, 1080}, {1280, 720}, {3840, 2160}, {854, 480}}) {
    const DrawList list = Pictures(article_scene(3, width, height)).at(4);
    const Rect wall = wall_of(list);
    const Rect blue = rectangle(list, ItemId::blue_block).bounds;
    EXPECT_TRUE(is_whole(wall.x) && is_whole(wall.y) && is_whole(wall.right()));
    EXPECT_TRUE(is_whole(blue.y) && is_whole(blue.height));
  }
}

TEST(Stage, FollowsTheScenesGeometry) {
  Scene scene = article_scene(2, 1000, 500);
  scene.system.walls[0].point[0] = Rational(-1, 2);
  scene.system.bodies[0].size = Rational(1, 2);
  scene.system.bodies[1].size = 2;
  const Pictures pictures(scene);
  const Layout layout = lay_out(scene, pictures.log->last());
  const DrawList list = pictures.at(0);
  const Rect wall = wall_of(list);
  const Rect blue = rectangle(list, ItemId::blue_block).bounds;
  const Rect red = rectangle(list, ItemId::red_block).bounds;
  EXPECT_NEAR(blue.width, 0.5 * layout.scale, 1e-9);
  EXPECT_NEAR(red.height, 2 * layout.scale, 1e-9);
  EXPECT_NEAR(blue.x - wall.right(), 2.25 * layout.scale, 1e-9);
  EXPECT_NEAR(blue.bottom(), red.bottom(), 1e-9);
}

}  // namespace
}  // namespace piblocks
